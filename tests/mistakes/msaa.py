"""Mistakes of lab 4; each docstring goes on after "this is what comes out when"."""


def lattice(count, step):
    """s is multiplied instead of s + 1"""
    s = np.arange(count)
    row = step * s % (count + 1) - 1
    return (np.stack([s, row], -1) + 0.5) / count


def lattice(count, step):
    """the remainder is that by S instead of by S + 1"""
    s = np.arange(count)
    row = step * (s + 1) % count - 1
    return (np.stack([s, row], -1) + 0.5) / count


def lattice(count, step):
    """the 1 is not taken away after the remainder"""
    s = np.arange(count)
    row = step * (s + 1) % (count + 1)
    return (np.stack([s, row], -1) + 0.5) / count


def centre_sample(clip, offset, width, height):
    """w is left out: far vertices move less on screen"""
    moved = clip.copy()
    moved[:, :2] += (1 - 2 * offset) / [width, height]
    return moved


def centre_sample(clip, offset, width, height):
    """the sample moves away from the centre, not to it"""
    moved = clip.copy()
    moved[:, :2] += clip[:, 3:] * (2 * offset - 1) / [width, height]
    return moved


def centre_sample(clip, offset, width, height):
    """width and height are swapped"""
    moved = clip.copy()
    moved[:, :2] += clip[:, 3:] * (1 - 2 * offset) / [height, width]
    return moved


def coverage(face_index):
    """face 0 is taken for no face"""
    return (face_index > 0).mean(0)


def coverage(face_index):
    """samples are counted; what is asked for is their share"""
    return (face_index >= 0).sum(0)


def coverage(face_index):
    """one sample on a face is enough for the whole pixel"""
    return (face_index >= 0).any(0)


def observed_order(n, error):
    """the order has the wrong sign: it is minus the slope"""
    x, y = np.log(n), np.log(error)
    x = x - x.mean()
    return (x @ y) / (x @ x)


def observed_order(n, error):
    """the slope is that of log n over log error"""
    x, y = np.log(n), np.log(error)
    x = x - x.mean()
    return -(x @ x) / (x @ y)


def observed_order(n, error):
    """no logarithm is taken"""
    x, y = n, error
    x = x - x.mean()
    return -(x @ y) / (x @ x)


def box_resolve(picture, n):
    """it is the sum of a block instead of its mean"""
    height, width, channels = picture.shape
    return picture.reshape(height // n, n, width // n, n, channels).sum((1, 3))


def box_resolve(picture, n):
    """only one pixel of each block is looked at"""
    return picture[::n, ::n]


def box_resolve(picture, n):
    """pixels that lie far apart are put together; a block is n x n neighbours"""
    height, width, channels = picture.shape
    return picture.reshape(n, height // n, n, width // n, channels).mean((0, 2))


def box_resolve_backward(grad_output, picture, n):
    """every pixel of a block gets the whole gradient, not its share"""
    return grad_output.repeat(n, 0).repeat(n, 1)


def box_resolve_backward(grad_output, picture, n):
    """it is divided by n; a block has n * n pixels"""
    return grad_output.repeat(n, 0).repeat(n, 1) / n


def box_resolve_backward(grad_output, picture, n):
    """the whole picture is repeated; each of its pixels must be"""
    return np.tile(grad_output, (n, n, 1)) / n**2


def shading_requests_loop(face_index):
    """pixel is row * H + column; it is row * W + column"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        if face_index[s, i, j] >= 0:
            pair = i * height + j, face_index[s, i, j]
            request[s, i, j] = pairs.setdefault(pair, len(pairs))
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


def shading_requests_loop(face_index):
    """face 0 is taken for no face"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        if face_index[s, i, j] > 0:
            pair = i * width + j, face_index[s, i, j]
            request[s, i, j] = pairs.setdefault(pair, len(pairs))
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


def shading_requests_loop(face_index):
    """every sample has a shade of its own: that is supersampling"""
    count, height, width = face_index.shape
    pairs, request = {}, np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(height, width, count):
        if face_index[s, i, j] >= 0:
            pair = i * width + j + s / 1000, face_index[s, i, j]
            request[s, i, j] = pairs.setdefault(pair, len(pairs))
    pixel, face = np.array(list(pairs), int).reshape(-1, 2).T
    return pixel, face, request


def shading_requests(face_index):
    """face 0 is taken for no face"""
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
    """in mixed pixels the background is shaded as if it were a face"""
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
    """the pairs of mixed pixels are numbered from 0 again, as if there were no others"""
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
    """the background counts as black"""
    colour = np.concatenate([shade, np.zeros((1, len(background)))])
    used = request.reshape(len(request), -1)
    picture = colour.take(used[0], 0)
    mixed = np.flatnonzero((used[1:] != used[0]).any(0))
    first = picture[mixed]
    others = sum(colour.take(sample, 0) - first for sample in used[1:, mixed])
    picture[mixed] += others / len(request)
    return picture.reshape(*request.shape[1:], -1)


def resolve(shade, request, background):
    """samples of the background are left out of the mean"""
    colour = np.concatenate([shade, background[None]])
    used = request.reshape(len(request), -1)
    picture = colour.take(used[0], 0)
    mixed = np.flatnonzero((used[1:] != used[0]).any(0))
    seen = (used[:, mixed] >= 0)[..., None]
    picture[mixed] = (colour.take(used[:, mixed], 0) * seen).sum(0) / np.maximum(seen.sum(0), 1)
    return picture.reshape(*request.shape[1:], -1)


def resolve(shade, request, background):
    """the first sample's colour is that of the pixel"""
    colour = np.concatenate([shade, background[None]])
    used = request.reshape(len(request), -1)
    picture = colour.take(used[0], 0)
    return picture.reshape(*request.shape[1:], -1)


def resolve_backward(grad_picture, shade, request, background):
    """every sample brings the whole gradient, not its share"""
    used = request.reshape(-1) + 1
    parts = np.tile(grad_picture.reshape(-1, len(background)), (len(request), 1))
    grad_colour = np.stack([np.bincount(used, part, len(shade) + 1) for part in parts.T], -1)
    return grad_colour[1:], grad_colour[0]


def resolve_backward(grad_picture, shade, request, background):
    """a shade keeps the gradient of its last sample alone; they add up"""
    used = request.reshape(-1) + 1
    parts = np.tile(grad_picture.reshape(-1, len(background)), (len(request), 1)) / len(request)
    grad_colour = np.zeros((len(shade) + 1, len(background)))
    grad_colour[used] = parts
    return grad_colour[1:], grad_colour[0]


def resolve_backward(grad_picture, shade, request, background):
    """the background has no gradient"""
    used = request.reshape(-1) + 1
    parts = np.tile(grad_picture.reshape(-1, len(background)), (len(request), 1)) / len(request)
    grad_colour = np.stack([np.bincount(used, part, len(shade) + 1) for part in parts.T], -1)
    return grad_colour[1:], np.zeros(len(background))


def cost(face_index, sample_bytes):
    """face 0 is taken for no face"""
    ordered = np.sort(face_index, 0)
    new = ordered > 0
    new[1:] &= ordered[1:] != ordered[:-1]
    return face_index.size, int(new.sum()), face_index.size * sample_bytes


def cost(face_index, sample_bytes):
    """the background is shaded as if it were a face"""
    ordered = np.sort(face_index, 0)
    new = ordered >= -1
    new[1:] &= ordered[1:] != ordered[:-1]
    return face_index.size, int(new.sum()), face_index.size * sample_bytes


def cost(face_index, sample_bytes):
    """equal samples share a shade only if they are neighbours"""
    ordered = face_index
    new = ordered >= 0
    new[1:] &= ordered[1:] != ordered[:-1]
    return face_index.size, int(new.sum()), face_index.size * sample_bytes
