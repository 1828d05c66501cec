"""Mistakes of lab 6; each docstring goes on after "this is what comes out when"."""


def halve(image):
    """the sum of the 2 x 2 texels is halved, so it is twice as bright; it must be divided by 4"""
    return (image[::2, ::2] + image[1::2, ::2] + image[::2, 1::2] + image[1::2, 1::2]) / 2


def halve(image):
    """far texels are averaged, which are no neighbours: each side is split by the reshape into
    (2, h / 2), with half the picture between the two, instead of (h / 2, 2)"""
    height, width, channels = image.shape
    rows, columns = min(height, 2), min(width, 2)
    return image.reshape(rows, height // rows, columns, width // columns, channels).mean((0, 2))


def pyramid_backward(grad_levels):
    """only the gradient of level 0 itself counts: the higher levels hand nothing down"""
    return grad_levels[0]


def pyramid_backward(grad_levels):
    """the gradient of level 0 itself, the image's own gradient, is left out"""
    grad = grad_levels[-1]
    for number in range(len(grad_levels) - 2, -1, -1):
        grad = halve_backward(grad, grad_levels[number])
        grad = grad + (grad_levels[number] if number else 0)
    return grad


def blend_levels(level, top):
    """the fraction is taken before the level is clamped"""
    lower = np.floor(np.clip(level, 0, top)).astype(int)
    return lower, np.minimum(lower + 1, top), np.where(np.isfinite(level), level, lower) - lower
