"""Mistakes of lab 4; each docstring goes on after "this is what comes out when"."""


def lattice(count, step):
    """k is multiplied by s instead of by s + 1"""
    s = np.arange(count)
    row = step * s % (count + 1) - 1
    return (np.stack([s, row], -1) + 0.5) / count


def lattice(count, step):
    """the remainder is that by S (modulo S) instead of by S + 1"""
    s = np.arange(count)
    row = step * (s + 1) % count - 1
    return (np.stack([s, row], -1) + 0.5) / count


def lattice(count, step):
    """the - 1 after the remainder is left out: rows count from 1 instead of from 0, and the last
    one lies above the pixel
    """
    s = np.arange(count)
    row = step * (s + 1) % (count + 1)
    return (np.stack([s, row], -1) + 0.5) / count


def lattice(count, step):
    """x and y are swapped: s, the column, belongs in the first place, and r_s in the second"""
    s = np.arange(count)
    row = step * (s + 1) % (count + 1) - 1
    return (np.stack([row, s], -1) + 0.5) / count


def lattice(count, step):
    """the + 1/2 is left out: samples lie at the corners of their squares, not at the centres"""
    s = np.arange(count)
    row = step * (s + 1) % (count + 1) - 1
    return np.stack([s, row], -1) / count


def lattice(count, step):
    """the division by S is left out: positions must lie between 0 and 1"""
    s = np.arange(count)
    row = step * (s + 1) % (count + 1) - 1
    return np.stack([s, row], -1) + 0.5


def centre_sample(clip, offset, width, height):
    """the step is not multiplied by w: far vertices move less on screen"""
    moved = clip.copy()
    moved[:, :2] += (1 - 2 * offset) / [width, height]
    return moved


def centre_sample(clip, offset, width, height):
    """the sample moves away from the centre, not to it: the step has the opposite sign"""
    moved = clip.copy()
    moved[:, :2] += clip[:, 3:] * (2 * offset - 1) / [width, height]
    return moved


def centre_sample(clip, offset, width, height):
    """width and height are swapped: x is divided by the height"""
    moved = clip.copy()
    moved[:, :2] += clip[:, 3:] * (1 - 2 * offset) / [height, width]
    return moved


def centre_sample(clip, offset, width, height):
    """y is moved the other way, as if y pointed down on the screen: the sign of y is wrong"""
    moved = clip.copy()
    moved[:, :2] += clip[:, 3:] * (1 - 2 * offset) / [width, -height]
    return moved


def centre_sample(clip, offset, width, height):
    """the half pixel (1/2) is left out: the sample comes to its pixel's corner, not its centre"""
    moved = clip.copy()
    moved[:, :2] -= clip[:, 3:] * 2 * offset / [width, height]
    return moved


def centre_sample(clip, offset, width, height):
    """a pixel is taken for 1 / width, so that the step is half as long: clip / w runs from -1 to 1,
    and a pixel is 2 / width
    """
    moved = clip.copy()
    moved[:, :2] += clip[:, 3:] * (0.5 - offset) / [width, height]
    return moved


def coverage(face_index):
    """face 0 is taken for no face: > 0 stands for >= 0"""
    return (face_index > 0).mean(0)


def coverage(face_index):
    """samples are counted, but the sum is not divided by S, the number of samples"""
    return (face_index >= 0).sum(0)


def coverage(face_index):
    """one sample on a face is enough for the whole pixel: the share of the samples is asked for"""
    return (face_index >= 0).any(0).astype(float)


def coverage(face_index):
    """-1, no face, counts as covered, and face 0 does not: every number other than 0 (nonzero) is
    taken for true
    """
    return face_index.astype(bool).mean(0)


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
    """the order has the wrong sign: it is minus the slope, positive where the error falls"""
    x, y = np.log(n), np.log(error)
    x = x - x.mean()
    return (x @ y) / (x @ x)


def observed_order(n, error):
    """the slope is that of log n over log error, the reciprocal or nearly so"""
    x, y = np.log(n), np.log(error)
    x = x - x.mean()
    return -(x @ x) / (x @ y)


def observed_order(n, error):
    """no logarithm is taken"""
    x, y = n, error
    x = x - x.mean()
    return -(x @ y) / (x @ x)


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
    """every pixel of a block gets the whole gradient: it is divided by n^2"""
    return grad_output.repeat(n, 0).repeat(n, 1)


def box_resolve_backward(grad_output, picture, n):
    """the gradient is divided by n instead of by n^2: a block has n * n pixels"""
    return grad_output.repeat(n, 0).repeat(n, 1) / n


def box_resolve_backward(grad_output, picture, n):
    """the whole picture is tiled, as copies side by side: each pixel must be repeated"""
    return np.tile(grad_output, (n, n, 1)) / n**2


def box_resolve_backward(grad_output, picture, n):
    """only one pixel of each block gets the gradient: all n * n pixels get their share"""
    grad_picture = np.zeros(picture.shape)
    grad_picture[::n, ::n] = grad_output
    return grad_picture


def shading_requests_loop(face_index):
    """pixel is row * H + column: it is row * W + column, W to a row"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        if face_index[s, i, j] >= 0:
            pair = i * height + j, face_index[s, i, j]
            request[s, i, j] = pairs.setdefault(pair, len(pairs))
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


def shading_requests_loop(face_index):
    """face 0 is taken for no face: > 0 stands for >= 0"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        if face_index[s, i, j] > 0:
            pair = i * width + j, face_index[s, i, j]
            request[s, i, j] = pairs.setdefault(pair, len(pairs))
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


def shading_requests_loop(face_index):
    """every sample has a request of its own: samples of a pixel that see the same face share one"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        if face_index[s, i, j] >= 0:
            pair = i * width + j + s / 1000, face_index[s, i, j]
            request[s, i, j] = pairs.setdefault(pair, len(pairs))
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


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
    """the background, -1, becomes a request, as if it were a face"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        pair = i * width + j, face_index[s, i, j]
        request[s, i, j] = pairs.setdefault(pair, len(pairs))
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


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


def shading_requests(face_index):
    """face 0 is taken for no face: > 0 stands for >= 0"""
    seen = face_index.reshape(len(face_index), -1)
    mixed = (seen[1:] != seen[0]).any(0)
    pixel, mixed = np.flatnonzero((seen[0] > 0) & ~mixed), np.flatnonzero(mixed)
    face, request = seen[0, pixel], np.full(seen.shape[1], -1)
    request[pixel] = np.arange(len(pixel))
    request = np.tile(request, (len(seen), 1))
    seen = seen[:, mixed]
    last = np.zeros(seen.shape, int)
    for s in range(1, len(seen)):
        np.copyto(last, s, where=seen == seen[s])
    s, k = np.nonzero((last == np.arange(len(seen))[:, None]) & (seen > 0))
    number = np.full(seen.shape, -1)
    number[s, k] = len(pixel) + np.arange(len(k))
    request[:, mixed] = np.take_along_axis(number, last, 0)
    pixel, face = np.concatenate([pixel, mixed[k]]), np.concatenate([face, seen[s, k]])
    return pixel, face, request.reshape(face_index.shape)


def shading_requests(face_index):
    """in pixels with several faces the background, -1, is shaded as if it were a face"""
    seen = face_index.reshape(len(face_index), -1)
    mixed = (seen[1:] != seen[0]).any(0)
    pixel, mixed = np.flatnonzero((seen[0] >= 0) & ~mixed), np.flatnonzero(mixed)
    face, request = seen[0, pixel], np.full(seen.shape[1], -1)
    request[pixel] = np.arange(len(pixel))
    request = np.tile(request, (len(seen), 1))
    seen = seen[:, mixed]
    last = np.zeros(seen.shape, int)
    for s in range(1, len(seen)):
        np.copyto(last, s, where=seen == seen[s])
    s, k = np.nonzero(last == np.arange(len(seen))[:, None])
    number = np.full(seen.shape, -1)
    number[s, k] = len(pixel) + np.arange(len(k))
    request[:, mixed] = np.take_along_axis(number, last, 0)
    pixel, face = np.concatenate([pixel, mixed[k]]), np.concatenate([face, seen[s, k]])
    return pixel, face, request.reshape(face_index.shape)


def shading_requests(face_index):
    """the pairs of mixed pixels are numbered from 0 again, as if there were no others before"""
    seen = face_index.reshape(len(face_index), -1)
    mixed = (seen[1:] != seen[0]).any(0)
    pixel, mixed = np.flatnonzero((seen[0] >= 0) & ~mixed), np.flatnonzero(mixed)
    face, request = seen[0, pixel], np.full(seen.shape[1], -1)
    request[pixel] = np.arange(len(pixel))
    request = np.tile(request, (len(seen), 1))
    seen = seen[:, mixed]
    last = np.zeros(seen.shape, int)
    for s in range(1, len(seen)):
        np.copyto(last, s, where=seen == seen[s])
    s, k = np.nonzero((last == np.arange(len(seen))[:, None]) & (seen >= 0))
    number = np.full(seen.shape, -1)
    number[s, k] = np.arange(len(k))
    request[:, mixed] = np.take_along_axis(number, last, 0)
    pixel, face = np.concatenate([pixel, mixed[k]]), np.concatenate([face, seen[s, k]])
    return pixel, face, request.reshape(face_index.shape)


def resolve(shade, request, background):
    """the background counts as black: its colour is left out"""
    colour = np.concatenate([shade, np.zeros((1, len(background)))])
    used = request.reshape(len(request), -1)
    picture = colour.take(used[0], 0)
    mixed = np.flatnonzero((used[1:] != used[0]).any(0))
    first = picture[mixed]
    others = sum(colour.take(sample, 0) - first for sample in used[1:, mixed])
    picture[mixed] += others / len(request)
    return picture.reshape(*request.shape[1:], -1)


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
    """the first sample's colour alone is that of the pixel: the mean of all is asked for"""
    colour = np.concatenate([shade, background[None]])
    used = request.reshape(len(request), -1)
    picture = colour.take(used[0], 0)
    return picture.reshape(*request.shape[1:], -1)


def resolve(shade, request, background):
    """-1 is used as an index, so that the background has the colour of the last shade, shade[-1]"""
    picture = shade[request] if len(shade) else np.broadcast_to(
        background, (*request.shape, len(background)))
    return picture[0] + (picture - picture[0]).sum(0) / len(request)


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
    """every sample brings the whole gradient of its pixel: it is divided by S"""
    used = request.reshape(-1) + 1
    parts = np.tile(grad_picture.reshape(-1, len(background)), (len(request), 1))
    grad_colour = np.stack([np.bincount(used, part, len(shade) + 1) for part in parts.T], -1)
    return grad_colour[1:], grad_colour[0]


def resolve_backward(grad_picture, shade, request, background):
    """a shade keeps the gradient of its last sample alone (= on an index): they add up"""
    used = request.reshape(-1) + 1
    parts = np.tile(grad_picture.reshape(-1, len(background)), (len(request), 1)) / len(request)
    grad_colour = np.zeros((len(shade) + 1, len(background)))
    grad_colour[used] = parts
    return grad_colour[1:], grad_colour[0]


def resolve_backward(grad_picture, shade, request, background):
    """the background has no gradient: it gets that of its samples, like a shade"""
    used = request.reshape(-1) + 1
    parts = np.tile(grad_picture.reshape(-1, len(background)), (len(request), 1)) / len(request)
    grad_colour = np.stack([np.bincount(used, part, len(shade) + 1) for part in parts.T], -1)
    return grad_colour[1:], np.zeros(len(background))


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
    """face 0 is taken for no face: > 0 stands for >= 0"""
    ordered = np.sort(face_index, 0)
    new = ordered > 0
    new[1:] &= ordered[1:] != ordered[:-1]
    return face_index.size, int(new.sum()), face_index.size * sample_bytes


def cost(face_index, sample_bytes):
    """the background, -1, is shaded as if it were a face"""
    ordered = np.sort(face_index, 0)
    new = ordered >= -1
    new[1:] &= ordered[1:] != ordered[:-1]
    return face_index.size, int(new.sum()), face_index.size * sample_bytes


def cost(face_index, sample_bytes):
    """samples are not sorted, so that a face that comes back is counted twice: only neighbouring
    samples share a shade
    """
    ordered = face_index
    new = ordered >= 0
    new[1:] &= ordered[1:] != ordered[:-1]
    return face_index.size, int(new.sum()), face_index.size * sample_bytes


def cost(face_index, sample_bytes):
    """different faces are counted in the whole picture: they are counted in each pixel"""
    faces = np.unique(face_index)
    return face_index.size, int((faces >= 0).sum()), face_index.size * sample_bytes
