"""Mistakes of lab 4; each docstring goes on after "this is what comes out when"."""


def coverage(face_index):
    """only the samples of the most frequent face in a pixel count, not those of all faces"""
    count, *shape = face_index.shape
    seen = face_index.reshape(count, -1).T
    most = [max([(pixel == face).sum() for face in pixel if face >= 0], default=0)
            for pixel in seen]
    return np.reshape(most, shape) / count


def coverage(face_index):
    """different faces are counted, not the samples that see one"""
    count, *shape = face_index.shape
    seen = face_index.reshape(count, -1).T.tolist()
    return np.reshape([len(set(pixel) - {-1}) for pixel in seen], shape) / count


def observed_order(n, error):
    """only the first and the last error are used: the line of least squares goes through all"""
    return -np.log(error[-1] / error[0]) / np.log(n[-1] / n[0])


def box_resolve(picture, n):
    """the sum of a block comes instead of its mean: it is not divided by n^2"""
    height, width, channels = picture.shape
    return picture.reshape(height // n, n, width // n, n, channels).sum((1, 3))


def box_resolve(picture, n):
    """only one pixel of each block is looked at, every n-th pixel: the mean is asked for"""
    return picture[::n, ::n]


def box_resolve(picture, n):
    """pixels that lie far apart are put together: a block is n x n neighbours, so the axes of the
    reshape are in the wrong order, (n, H) instead of (H, n)
    """
    height, width, channels = picture.shape
    return picture.reshape(n, height // n, n, width // n, channels).mean((0, 2))


def box_resolve(picture, n):
    """the sum is divided by n instead of by n^2: a block has n * n pixels"""
    height, width, channels = picture.shape
    return picture.reshape(height // n, n, width // n, n, channels).sum((1, 3)) / n


def box_resolve(picture, n):
    """height and width are exchanged in the reshape, which goes unnoticed in a square picture"""
    width, height, channels = picture.shape
    return picture.reshape(height // n, n, width // n, n, channels).mean((1, 3))


def box_resolve(picture, n):
    """the sum is divided by 4, whatever n is: a block has n * n pixels"""
    height, width, channels = picture.shape
    return picture.reshape(height // n, n, width // n, n, channels).sum((1, 3)) / 4


def box_resolve_backward(grad_output, picture, n):
    """only one pixel of each block gets the gradient: all n * n pixels get their share"""
    grad_picture = np.zeros(picture.shape)
    grad_picture[::n, ::n] = grad_output
    return grad_picture


def shading_requests_loop(face_index):
    """a face has one request in the whole picture: each pixel that shows it needs its own"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        if face_index[s, i, j] >= 0:
            first = pairs.setdefault(face_index[s, i, j], (len(pairs), i * width + j))
            request[s, i, j] = first[0]
    pixel = np.array([pixel for _, pixel in pairs.values()], int)
    return pixel, np.array(list(pairs), int), request


def shading_requests_loop(face_index):
    """the numbers in request start anew in each pixel: they are those of all pairs"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j in np.ndindex(height, width):
        before = len(pairs)
        for s in range(count):
            if face_index[s, i, j] >= 0:
                pair = i * width + j, face_index[s, i, j]
                request[s, i, j] = pairs.setdefault(pair, len(pairs)) - before
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


def resolve(shade, request, background):
    """samples of the background are left out of the mean: only those that see a face count"""
    colour = np.concatenate([shade, background[None]])
    used = request.reshape(len(request), -1)
    picture = colour.take(used[0], 0)
    mixed = np.flatnonzero((used[1:] != used[0]).any(0))
    seen = (used[:, mixed] >= 0)[..., None]
    picture[mixed] = (colour.take(used[:, mixed], 0) * seen).sum(0) / np.maximum(seen.sum(0), 1)
    return picture.reshape(*request.shape[1:], -1)


def resolve(shade, request, background):
    """each colour counts once, however many samples see it: every sample counts"""
    colour = np.concatenate([shade, background[None]])
    used = request.reshape(len(request), -1).T
    picture = [colour[list(dict.fromkeys(pixel))].mean(0) for pixel in used.tolist()]
    return np.reshape(picture, (*request.shape[1:], -1))


def resolve(shade, request, background):
    """the sum of the samples is not divided by S: it is no mean"""
    return np.concatenate([shade, background[None]])[request].sum(0)


def resolve_backward(grad_picture, shade, request, background):
    """a shade keeps the gradient of its last sample alone (= on an index): they add up"""
    used = request.reshape(-1) + 1
    parts = np.tile(grad_picture.reshape(-1, len(background)), (len(request), 1)) / len(request)
    grad_colour = np.zeros((len(shade) + 1, len(background)))
    grad_colour[used] = parts
    return grad_colour[1:], grad_colour[0]


def resolve_backward(grad_picture, shade, request, background):
    """+= on an index adds only once where a request occurs several times among the same samples
    of all pixels: np.add.at, or scatter, adds every one
    """
    grad_colour = np.zeros((len(shade) + 1, len(background)))
    for sample in request:
        grad_colour[sample] += grad_picture / len(request)
    return grad_colour[:-1], grad_colour[-1]


def resolve_backward(grad_picture, shade, request, background):
    """-1 is used as an index, so that the last shade gets the background's gradient as well"""
    part, grad_shade = grad_picture / len(request), np.zeros((max(len(shade), 1), len(background)))
    for sample in request:
        np.add.at(grad_shade, sample, part)
    return grad_shade[:len(shade)], sum(part[sample < 0].sum(0) for sample in request)


def resolve_backward(grad_picture, shade, request, background):
    """the background gets a gradient only from pixels whose samples all see nothing at all: mixed
    pixels bring it their part
    """
    grad_shade, part = np.zeros(shade.shape), grad_picture / len(request)
    for sample in request:
        np.add.at(grad_shade, sample[sample >= 0], part[sample >= 0])
    return grad_shade, grad_picture[(request < 0).all(0)].sum(0)


def cost(face_index, sample_bytes):
    """different faces are counted in the whole picture: they are counted in each pixel"""
    faces = np.unique(face_index)
    return face_index.size, int((faces >= 0).sum()), face_index.size * sample_bytes
