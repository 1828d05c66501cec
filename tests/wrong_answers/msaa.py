"""Wrong answers to msaa, written without a look at the checks."""


def lattice(count, step):
    """the remainder is taken modulo S instead of S + 1

    told by: S + 1 | modulo S | mod S | count + 1 | modul & S | remainder
    """
    number = np.arange(count)
    height = (step * (number + 1)) % count - 1
    return np.column_stack([(number + 0.5) / count, (height + 0.5) / count])


def lattice(count, step):
    """the half is added after the division by S, so the samples move by half a pixel instead of half a cell

    told by: after & divi | before & divi | half a pixel | 1/2 & divi | 0.5 & divi | half & divi | outside & unit
    """
    points = []
    for s in range(count):
        r = step * (s + 1) % (count + 1) - 1
        points.append([s / count + 0.5, r / count + 0.5])
    return np.array(points)


def lattice(count, step):
    """r_s has k s instead of k (s + 1): the count starts at 0, so the first row is -1

    told by: s + 1 | k * s | starts & 0 | start & 1 | row -1 | negative & row | counts from 0
    """
    s = np.arange(count)
    r = (step * s) % (count + 1) - 1
    return (np.stack([s, r], axis=1) + 0.5) / count


def centre_sample(clip, offset, width, height):
    """the shift is not multiplied by w: it is a shift of ndc, added to clip coordinates

    told by: multiplied by w | multiply & by w | times w | scaled by w | w is not 1 | w other than 1 | ndc
    """
    out = clip.copy()
    out[:, 0] += 2 * (0.5 - offset[0]) / width
    out[:, 1] += 2 * (0.5 - offset[1]) / height
    return out


def centre_sample(clip, offset, width, height):
    """y is moved in the opposite direction, as if the screen's y pointed down

    told by: y & opposite | y & down | y & sign | y & flipped | y & mirrored | y & negat | y & wrong way
    """
    shift = (0.5 - np.asarray(offset)) * 2 / np.array([width, height])
    shift[1] = -shift[1]
    out = clip.copy()
    out[:, :2] = out[:, :2] + shift * clip[:, 3:4]
    return out


def centre_sample(clip, offset, width, height):
    """a pixel is taken as 1 / width of ndc, but ndc is 2 wide: the factor of 2 is missing

    told by: factor & 2 | twice | 2 / width | half of | halved | factor 0.5 | 2 wide
    """
    out = clip.copy()
    for v in range(len(clip)):
        w = clip[v, 3]
        out[v, 0] += w * (0.5 - offset[0]) / width
        out[v, 1] += w * (0.5 - offset[1]) / height
    return out


def coverage(face_index):
    """> 0 instead of >= 0: samples that see face 0 count as empty

    told by: face 0 | > 0 | >= 0 | face number 0 | zero & face | first face
    """
    return np.mean(face_index > 0, axis=0)


def coverage(face_index):
    """the number of covered samples, not the fraction: the division by S is missing

    told by: divided by S | division by S | divide & by S | number of samples | count & samples | fraction & count | greater than 1
    """
    samples, height, width = face_index.shape
    rate = np.zeros((height, width))
    for s in range(samples):
        rate += face_index[s] != -1
    return rate


def coverage(face_index):
    """a pixel that any sample covers counts as wholly covered: 0 or 1, no fraction

    told by: any sample | any of | 0 or 1 | all or nothing | at least one | wholly | only 0 and 1 | one sample & whole pixel
    """
    return (face_index >= 0).any(0).astype(float)


def observed_order(n, error):
    """the line is forced through the origin: the constant C is left out of the fit, as the means are not subtracted

    told by: origin | intercept | constant C | means & subtract | mean & subtract | centred | C = 1
    """
    log_n, log_error = np.log(n), np.log(error)
    return -np.sum(log_n * log_error) / np.sum(log_n * log_n)


def box_resolve(picture, n):
    """the reshape to (H, W, n, n, C) groups samples that follow each other in memory, not the n x n of a pixel

    told by: reshape | (H, n, W, n | memory | order of the axes | along a row | not neighbour | n x n block
    """
    height, width, channels = picture.shape
    blocks = picture.reshape(height // n, width // n, n, n, channels)
    return blocks.mean(axis=(2, 3))


def box_resolve(picture, n):
    """divided by n, but a pixel has n^2 samples

    told by: n^2 | n * n | n**2 | divided by n | division by n | n times too | factor n
    """
    total = 0
    for i in range(n):
        for j in range(n):
            total = total + picture[i::n, j::n]
    return total / n


def box_resolve(picture, n):
    """only one sample of each pixel is kept, the first, none are averaged

    told by: one sample | first sample | single sample | not averag | only the first | every n-th | ::n
    """
    return picture[::n, ::n].copy()


def box_resolve_backward(grad_output, picture, n):
    """the whole gradient picture is tiled n x n times, instead of each pixel repeated in its own block

    told by: tile | repeat | own block | n x n block | wrong pixel | copies of the whole | each pixel & block
    """
    return np.tile(grad_output, (n, n, 1)) / (n * n)


def shading_requests_loop(face_index):
    """a face is requested once for the whole picture, not once for each pixel: the key lacks the pixel

    told by: each pixel & face | per pixel | whole picture | other pixel | several pixels | two pixels | different pixels
    """
    S, H, W = face_index.shape
    number_of = {}
    pixel, face = [], []
    request = -np.ones((S, H, W), int)
    for i in range(H):
        for j in range(W):
            for s in range(S):
                f = int(face_index[s, i, j])
                if f < 0:
                    continue
                if f not in number_of:
                    number_of[f] = len(pixel)
                    pixel.append(i * W + j)
                    face.append(f)
                request[s, i, j] = number_of[f]
    return np.array(pixel, int), np.array(face, int), request


def shading_requests_loop(face_index):
    """a face is compared with the previous sample's only, so a face that comes back after another one is requested twice

    told by: previous | twice | once | duplicate | one before | comes back | more than one request
    """
    S, H, W = face_index.shape
    pixel, face = [], []
    request = np.full((S, H, W), -1)
    for i, j in np.ndindex(H, W):
        before = -1
        for s in range(S):
            f = face_index[s, i, j]
            if f >= 0:
                if f != before:
                    pixel.append(i * W + j)
                    face.append(f)
                request[s, i, j] = len(pixel) - 1
            before = f
    return np.array(pixel, int), np.array(face, int), request


def shading_requests_loop(face_index):
    """the pixel's number is row * H + column instead of row * W + column

    told by: row * W | row * H | row * height | height & width | H instead | times the width | times the height
    """
    S, H, W = face_index.shape
    seen = {}
    request = np.full((S, H, W), -1)
    pixel, face = [], []
    for i, j, s in np.ndindex(H, W, S):
        f = face_index[s, i, j]
        if f < 0:
            continue
        if (i, j, f) not in seen:
            seen[i, j, f] = len(seen)
            pixel.append(i * H + j)
            face.append(f)
        request[s, i, j] = seen[i, j, f]
    return np.array(pixel, int), np.array(face, int), request


def shading_requests(face_index):
    """the background -1 is treated as a face and gets requests of its own

    told by: background | for -1 | -1 is | no face | empty sample | sees nothing | see nothing
    """
    S, H, W = face_index.shape
    number = np.arange(H * W).reshape(H, W)
    base = face_index.max(initial=0) + 2
    key = number * base + face_index + 1
    pairs, request = np.unique(key, return_inverse=True)
    return pairs // base, pairs % base - 1, request.reshape(S, H, W)


def resolve(shade, request, background):
    """request -1 reads the last row of shade instead of the background

    told by: last row | last shade | last colour | background & -1 | shade[-1] | negative index | from the end
    """
    samples = len(request)
    table = shade if len(shade) else background[None]
    total = np.zeros((*request.shape[1:], len(background)))
    for s in range(samples):
        total += table[request[s]]
    return total / samples


def resolve(shade, request, background):
    """the mean is over the covered samples only: the background does not count where a face is seen

    told by: covered samples | background & mix | background & ignored | background & left out | background & not count | divided by & covered | number of covered
    """
    table = np.concatenate([shade, background[None]])
    covered = request >= 0
    number = covered.sum(0)[..., None]
    total = (table[request] * covered[..., None]).sum(0)
    return np.where(number > 0, total / np.maximum(number, 1), background)


def resolve(shade, request, background):
    """each different request of a pixel counts once, not once for each of its samples

    told by: different request | distinct | unique | count once | each request once | how many samples | equally | colour counts once | every sample counts
    """
    table = np.concatenate([shade, background[None]])
    _, height, width = request.shape
    picture = np.empty((height, width, len(background)))
    for i in range(height):
        for j in range(width):
            kinds = np.unique(request[:, i, j])
            picture[i, j] = table[kinds].mean(0)
    return picture


def resolve_backward(grad_picture, shade, request, background):
    """the 1/S of the mean is missing: every sample brings its pixel's whole gradient

    told by: 1/S | 1 / S | divided by S | division by S | S times | number of samples | S-th
    """
    grad_all = np.zeros((len(shade) + 1, grad_picture.shape[-1]))
    for sample in request:
        np.add.at(grad_all, sample, grad_picture)
    return grad_all[:-1], grad_all[-1]


def resolve_backward(grad_picture, shade, request, background):
    """+= with an index array keeps one of several samples with the same request, they do not add up

    told by: add up | adds up | += | overwr | np.add.at | only the last | accumulat
    """
    part = grad_picture / len(request)
    total = np.zeros((len(shade) + 1, grad_picture.shape[-1]))
    for s in range(len(request)):
        total[request[s]] += part
    return total[:-1], total[-1]


def resolve_backward(grad_picture, shade, request, background):
    """request + 1 puts the background first, but its gradient is read from the end: the rows are shifted by one

    told by: shifted | off by one | one row | by one | last row | first row | entry 0
    """
    part = np.broadcast_to(grad_picture / len(request), request.shape + grad_picture.shape[-1:])
    both = scatter(part, request + 1, len(shade) + 1)
    return both[:-1], both[-1]


def cost(face_index, sample_bytes):
    """the bytes are those of one sample for each pixel: the S samples are forgotten there

    told by: bytes & pixel | bytes & every sample | bytes & each sample | bytes & all samples | bytes & times too
    """
    S, H, W = face_index.shape
    shades = 0
    for i in range(H):
        for j in range(W):
            shades += len({int(f) for f in face_index[:, i, j] if f >= 0})
    return S * H * W, shades, H * W * sample_bytes


def lattice(count, step):
    """x and y are exchanged: the row comes first

    told by: x and y | exchanged | swapped | transposed | row & first | column & row | mixed up
    """
    pattern = np.empty((count, 2))
    for s in range(count):
        pattern[s] = (step * (s + 1)) % (count + 1) - 0.5, s + 0.5
    return pattern / count


def lattice(count, step):
    """the half is forgotten: samples at s / S instead of (s + 1/2) / S

    told by: half | 0.5 | 1/2 | centre of & square | corner of & square | lower left
    """
    s = np.arange(count)
    r = step * (s + 1) % (count + 1) - 1
    return np.stack([s, r], -1) / count


def centre_sample(clip, offset, width, height):
    """one pixel is taken as 1 / width of ndc instead of 2 / width: half the move

    told by: half | 2 / width | 1 / width | factor & 2 | twice | too small
    """
    x, y, z, w = clip.T
    return np.stack([x + w * (0.5 - offset[0]) / width, y + w * (0.5 - offset[1]) / height, z, w], -1)


def centre_sample(clip, offset, width, height):
    """clip is moved in place: every further sample starts from the moved vertices

    told by: in place | in-place | changes & input | changes & clip | its input | overwr | copy | modif
    """
    for vertex in clip:
        vertex[0] += vertex[3] * (1 - 2 * offset[0]) / width
        vertex[1] += vertex[3] * (1 - 2 * offset[1]) / height
    return clip


def coverage(face_index):
    """face 0 is taken for no face: > 0 instead of >= 0

    told by: face 0 | > 0 | >= 0 | number 0 | first face | face & zero
    """
    return np.mean(face_index > 0, axis=0)


def coverage(face_index):
    """the samples that see a face are counted, but their number is not divided by S

    told by: divided by s | number of samples | counted | count & instead of | the mean | not a mean | fraction
    """
    seen = np.zeros(face_index.shape[1:])
    for layer in face_index:
        seen += layer != -1
    return seen


def observed_order(n, error):
    """the slope through the first and last measurement only, not the line of least squares

    told by: first and last | first and the last | least squares | endpoints | end points | all points | all measurements | in between | least sum | only two
    """
    return -np.log(error[-1] / error[0]) / np.log(n[-1] / n[0])


def box_resolve(picture, n):
    """reshaped as (n, H, n, W): the samples of a pixel are taken H and W apart instead of side by side

    told by: reshape | apart | side by side | neighbour | order of the axes | axes & order | wrong axes | interleav
    """
    H, W, C = picture.shape
    return picture.reshape(n, H // n, n, W // n, C).mean(axis=(0, 2))


def box_resolve(picture, n):
    """the sum of n x n samples is divided by n instead of n^2

    told by: n^2 | n**2 | n * n | n x n & divided | divided by n | n times | factor & n | squared
    """
    H, W, C = picture.shape
    out = np.zeros((H // n, W // n, C))
    for i in range(n):
        for j in range(n):
            out += picture[i::n, j::n]
    return out / n


def shading_requests_loop(face_index):
    """pixel is row * H + column instead of row * W + column

    told by: row * h | row * w | height & width | times the height | row & height | number of rows | pixel & number & height
    """
    S, H, W = face_index.shape
    pixel, face = [], []
    request = -np.ones((S, H, W), int)
    for i in range(H):
        for j in range(W):
            known = {}
            for s in range(S):
                f = face_index[s, i, j]
                if f < 0:
                    continue
                if f not in known:
                    known[f] = len(pixel)
                    pixel.append(i * H + j)
                    face.append(f)
                request[s, i, j] = known[f]
    return np.array(pixel, int), np.array(face, int), request


def shading_requests_loop(face_index):
    """a face is only compared with the sample before, so a face that comes back in a pixel is requested twice

    told by: sample before | previous sample | comes back | seen again | twice | only once | more than once | consecutive | several times | duplicate
    """
    S, H, W = face_index.shape
    pixel, face = [], []
    request = np.full((S, H, W), -1)
    for i, j in np.ndindex(H, W):
        before = -1
        for s in range(S):
            f = face_index[s, i, j]
            if f >= 0:
                if f != before:
                    pixel.append(i * W + j)
                    face.append(f)
                request[s, i, j] = len(pixel) - 1
            before = f
    return np.array(pixel, int), np.array(face, int), request


def resolve(shade, request, background):
    """request -1 is used as an index into shade, so the background becomes the last shade

    told by: last row | last shade | last colour | -1 & index | background & never | background & ignored | index -1 | background & not used
    """
    first = shade[request[0]]
    rest = np.zeros_like(first)
    for layer in request[1:]:
        rest = rest + (shade[layer] - first)
    return first + rest / len(request)


def resolve(shade, request, background):
    """samples without a face are left out of the mean where others see one, instead of counting as background

    told by: left out & mean | left out & background | background & mixed | background & not counted | background & count | only the samples that see | number of & see a face | silhouette | divided by & see | partly covered | background & share
    """
    S, H, W = request.shape
    picture = np.empty((H, W, len(background)))
    for i in range(H):
        for j in range(W):
            rows = request[:, i, j]
            rows = rows[rows >= 0]
            if len(rows) == 0:
                picture[i, j] = background
            else:
                base = shade[rows[0]]
                picture[i, j] = base + (shade[rows] - base).mean(0)
    return picture


def resolve_backward(grad_picture, shade, request, background):
    """+= with repeated indices: a shade that several pixels or samples use keeps only one part of a layer

    told by: repeated | += | np.add.at | several samples & only | several pixels & only | more than once | overwr | accumul | last one
    """
    part = grad_picture / len(request)
    grad = np.zeros((len(shade) + 1, grad_picture.shape[-1]))
    for layer in request:
        grad[layer] += part
    return grad[:-1], grad[-1]


def resolve_backward(grad_picture, shade, request, background):
    """the background gets only the pixels that see no face at all, not its part of mixed pixels

    told by: mixed pixel | no face at all | partly covered | background & part | background & mixed | background & share | background & only | silhouette | all samples
    """
    S = len(request)
    parts = np.broadcast_to(grad_picture / S, (S, *grad_picture.shape))
    grad_shade = scatter(parts, request + 1, len(shade) + 1)[1:]
    empty = (request < 0).all(0)
    return grad_shade, grad_picture[empty].sum(0)


def cost(face_index, sample_bytes):
    """shades counts the different faces of the whole picture instead of adding them up over the pixels

    told by: whole picture | each pixel | per pixel | over the pixels | every pixel | in all pixels
    """
    faces = set(face_index[face_index >= 0].tolist())
    return face_index.size, len(faces), face_index.size * sample_bytes
