"""Wrong answers to interpolation, written without a look at the checks."""


def fraction_in_space(t, w_0, w_1):
    """the perspective is left out: the fraction on the screen is returned as it is

    told by: perspective | w is ignored | neither w | not use w | returned as it is | t itself | linear on the screen
    """
    return lerp(0.0, 1.0, t) + 0 * (w_0 + w_1)


def fraction_in_space(t, w_0, w_1):
    """the factor t is left out of the numerator

    told by: factor t | t is left out | t is missing | t is forgotten | numerator
    """
    total = t * w_0 + (1 - t) * w_1
    return w_0 / total


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the quotient rule's second term is missing: the denominator is taken for constant

    told by: quotient rule | denominator & constant | second term | -u dv | denominator's | denominator too
    """
    v = t * w_0 + (1 - t) * w_1
    return grad_q * w_0 / v, grad_q * t / v, np.zeros_like(grad_q / v)


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """all is divided by v instead of by v^2

    told by: v^2 | squared | square of & denominator | power | divided once | second power
    """
    v = t * w_0 + (1 - t) * w_1
    grad_t = grad_q * (w_0 * w_1) / v
    grad_w_0 = grad_q * t * (1 - t) * w_1 / v
    grad_w_1 = -grad_q * t * (1 - t) * w_0 / v
    return grad_t, grad_w_0, grad_w_1


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """the attributes themselves are interpolated, not A / w: the numerator is not divided by w

    told by: numerator | A / w | attributes & not divided by w | divide & attributes | A_0 / w
    """
    t = t[:, None]
    return lerp(a_0, a_1, t) / lerp(1 / w_0, 1 / w_1, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """linear on the screen: perspective is ignored

    told by: linear & screen | perspective | w is ignored | neither w | not use w | affine
    """
    out = np.zeros((len(t), len(a_0)))
    for n in range(len(t)):
        for c in range(len(a_0)):
            out[n, c] = a_0[c] + t[n] * (a_1[c] - a_0[c])
    return out


def corrected_barycentrics(e, w):
    """the sum is over all numbers of the array instead of over the three weights of one pixel

    told by: all numbers | whole array | all pixels | axis | last axis | several pixels | each pixel
    """
    n = e / w
    return n / np.sum(n)


def corrected_barycentrics(e, w):
    """e is normalised before the division by w instead of after it

    told by: sum of e | before & divi | normalised & before | e_0 + e_1 | do not sum to 1 | not add up to 1
    """
    screen = e / e.sum(-1, keepdims=True)
    return screen / w


def corrected_barycentrics(e, w):
    """the weights are divided by their euclidean length instead of by their sum

    told by: length | norm instead | euclid | sum of & squares | square root | 2-norm | L2
    """
    n = e / w
    return n / np.linalg.norm(n, axis=-1, keepdims=True)


def normalize_backward(grad_b, b, s, axis=0):
    """the sum s is taken for constant: the quotient rule's second term is left out

    told by: taken for constant | s as constant | second term | quotient rule | s depends | part of s | sum & constant
    """
    grad_n = np.array(grad_b, float)
    return grad_n / s


def normalize_backward(grad_b, b, s, axis=0):
    """this is the derivative forward, eq. (4), and not its transpose: b must stand inside of the sum

    told by: forward | eq. (4) | transpose | inside of the sum | inside the sum | outside the sum | normalize_derivative
    """
    return (grad_b - b * grad_b.sum(axis, keepdims=True)) / s


def normalize_backward(grad_b, b, s, axis=0):
    """only the diagonal of the derivative: a weight's influence on the other two is left out

    told by: diagonal | other two | each weight alone | other weights | off-diagonal | cross
    """
    return grad_b * (1 - b) / s


def normalize_backward(grad_b, b, s, axis=0):
    """the division by s is left out

    told by: by s | division & left out | divi & missing | division & forgotten | 1/s | not divided
    """
    inner = (grad_b * b).sum(axis=axis, keepdims=True)
    return grad_b - inner


def normalize_backward(grad_b, b, s, axis=0):
    """the second term is added instead of subtracted

    told by: added | sign | plus | subtract | + instead
    """
    return (grad_b + np.sum(grad_b * b, axis, keepdims=True)) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    """-1 is used as an index: pixels that see no face get the attributes of the last face

    told by: -1 & index | last face | no face | background | sees nothing
    """
    H, W = face_index.shape
    picture = np.zeros((H, W, attributes.shape[1]))
    for y in range(H):
        for x in range(W):
            a, b, c = attributes[faces[face_index[y, x]]]
            k = barycentric[y, x]
            picture[y, x] = k[0] * a + k[1] * b + k[2] * c
    return picture


def interpolate_loop(attributes, faces, face_index, barycentric):
    """only corner 2 is left, since each corner's term overwrites the one before instead of being added

    told by: overwrit | only corner 2 | last corner | += | not added | sum over the corners | instead of added
    """
    out = np.zeros(face_index.shape + (attributes.shape[1],))
    for i in range(face_index.shape[0]):
        for j in range(face_index.shape[1]):
            f = face_index[i, j]
            if f == -1:
                continue
            for k in range(3):
                out[i, j] = barycentric[i, j, k] * attributes[faces[f, k]]
    return out


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """only the first channel goes into grad_barycentric instead of the sum over all channels

    told by: first channel | channels | channel & only | all C | sum over C
    """
    ga = np.zeros(attributes.shape)
    gb = np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, v in enumerate(faces[face_index[i, j]]):
            ga[v] += barycentric[i, j, k] * grad_output[i, j]
            gb[i, j, k] = grad_output[i, j, 0] * attributes[v, 0]
    return ga, gb


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """`grad[vertices] += ...` for all pixels at once adds only once for a vertex that occurs several times

    told by: += | only once | several times | repeated | more than once | add.at | same vertex
    """
    seen = face_index >= 0
    corners = faces[face_index[seen]]
    g = grad_output[seen]
    grad_attributes = np.zeros_like(attributes, dtype=float)
    for k in range(3):
        grad_attributes[corners[:, k]] += barycentric[seen][:, k, None] * g
    grad_barycentric = np.zeros(barycentric.shape)
    grad_barycentric[seen] = (attributes[corners] * g[:, None]).sum(-1)
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_barycentric is not 0 where no face is seen: -1 is used as an index of the last face

    told by: -1 & index | no face | last face | background | sees nothing
    """
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.empty(barycentric.shape)
    for i, j in np.ndindex(*face_index.shape):
        corners = faces[face_index[i, j]]
        grad_barycentric[i, j] = attributes[corners] @ grad_output[i, j]
        if face_index[i, j] >= 0:
            for k in range(3):
                grad_attributes[corners[k]] += barycentric[i, j, k] * grad_output[i, j]
    return grad_attributes, grad_barycentric


def weight_rows(faces, face_index, barycentric):
    """start counts one entry for each seen pixel instead of three

    told by: three | 3 entries | one entry | factor 3 | times 3
    """
    seen = face_index.ravel() >= 0
    start = np.zeros(face_index.size + 1, int)
    start[1:] = np.cumsum(seen)
    vertex = faces[face_index.ravel()[seen]].ravel()
    return start, vertex, barycentric.reshape(-1, 3)[seen].ravel()


def weight_rows(faces, face_index, barycentric):
    """the entries come corner by corner, all corners 0 first, instead of pixel by pixel

    told by: corner by corner | pixel by pixel | order of | transpos | corners 0 first | corner 0 first
    """
    seen = face_index.ravel() >= 0
    start = np.concatenate([[0], np.cumsum(np.where(seen, 3, 0))])
    corners = faces[face_index.ravel()[seen]]
    weights = barycentric.reshape(-1, 3)[seen]
    return start, corners.T.ravel(), weights.T.ravel()


def weight_rows(faces, face_index, barycentric):
    """the leading 0 of start is missing, so start has H W numbers and each row is one too late

    told by: leading 0 | start[0] | begins with 0 | H W + 1 | first 0 | one too short | leading zero
    """
    start = []
    vertex = []
    weight = []
    for f, b in zip(face_index.ravel(), barycentric.reshape(-1, 3)):
        if f >= 0:
            vertex.extend(faces[f])
            weight.extend(b)
        start.append(len(vertex))
    return np.array(start), np.array(vertex, int), np.array(weight)


def interpolate(attributes, faces, face_index, barycentric):
    """-1 is used as an index: pixels that see no face get the attributes of the last face

    told by: -1 & index | last face | no face | background | sees nothing
    """
    corners = attributes[faces[face_index]]
    return np.einsum("hwk,hwkc->hwc", barycentric, corners)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """`grad[vertex] += ...` adds only once for a vertex that several pixels of a chunk see

    told by: += | only once | several | repeated | more than once | add.at | same vertex
    """
    C = attributes.shape[1]
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros((face_index.size, 3))
    flat = grad_output.reshape(-1, C)
    b = barycentric.reshape(-1, 3)
    for pixel, corners in seen_corners(face_index, faces):
        for k in range(3):
            grad_attributes[corners[k]] += b[pixel, k, None] * flat[pixel]
            grad_barycentric[pixel, k] = (flat[pixel] * attributes[corners[k]]).sum(-1)
    return grad_attributes, grad_barycentric.reshape(barycentric.shape)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """dA/dx and dA/dy are exchanged

    told by: exchanged | swapped | x and y | dx and dA/dy | mixed up | y first
    """
    dx = interpolate(attributes, faces, face_index, derivatives[..., 0])
    dy = interpolate(attributes, faces, face_index, derivatives[..., 1])
    return np.stack([dy, dx], axis=-1)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """x and y are stacked before the channels, so the result is (H, W, 2, C), J transposed

    told by: transpos | (H, W, 2, C) | before the channels | axes & order | axes & exchanged | last axis
    """
    both = [interpolate(attributes, faces, face_index, derivatives[..., d]) for d in range(2)]
    return np.stack(both, axis=2)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """dA/dy is negated, as if y pointed down

    told by: dA/dy & negat | dA/dy & sign | y pointed down | y points down | y down | y is flipped | -dA/dy
    """
    dA = [interpolate(attributes, faces, face_index, derivatives[..., axis]) for axis in (0, 1)]
    return np.stack([dA[0], -dA[1]], -1)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """x, y and the channels are mixed up by a reshape: both are put side by side, then cut into pairs

    told by: reshape | pairs | interleav | channels & mixed | channel & mixed | several channels | order of
    """
    dx = interpolate(attributes, faces, face_index, derivatives[..., 0])
    dy = interpolate(attributes, faces, face_index, derivatives[..., 1])
    H, W, C = dx.shape
    return np.concatenate([dx, dy], -1).reshape(H, W, C, 2)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """grad_attributes has only the part of x, that of y is left out

    told by: only & of x | of y & left out | of y & missing | sum of both | both & sum | part of y
    """
    result = []
    for axis in range(2):
        result.append(interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                           derivatives[..., axis]))
    return result[0][0], np.stack([r[1] for r in result], -1)
