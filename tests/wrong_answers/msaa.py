"""Wrong answers to msaa, written without a look at the checks."""


def lattice(count, step):
    """the remainder is taken modulo S instead of S + 1

    told by: modulo | mod S | mod (S | modulus | count + 1 | remainder
    """
    out = np.zeros((count, 2))
    for s in range(count):
        r = (step * (s + 1)) % count - 1
        out[s] = (s + 0.5) / count, (r + 0.5) / count
    return out


def lattice(count, step):
    """x and y of the samples are exchanged: the column number stands in the second place

    told by: x and y | exchanged | swapped | r_s & first | column & second | mixed up
    """
    k = np.arange(1, count + 1)
    y = (k - 0.5) / count
    x = (step * k % (count + 1) - 0.5) / count
    return np.stack([x, y], -1)


def lattice(count, step):
    """the rows are not shifted by -1, so they count from 1 and the last one lies above the pixel

    told by: - 1 & left out | - 1 & forgotten | by -1 | from 1 | - 1 & missing | row too high | above the pixel
    """
    columns = np.arange(count)
    rows = step * (columns + 1) % (count + 1)
    return (np.column_stack([columns, rows]) + 0.5) / count


def centre_sample(clip, offset, width, height):
    """y is moved the other way, as if y pointed down on the screen

    told by: sign of y | y pointed down | y points down | y is flipped | y is moved | y down | upside
    """
    dx = (0.5 - offset[0]) * 2 / width
    dy = -(0.5 - offset[1]) * 2 / height
    shifted = clip.astype(float).copy()
    shifted[:, 0] += dx * shifted[:, 3]
    shifted[:, 1] += dy * shifted[:, 3]
    return shifted


def centre_sample(clip, offset, width, height):
    """the half pixel of the centre is left out, so the sample comes to the pixel's corner

    told by: 1/2 & left out | corner | half a pixel | 0.5 & missing | half pixel | 1/2 & forgotten
    """
    pixel = 2 / np.array([width, height])
    out = clip.copy()
    out[:, :2] -= offset * pixel * clip[:, 3:4]
    return out


def centre_sample(clip, offset, width, height):
    """the absolute value of w is used, so a vertex behind the camera moves the wrong way (fine print)

    told by: behind | w < 0 | negative w | absolute | magnitude | sign of w
    """
    out = clip.copy()
    scale = np.abs(clip[:, 3:])
    out[:, :2] += scale * (1 - 2 * offset) / [width, height]
    return out


def centre_sample(clip, offset, width, height):
    """width and height are exchanged: x is divided by the height

    told by: width and height | height and width | exchanged | swapped | by the height | mixed up
    """
    out = clip.copy()
    out[:, :2] += clip[:, 3:] * (1 - 2 * offset) / [height, width]
    return out


def coverage(face_index):
    """face 0 is taken for no face, because > 0 stands for >= 0

    told by: face 0 | > 0 | >= 0 | number 0 | first face
    """
    return np.mean(face_index > 0, axis=0)


def coverage(face_index):
    """the samples are counted, but the count is not divided by S

    told by: divided by | mean | sum instead | counted | number of samples | not a fraction
    """
    seen = np.zeros(face_index.shape[1:])
    for sample in face_index:
        seen += sample >= 0
    return seen


def coverage(face_index):
    """no face, -1, counts as covered, because every number other than 0 is taken for true

    told by: -1 & counts | -1 & true | != 0 | non-zero | nonzero | other than 0 | -1 & covered
    """
    hit = face_index.astype(bool)
    return hit.sum(0) / face_index.shape[0]


def coverage(face_index):
    """only the samples of the most frequent face in a pixel count, not those of all faces

    told by: most frequent | most common | same face | all faces | several faces | different faces
    """
    count, height, width = face_index.shape
    rate = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            here = face_index[:, i, j]
            best = 0
            for f in here[here >= 0]:
                best = max(best, int((here == f).sum()))
            rate[i, j] = best / count
    return rate


def observed_order(n, error):
    """only the first and the last error are used, not the line of least squares through all

    told by: first and last | first and the last | two & points | all points | least squares | end points | only two
    """
    return np.log(error[0] / error[-1]) / np.log(n[-1] / n[0])


def box_resolve(picture, n):
    """the sides are split in the wrong order, (n, H) instead of (H, n), so far pixels are mixed

    told by: reshape | far & apart | order & axes | neighbour | (n, H | n, height | blocks
    """
    H, W, C = picture.shape[0] // n, picture.shape[1] // n, picture.shape[2]
    return picture.reshape(n, H, n, W, C).mean(axis=(0, 2))


def box_resolve(picture, n):
    """the sum is divided by n instead of by n^2

    told by: by n instead | n^2 | n squared | n * n | n times too | divided by n
    """
    rows, cols, channels = picture.shape
    out = np.zeros((rows // n, cols // n, channels))
    for i in range(n):
        for j in range(n):
            out += picture[i::n, j::n]
    return out / n


def box_resolve(picture, n):
    """the samples are added up but not divided by n^2

    told by: sum instead | divided by n^2 | mean | not divided | n^2 times | added
    """
    h, w, c = picture.shape
    return picture.reshape(h // n, n, w // n, n, c).sum(3).sum(1)


def box_resolve(picture, n):
    """width and height are exchanged when the picture is cut up

    told by: width and height | height and width | not square | exchanged | swapped | square
    """
    w, h, c = picture.shape
    w, h = h, w
    return picture.reshape(w // n, n, h // n, n, c).mean((1, 3))


def box_resolve_backward(grad_output, picture, n):
    """each sample gets the whole gradient of its pixel, not its n^2-th part

    told by: n^2 | n squared | divided | whole gradient | full gradient | mean
    """
    return np.kron(grad_output, np.ones((n, n, 1)))


def box_resolve_backward(grad_output, picture, n):
    """the gradient picture is tiled n x n times instead of each pixel being repeated

    told by: tile | repeat | side by side | whole picture | wrong place | copies
    """
    return np.tile(grad_output, (n, n, 1)) / n**2


def shading_requests_loop(face_index):
    """a face is shaded once in the whole picture instead of once in each pixel

    told by: whole picture | each pixel | per pixel | other pixel | several pixels | once for all | different pixels
    """
    count, height, width = face_index.shape
    number_of = {}
    pixel, face = [], []
    request = -np.ones(face_index.shape, int)
    for i in range(height):
        for j in range(width):
            for s in range(count):
                f = face_index[s, i, j]
                if f < 0:
                    continue
                if f not in number_of:
                    number_of[f] = len(pixel)
                    pixel.append(i * width + j)
                    face.append(f)
                request[s, i, j] = number_of[f]
    return np.array(pixel, int), np.array(face, int), request


def shading_requests_loop(face_index):
    """every sample makes a request of its own, although samples of a pixel see the same face

    told by: every sample | each sample | once | same pair | duplicate | twice | more than one request
    """
    S, H, W = face_index.shape
    pixel = []
    face = []
    request = np.full((S, H, W), -1)
    for s in range(S):
        for i in range(H):
            for j in range(W):
                if face_index[s, i, j] != -1:
                    request[s, i, j] = len(pixel)
                    pixel.append(i * W + j)
                    face.append(face_index[s, i, j])
    return np.array(pixel, int), np.array(face, int), request


def shading_requests_loop(face_index):
    """the background, -1, becomes a request like a face

    told by: background | -1 & request | no face | nothing is seen | sees nothing
    """
    count, height, width = face_index.shape
    table = {}
    request = np.empty(face_index.shape, int)
    for row in range(height):
        for column in range(width):
            for s in range(count):
                key = (row * width + column, face_index[s, row, column])
                if key not in table:
                    table[key] = len(table)
                request[s, row, column] = table[key]
    keys = np.array(list(table)).reshape(-1, 2)
    return keys[:, 0], keys[:, 1], request


def shading_requests_loop(face_index):
    """face 0 gets no request, as it is tested as true or false (or > 0)

    told by: face 0 | > 0 | >= 0 | number 0 | first face
    """
    S, H, W = face_index.shape
    requests = {}
    request = np.full(face_index.shape, -1)
    for i, j, s in np.ndindex(H, W, S):
        f = face_index[s, i, j]
        if f > 0:
            pair = (i * W + j, f)
            if pair not in requests:
                requests[pair] = len(requests)
            request[s, i, j] = requests[pair]
    both = np.array(list(requests), int).reshape(-1, 2)
    return both[:, 0], both[:, 1], request


def shading_requests(face_index):
    """request is made in the order (H, W, S) and reshaped to (S, H, W) without moving the axes

    told by: order & axes | reshape | transpos | (H, W, S) | moveaxis | samples & other pixels | wrong pixel
    """
    S, H, W = face_index.shape
    by_pixel = face_index.reshape(S, -1).T
    pixel = np.repeat(np.arange(H * W), S)
    face = by_pixel.reshape(-1)
    seen = face >= 0
    pairs, inverse = np.unique(np.stack([pixel[seen], face[seen]], 1), axis=0, return_inverse=True)
    request = np.full(len(face), -1)
    request[seen] = inverse.reshape(-1)
    return pairs[:, 0], pairs[:, 1], request.reshape(S, H, W)


def resolve(shade, request, background):
    """the sum divided by S is rounded, so equal colours do not stay exactly what they are (fine print)

    told by: rounded | rounding | exactly | seam | last bit
    """
    colours = np.concatenate([shade, background[None]])
    return colours[request].sum(0) / len(request)


def resolve(shade, request, background):
    """only the samples that see a face are averaged; the background counts only where no sample sees one

    told by: only & see a face | background & not mixed | background & left out | number of seen | divided by the number & see | hits | half-covered
    """
    S, H, W = request.shape
    picture = np.zeros((H, W, len(background)))
    for i in range(H):
        for j in range(W):
            used = [r for r in request[:, i, j] if r >= 0]
            if not used:
                picture[i, j] = background
                continue
            first = shade[used[0]]
            picture[i, j] = first + sum(shade[r] - first for r in used) / len(used)
    return picture


def resolve(shade, request, background):
    """-1 is used as an index, so the background has the colour of the last shade

    told by: last shade | last row | -1 & index | -1 & last | shade[-1] | last colour
    """
    if len(shade) == 0:
        return np.tile(background, (*request.shape[1:], 1))
    samples = shade[request]
    same = (samples == samples[0]).all(0)
    return np.where(same, samples[0], samples.mean(0))


def resolve_backward(grad_picture, shade, request, background):
    """`grad[index] += part` adds only once where a request occurs several times

    told by: += | only once | several times | repeated | more than once | add.at | twice
    """
    part = grad_picture / len(request)
    grad = np.zeros((len(shade) + 1, len(background)))
    for s in range(len(request)):
        grad[request[s]] += part
    return grad[:-1], grad[-1]


def resolve_backward(grad_picture, shade, request, background):
    """-1 is used as an index, so the background's gradient goes to the last shade as well

    told by: last shade | last row | -1 & index | -1 & last | shade[-1] | last request
    """
    part = grad_picture / len(request)
    grad_shade = np.zeros((max(len(shade), 1), len(background)))
    grad_background = np.zeros(len(background))
    for s in range(len(request)):
        np.add.at(grad_shade, request[s], part)
        grad_background += part[request[s] == -1].sum(0)
    return grad_shade[:len(shade)], grad_background


def resolve_backward(grad_picture, shade, request, background):
    """only pixels that see nothing at all hand a gradient to the background, mixed pixels do not

    told by: nothing at all | mixed pixel | all samples | part of & pixel | empty pixel | only & background | partly
    """
    count = len(request)
    grad_shade = np.zeros(shade.shape)
    for r, where in zip(request.reshape(count, -1), [grad_picture.reshape(-1, len(background))] * count):
        seen = r >= 0
        np.add.at(grad_shade, r[seen], where[seen] / count)
    empty = (request == -1).all(axis=0)
    return grad_shade, grad_picture[empty].sum(axis=0)


def resolve_backward(grad_picture, shade, request, background):
    """only grad_shade is returned, the background's gradient is forgotten

    told by: only grad_shade | background & forgotten | two & return | background & missing | grad_background & not | pair | one of the two
    """
    grad_shade = np.zeros(shade.shape)
    for sample in request:
        seen = sample >= 0
        np.add.at(grad_shade, sample[seen], grad_picture[seen] / len(request))
    return grad_shade


def cost(face_index, sample_bytes):
    """different faces are counted in the whole picture instead of in each pixel

    told by: whole picture | each pixel | per pixel | over all pixels | several pixels | pixel by pixel
    """
    samples = face_index.size
    faces = np.unique(face_index)
    return samples, int((faces >= 0).sum()), samples * sample_bytes


def cost(face_index, sample_bytes):
    """the samples are not sorted, so a face that comes back is counted twice

    told by: sort | comes back | neighbouring | twice | previous | consecutive | adjacent
    """
    count = face_index.shape[0]
    changes = (face_index[1:] != face_index[:-1]) & (face_index[1:] >= 0)
    shades = int((face_index[0] >= 0).sum() + changes.sum())
    return face_index.size, shades, face_index.size * sample_bytes
