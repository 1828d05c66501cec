"""Wrong answers to interpolation, written without a look at the checks."""


def fraction_in_space(t, w_0, w_1):
    """w_0 and w_1 are exchanged everywhere

    told by: exchanged | swapped | mixed up | w_1 instead of w_0 | w_0 instead of w_1 | other way round
    """
    return t * w_1 / (t * w_1 + (1 - t) * w_0)


def fraction_in_space(t, w_0, w_1):
    """the denominator is lerp(w_0, w_1, t): there t goes with w_1 instead of w_0

    told by: denominator | lerp(w_0, w_1 | lerp(w_1, w_0 | t w_1 | t * w_1 | (1 - t) w_0 | below the fraction
    """
    bottom = lerp(w_0, w_1, t)
    return w_0 * t / bottom


def fraction_in_space(t, w_0, w_1):
    """the numerator is t without its factor w_0

    told by: numerator | t w_0 | t * w_0 | times w_0 | factor w_0 | 1 / w_0
    """
    return t / (t * w_0 + (1 - t) * w_1)


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """grad_t forgets that t stands in the denominator, too: it is w_0 / v alone

    told by: denominator & t | quotient rule | w_0 / v | grad_t & quotient | grad_t & both
    """
    v = t * w_0 + (1 - t) * w_1
    grad_t = grad_q * w_0 / v
    grad_w_0 = grad_q * (t * v - t * w_0 * t) / v**2
    grad_w_1 = -grad_q * t * w_0 * (1 - t) / v**2
    return grad_t, grad_w_0, grad_w_1


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """multiplied by the interpolated w, but only 1 / w is linear on the screen

    told by: 1 / w | 1/w | lerp(w_0 | interpolated w | inverse | reciprocal | w & not linear
    """
    rows = []
    for fraction in t:
        over_w = (1 - fraction) * a_0 / w_0 + fraction * a_1 / w_1
        rows.append(over_w * ((1 - fraction) * w_0 + fraction * w_1))
    return np.array(rows)


def barycentric_from_screen(e, w):
    """multiplied by w instead of divided

    told by: multiplied | multiplies | multiply | e * w | times w | divided by w | division by w
    """
    n = e * w
    return n / np.sum(n, axis=-1, keepdims=True)


def barycentric_from_screen(e, w):
    """not normalised: the division by the sum s is missing

    told by: normal | sum to 1 | add up to 1 | divided by & sum | division by & sum | divided by s | n / s
    """
    n = e / w
    return n


def barycentric_from_screen(e, w):
    """the sum is over all pixels, not over the three corners of each

    told by: all pixels | whole array | axis | other pixels | all the pixels | three corners
    """
    n = e / w
    return n / n.sum()


def normalize_backward(grad_b, b, s, axis=0):
    """b times the sum of grad_b is subtracted, which is the forward rule: it must be the sum of grad_b b

    told by: forward | transpos | sum of grad_b | eq. (4) | inside the sum | grad_b & exchanged | grad_b & swapped
    """
    common = b * grad_b.sum(axis=axis, keepdims=True)
    return (grad_b - common) / s


def normalize_backward(grad_b, b, s, axis=0):
    """each n_k only feels its own b_k: the term has grad_b b without the sum over the three

    told by: its own | sum over | other weights | other two | all three | without the sum | diagonal
    """
    return grad_b * (1 - b) / s


def normalize_backward(grad_b, b, s, axis=0):
    """the sum is always over the last axis, the argument axis is ignored

    told by: axis | axes | along the wrong | last dimension | dimension
    """
    dot = np.sum(grad_b * b, axis=-1, keepdims=True)
    return (grad_b - dot) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    """= instead of +=: only the last corner's term remains

    told by: last corner | corner 2 | third corner | only one corner | += | overwr | add up
    """
    height, width = face_index.shape
    picture = np.zeros((height, width, attributes.shape[1]))
    for i in range(height):
        for j in range(width):
            f = face_index[i, j]
            if f < 0:
                continue
            for k in range(3):
                picture[i, j] = barycentric[i, j, k] * attributes[faces[f, k]]
    return picture


def interpolate_loop(attributes, faces, face_index, barycentric):
    """pixels without a face are not left out: -1 reads the last face

    told by: for -1 | -1 is | last face | no face | background | without a face | sees nothing
    """
    picture = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.ndindex(*face_index.shape):
        a, b, c = faces[face_index[i, j]]
        x, y, z = barycentric[i, j]
        picture[i, j] = x * attributes[a] + y * attributes[b] + z * attributes[c]
    return picture


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the picture is upside down: pixel i is written into row H - 1 - i

    told by: upside down | flipped | bottom | H - 1 - i | mirrored | rows & reverse
    """
    height, width = face_index.shape
    picture = np.zeros((height, width, attributes.shape[1]))
    for i in range(height):
        for j in range(width):
            if face_index[i, j] >= 0:
                corners = attributes[faces[face_index[i, j]]]
                picture[height - 1 - i, j] = barycentric[i, j] @ corners
    return picture


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_attributes is overwritten, not summed over the pixels: only the last pixel of a vertex counts

    told by: overwr | += | last pixel | sum & pixels | add up | adds up | accumulat
    """
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        corners = faces[face_index[i, j]]
        grad_attributes[corners] = np.outer(barycentric[i, j], grad_output[i, j])
        grad_barycentric[i, j] = attributes[corners] @ grad_output[i, j]
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_barycentric is the mean over the channels instead of the sum

    told by: mean & sum | mean & channel | channel & sum | average | 1 / C | divided by C
    """
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros(barycentric.shape)
    height, width = face_index.shape
    for i in range(height):
        for j in range(width):
            f = face_index[i, j]
            if f != -1:
                for k in range(3):
                    grad_attributes[faces[f, k]] += barycentric[i, j, k] * grad_output[i, j]
                    product = grad_output[i, j] * attributes[faces[f, k]]
                    grad_barycentric[i, j, k] = product.mean()
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """in grad_attributes the weights are missing: each corner gets the pixel's whole gradient

    told by: weights | weight & missing | barycentric & missing | whole gradient | full gradient | times b | without b
    """
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros(barycentric.shape)
    for i, j in zip(*np.nonzero(face_index >= 0)):
        corners = faces[face_index[i, j]]
        grad_attributes[corners] += grad_output[i, j]
        grad_barycentric[i, j] = attributes[corners] @ grad_output[i, j]
    return grad_attributes, grad_barycentric


def weight_rows(faces, face_index, barycentric):
    """start counts the seen pixels, but each of them has three entries

    told by: three entries | factor 3 | times 3 | 3 entries | counts pixels | counts the pixels | a third
    """
    is_seen = (face_index >= 0).ravel()
    start = np.zeros(is_seen.size + 1, int)
    for p in range(is_seen.size):
        start[p + 1] = start[p] + is_seen[p]
    vertex = faces[face_index.ravel()[is_seen]].ravel()
    weight = barycentric.reshape(-1, 3)[is_seen].ravel()
    return start, vertex, weight


def interpolate(attributes, faces, face_index, barycentric):
    """the pixels are taken as counted column by column instead of row by row

    told by: column by column | row by row | transpos | order of the pixels | reshape | (W, H
    """
    height, width = face_index.shape
    rows = interpolation_matrix(len(attributes), faces, face_index, barycentric) @ attributes
    return rows.reshape(width, height, -1).transpose(1, 0, 2)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """grad_barycentric is not 0 where no face is seen: there it is that of the last face

    told by: no face | last face | background | empty pixel | without a face | sees nothing | for -1 | face_index is -1
    """
    matrix = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    channels = attributes.shape[1]
    corners = attributes[faces[face_index]]
    grad_barycentric = np.einsum("ijc,ijkc->ijk", grad_output, corners)
    return matrix.T @ grad_output.reshape(-1, channels), grad_barycentric


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """dA/dx and dA/dy are exchanged

    told by: exchanged | swapped | mixed up | dA/dy first | reverse order | wrong order
    """
    dx = interpolate(attributes, faces, face_index, derivatives[:, :, :, 0])
    dy = interpolate(attributes, faces, face_index, derivatives[:, :, :, 1])
    return np.stack([dy, dx], axis=-1)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """the last two axes are exchanged: (H, W, 2, C) instead of (H, W, C, 2), so J is transposed

    told by: transpos | last two axes | (H, W, 2 | axes & exchanged | axes & swapped | order of the axes | shape
    """
    return np.stack([interpolate(attributes, faces, face_index, derivatives[..., d])
                     for d in range(2)], axis=2)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """db/dx is used for dA/dy as well

    told by: both & db/dx | dA/dy & db/dx | dA/dy & dA/dx & same | dA/dy & equal | db/dy is not used | ignores db/dy | twice | both derivatives are those by x
    """
    height, width = face_index.shape
    out = np.zeros((height, width, attributes.shape[1], 2))
    for d in range(2):
        out[..., d] = interpolate(attributes, faces, face_index, derivatives[..., 0])
    return out


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """grad_attributes holds only the part of dA/dx, that of dA/dy is not added

    told by: only & dA/dx | only x | dA/dy & missing | dA/dy & forgot | sum of both | both & add | without dA/dy
    """
    grad_derivatives = np.empty_like(derivatives)
    of_x, grad_derivatives[..., 0] = interpolate_backward(
        grad_output[..., 0], attributes, faces, face_index, derivatives[..., 0])
    of_y, grad_derivatives[..., 1] = interpolate_backward(
        grad_output[..., 1], attributes, faces, face_index, derivatives[..., 1])
    return of_x, grad_derivatives


def fraction_in_space(t, w_0, w_1):
    """the answer is 1 - q: the fraction is counted from the other end, with w_1 over the sum at t

    told by: 1 - q | other end | from corner 1 | ends & exchanged | ends & swapped | reversed | complement
    """
    near = (1 - t) * w_1
    far = t * w_0
    return near / (near + far)


def fraction_in_space(t, w_0, w_1):
    """multiplied by w where one must divide: t w_1 / (t w_1 + (1 - t) w_0), w_0 and w_1 exchanged

    told by: w_0 and w_1 & exchanged | w_0 and w_1 & swapped | w_1 & instead of w_0 | w_0 & instead of w_1 | mixed up & w | w_0 & w_1 & interchanged
    """
    top = t * w_1
    bottom = top + (1 - t) * w_0
    return top / bottom


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the v in grad_w_0 and grad_w_1 is taken as constant: only the numerator t w_0 is differentiated for w_0

    told by: denominator & constant | numerator only | only the numerator | quotient rule & w_0 | denominator & also | denominator & depends
    """
    below = t * w_0 + (1 - t) * w_1
    by_t = grad_q * w_0 * w_1 / below**2
    by_w_0 = grad_q * t / below
    by_w_1 = -grad_q * t * (1 - t) * w_0 / below**2
    return by_t, by_w_0, by_w_1


def barycentric_from_screen(e, w):
    """the sum goes over all pixels, not only over the three weights of one pixel

    told by: all pixels | whole array | sum & axis | last axis | each pixel & own sum | over everything | without an axis
    """
    over_w = e / w
    return over_w / np.sum(over_w)


def barycentric_from_screen(e, w):
    """the weights are multiplied by w instead of divided

    told by: multipl & w | times w | e w & instead | divide & w & instead | e * w | multipl & instead
    """
    product = e * w
    return product / np.sum(product, axis=-1, keepdims=True)


def normalize_backward(grad_b, b, s, axis=0):
    """the term for the sum s is left out: grad_b / s alone

    told by: s & constant | through the sum | through s | sum & left out | sum & missing | sum & forgot | grad_b / s | second term
    """
    return grad_b / s


def normalize_backward(grad_b, b, s, axis=0):
    """transposed: grad_b_k times the sum of b is subtracted, where b_k belongs to the sum with grad_b: b (sum grad_b) for sum (grad_b b)

    told by: sum of grad_b | sum grad_b | transpos | forward & instead | derivative & forward | grad_b . b | grad_b * b | b times the sum
    """
    everything = np.sum(grad_b, axis=axis, keepdims=True)
    return (grad_b - b * everything) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    """pixels without a face are not left out: -1 reads the last face

    told by: -1 | last face | no face & seen | background | empty pixel | without a face | not 0 where
    """
    rows, columns = face_index.shape
    picture = np.zeros((rows, columns, attributes.shape[1]))
    for r in range(rows):
        for c in range(columns):
            abc = faces[face_index[r, c]]
            picture[r, c] = barycentric[r, c] @ attributes[abc]
    return picture


def interpolate_loop(attributes, faces, face_index, barycentric):
    """face 0 is taken for no face: face_index > 0 instead of >= 0

    told by: face 0 | first face | > 0 | index 0 | face number 0
    """
    picture = np.zeros((*face_index.shape, attributes.shape[-1]))
    for i, j in np.argwhere(face_index > 0):
        triangle = attributes[faces[face_index[i, j]]]
        picture[i, j] = (barycentric[i, j][:, None] * triangle).sum(0)
    return picture


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_attributes is overwritten at each pixel, not summed: = for +=

    told by: overwrit | += | last pixel | not summed | not added | add up | sum over the pixels | sum & pixels
    """
    to_vertices = np.zeros(attributes.shape)
    to_weights = np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        corners = faces[face_index[i, j]]
        to_vertices[corners] = np.outer(barycentric[i, j], grad_output[i, j])
        to_weights[i, j] = attributes[corners] @ grad_output[i, j]
    return to_vertices, to_weights


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_barycentric multiplies the mean over the channels: mean for sum over C

    told by: mean | averag | / C | number of channels | 1/C | divided by the channels | factor & channels
    """
    to_vertices = np.zeros(attributes.shape)
    to_weights = np.zeros(barycentric.shape)
    height, width = face_index.shape
    for i in range(height):
        for j in range(width):
            if face_index[i, j] < 0:
                continue
            for k in range(3):
                v = faces[face_index[i, j], k]
                to_vertices[v] += barycentric[i, j, k] * grad_output[i, j]
                to_weights[i, j, k] = np.mean(grad_output[i, j] * attributes[v])
    return to_vertices, to_weights


def weight_rows(faces, face_index, barycentric):
    """start has no leading 0: it begins with the entries up to pixel 0, and row p is slipped by one

    told by: leading 0 | begin & 0 | first & start & 0 | start[0] | one too short | h w + 1 | slipped | one row | one pixel
    """
    flat = face_index.ravel()
    visible = flat >= 0
    counts = np.cumsum(3 * visible)
    begin = np.append(counts, counts[-1])
    return begin, faces[flat[visible]].ravel(), barycentric.reshape(-1, 3)[visible].ravel()


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """+= with an array of repeated vertices: each vertex gets the last of its pixels only

    told by: repeated | += | np.add.at | last pixel | only one pixel | several pixels | not summed | add up | overwrit
    """
    flat = grad_output.reshape(-1, attributes.shape[1])
    b = barycentric.reshape(-1, 3)
    by_vertex = np.zeros(attributes.shape)
    by_weight = np.zeros(b.shape)
    for pixel, corners in seen_corners(face_index, faces):
        for k in range(3):
            by_vertex[corners[k]] += b[pixel, k][:, None] * flat[pixel]
            by_weight[pixel, k] = (flat[pixel] * attributes[corners[k]]).sum(1)
    return by_vertex, by_weight.reshape(barycentric.shape)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """x and y are exchanged: the last axis has dA/dy first

    told by: x and y | dA/dy & first | exchanged | swapped | mixed up | order of the last axis
    """
    slopes = [interpolate(attributes, faces, face_index, derivatives[:, :, :, d]) for d in (1, 0)]
    return np.stack(slopes, axis=-1)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """x and y are stacked before the channels and reshaped, not put last: the channels and the directions are mixed up

    told by: reshape | channel & mixed | channel & axis | channels and & x | channel & direction | last axis | interleav | stack
    """
    along_x = interpolate(attributes, faces, face_index, derivatives[..., 0])
    along_y = interpolate(attributes, faces, face_index, derivatives[..., 1])
    both = np.concatenate([along_x, along_y], axis=-1)
    return both.reshape(*along_x.shape, 2)
