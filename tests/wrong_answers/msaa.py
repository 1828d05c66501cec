"""Wrong answers to msaa, written without a look at the checks."""


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


def coverage(face_index):
    """face 0 is taken for no face: > 0 instead of >= 0

    told by: face 0 | > 0 | >= 0 | number 0 | first face | face & zero
    """
    return np.mean(face_index > 0, axis=0)


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


def resolve(shade, request, background):
    """the mean is over the covered samples only: the background does not count where a face is seen

    told by: covered samples | background & mix | background & ignored | background & left out | background & not count | divided by & covered | number of covered
    """
    table = np.concatenate([shade, background[None]])
    covered = request >= 0
    number = covered.sum(0)[..., None]
    total = (table[request] * covered[..., None]).sum(0)
    return np.where(number > 0, total / np.maximum(number, 1), background)


def resolve_backward(grad_picture, shade, request, background):
    """+= with an index array keeps one of several samples with the same request, they do not add up

    told by: add up | adds up | += | overwr | np.add.at | only the last | accumulat
    """
    part = grad_picture / len(request)
    total = np.zeros((len(shade) + 1, grad_picture.shape[-1]))
    for s in range(len(request)):
        total[request[s]] += part
    return total[:-1], total[-1]
