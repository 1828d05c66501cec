"""Mistakes of lab 3; each docstring goes on after "this is what comes out when"."""


def convolve(picture, kernel):
    """a kernel larger than the picture is placed in it once, so that what falls on the same pixel
    is overwritten: it goes round more than once, and is added up
    """
    (height, width), (h, w) = picture.shape, kernel.shape
    placed = np.zeros(picture.shape)
    placed[np.ix_((np.arange(h) - h // 2) % height, (np.arange(w) - w // 2) % width)] = kernel
    return picture_of(spectrum_of(picture) * spectrum_of(placed))
