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
    both = rasterization.scatter(part, request + 1, len(shade) + 1)
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
    """the permutation starts from s instead of s + 1

    told by: starts from s | k s mod | from 0 | s instead of s | row -1 | below the pixel | multiplied by s
    """
    s = np.arange(count)
    r = (step * s) % (count + 1) - 1
    return np.stack([(s + 0.5) / count, (r + 0.5) / count], axis=1)


def lattice(count, step):
    """the samples lie on the corners of their squares, as + 1/2 is left out

    told by: 1/2 | + 0.5 | half | corner & square | centre of & square | lower left
    """
    samples = []
    for s in range(count):
        r = (step * (s + 1)) % (count + 1) - 1
        samples.append([s / count, r / count])
    return np.array(samples)


def centre_sample(clip, offset, width, height):
    """the vertices move in the direction of the sample instead of against it: the sign is flipped

    told by: sign | direction | opposite | o - 1/2 | wrong way | towards
    """
    result = np.array(clip, dtype=float)
    w = clip[:, 3]
    result[:, 0] += w * 2 * (offset[0] - 0.5) / width
    result[:, 1] += w * 2 * (offset[1] - 0.5) / height
    return result


def centre_sample(clip, offset, width, height):
    """the shift in ndc is added to clip coordinates without multiplying it by w

    told by: by w | times w | w is forgotten | w is left out | factor w | w other than 1 | w = 1
    """
    shift = (1 - 2 * offset) / np.array([width, height])
    out = clip.copy()
    out[:, :2] = out[:, :2] + shift
    return out


def centre_sample(clip, offset, width, height):
    """the shift is half as long as it should be: ndc goes from -1 to 1, so a pixel is 2 / width

    told by: 2 / width | half | factor 2 | twice | width / 2 | factor of 2
    """
    moved = clip.copy()
    for v in range(len(clip)):
        w = clip[v, 3]
        moved[v, 0] += (0.5 - offset[0]) / width * w
        moved[v, 1] += (0.5 - offset[1]) / height * w
    return moved


def centre_sample(clip, offset, width, height):
    """clip itself is changed, so the vertices move on with every sample: a copy is needed

    told by: in place | input & chang | copy | itself is changed | argument & chang | modif
    """
    for axis, size in enumerate((width, height)):
        clip[:, axis] += clip[:, 3] * (1 - 2 * offset[axis]) / size
    return clip


def coverage(face_index):
    """a pixel is covered fully as soon as one of its samples sees a face: 0 or 1, no fraction

    told by: as soon as | one sample | 0 or 1 | at least one | fully & covered | no fraction
    """
    return (face_index >= 0).any(axis=0).astype(float)


def coverage(face_index):
    """the mean is over the columns of the picture instead of over the samples

    told by: axis | over the columns | last axis | over the samples | over x | instead of the samples
    """
    return (face_index >= 0).mean(-1)


def observed_order(n, error):
    """the slope itself is returned, with its sign, instead of -slope

    told by: sign | negative | minus | -p | slope itself
    """
    slope, _ = np.polyfit(np.log(n), np.log(error), 1)
    return slope


def observed_order(n, error):
    """the line is forced through the origin, as the means are not subtracted: C is taken for 1

    told by: origin | mean & subtract | intercept | C = 1 | constant C | C & taken for 1
    """
    a = np.log(n)
    b = np.log(error)
    return -(a * b).sum() / (a * a).sum()


def box_resolve(picture, n):
    """one of the n x n samples is taken for all of them, no mean

    told by: one sample | only one | every n-th | no mean | first sample | one of the | not averaged
    """
    return picture[::n, ::n].copy()


def box_resolve(picture, n):
    """the last row and the last column of each block are left out

    told by: last row | last column | last sample | n - 1 | off by one
    """
    height, width, channels = picture.shape
    out = np.zeros((height // n, width // n, channels))
    for y in range(height // n):
        for x in range(width // n):
            block = picture[y * n:(y + 1) * n - 1, x * n:(x + 1) * n - 1]
            out[y, x] = block.mean((0, 1))
    return out


def shading_requests_loop(face_index):
    """pixels are numbered with the height instead of the width: row * H + column

    told by: height & instead of the width | row * H | by the height | column * | column by column | with the height
    """
    S, H, W = face_index.shape
    known = {}
    request = np.full(face_index.shape, -1)
    for i in range(H):
        for j in range(W):
            for s in range(S):
                f = int(face_index[s, i, j])
                if f >= 0:
                    request[s, i, j] = known.setdefault((i, j, f), len(known))
    pixel = np.array([i * H + j for i, j, _ in known], int)
    face = np.array([f for _, _, f in known], int)
    return pixel, face, request


def shading_requests_loop(face_index):
    """a sample is compared with the one before it only, so a face that comes back is shaded twice

    told by: before it | previous | comes back | neighbouring sample | consecutive | adjacent sample | just before
    """
    count, height, width = face_index.shape
    request = np.full(face_index.shape, -1)
    pairs = []
    for i in range(height):
        for j in range(width):
            last = -1
            for s in range(count):
                f = face_index[s, i, j]
                if f >= 0:
                    if f != last:
                        pairs.append((i * width + j, f))
                    request[s, i, j] = len(pairs) - 1
                last = f
    pairs = np.array(pairs, int).reshape(-1, 2)
    return pairs[:, 0], pairs[:, 1], request


def shading_requests(face_index):
    """the key pixel * max + face is not unique: the largest face collides with face 0 of the next pixel

    told by: unique | collide | max + 1 | next pixel | key | neighbouring pixel | different pixels
    """
    flat = face_index.reshape(len(face_index), -1)
    most = max(flat.max(initial=0), 1)
    keys = np.arange(flat.shape[1]) * most + flat
    seen = flat >= 0
    _, first, inverse = np.unique(keys[seen], return_index=True, return_inverse=True)
    sample, where = np.nonzero(seen)
    request = np.full(flat.shape, -1)
    request[seen] = inverse
    return where[first], flat[sample[first], where[first]], request.reshape(face_index.shape)


def resolve(shade, request, background):
    """samples that see nothing are black instead of having the background's colour

    told by: black | background & as 0 | background & ignored | background & left out | background & missing | no background
    """
    colours = np.concatenate([shade, np.zeros((1, shade.shape[1]))])[request]
    first = colours[0]
    return first + (colours - first).sum(0) / len(request)


def resolve(shade, request, background):
    """nearly equal colours are taken for equal, as they are compared with a tolerance (fine print)

    told by: nearly | tolerance | isclose | almost | allclose
    """
    colour = np.vstack([shade, background])[request]
    same = np.isclose(colour, colour[0]).all((0, -1))
    return np.where(same[..., None], colour[0], colour[0] + (colour - colour[0]).mean(0))


def resolve(shade, request, background):
    """each request of a pixel counts once, however many samples have it

    told by: once | how many samples | unique | equal weight | not weighted | number of samples | samples have it
    """
    all_colours = np.concatenate([shade, background[None, :]])
    out = np.empty((*request.shape[1:], len(background)))
    for i, j in np.ndindex(*request.shape[1:]):
        kinds = np.unique(request[:, i, j])
        first = all_colours[kinds[0]]
        out[i, j] = first + (all_colours[kinds] - first).mean(0)
    return out


def resolve_backward(grad_picture, shade, request, background):
    """each sample gets the pixel's whole gradient, not its S-th part

    told by: divided by S | S-th | 1/S | / S | whole gradient | full gradient | number of samples
    """
    grad_shade = np.zeros(shade.shape)
    grad_background = np.zeros(background.shape)
    for s, i, j in np.ndindex(*request.shape):
        r = request[s, i, j]
        if r < 0:
            grad_background += grad_picture[i, j]
        else:
            grad_shade[r] += grad_picture[i, j]
    return grad_shade, grad_background


def resolve_backward(grad_picture, shade, request, background):
    """each request gets the S-th part once, even if it has several samples in the pixel

    told by: once | several samples | number of samples | how many samples | samples of & pixel | each sample
    """
    S, H, W = request.shape
    grad = np.zeros((len(shade) + 1, len(background)))
    for i in range(H):
        for j in range(W):
            for r in set(request[:, i, j].tolist()):
                grad[r] += grad_picture[i, j] / S
    return grad[:-1], grad[-1]


def resolve_backward(grad_picture, shade, request, background):
    """the gradient of a shade is the mean over its samples instead of their sum

    told by: mean instead | sum | averaged | mean over | divided by the number | requests & become a mean
    """
    S = len(request)
    parts = np.broadcast_to(grad_picture / S, (S, *grad_picture.shape))
    total = rasterization.scatter(parts, request + 1, len(shade) + 1)
    times = np.maximum(np.bincount((request + 1).ravel(), minlength=len(shade) + 1), 1)
    total = total / times[:, None]
    return total[1:], total[0]


def cost(face_index, sample_bytes):
    """no face, -1, is counted as one of the different faces

    told by: -1 & counted | no face | background | -1 & different | sees nothing
    """
    shades = 0
    S, H, W = face_index.shape
    for i in range(H):
        for j in range(W):
            shades += len(set(face_index[:, i, j].tolist()))
    return S * H * W, shades, S * H * W * sample_bytes
