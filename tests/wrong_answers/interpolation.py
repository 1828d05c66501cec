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


def corrected_barycentrics(e, w):
    """multiplied by w instead of divided

    told by: multiplied | multiplies | multiply | e * w | times w | divided by w | division by w
    """
    n = e * w
    return n / np.sum(n, axis=-1, keepdims=True)


def corrected_barycentrics(e, w):
    """not normalised: the division by the sum s is missing

    told by: normal | sum to 1 | add up to 1 | divided by & sum | division by & sum | divided by s | n / s
    """
    n = e / w
    return n


def corrected_barycentrics(e, w):
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
    """w_0 and w_1 are exchanged, which is the way from space to the screen

    told by: exchanged | swapped | w_1 instead of w_0 | space to & screen | inverse | mixed up | wrong way
    """
    near = t * w_1
    far = (1 - t) * w_0
    return near / (near + far)


def fraction_in_space(t, w_0, w_1):
    """the fraction is counted from corner 1: 1 - q is returned

    told by: 1 - q | from corner 1 | other end | reversed | 0 at corner 1 | 1 at corner 0 | wrong end
    """
    a = (1 - t) * w_1
    b = t * w_0
    return a / (a + b)


def fraction_in_space(t, w_0, w_1):
    """w_0 and w_1 are exchanged in the denominator only

    told by: denominator | divisor | divided by lerp | lerp & exchanged | lerp & swapped
    """
    return t * w_0 / lerp(w_0, w_1, t)


def fraction_in_space(t, w_0, w_1):
    """the denominator is w_0 + w_1 without the weights t and 1 - t

    told by: w_0 + w_1 | sum of & w | not weighted | without the weights | without t | denominator | factor & 1 - t & left out
    """
    return t * w_0 / (w_0 + w_1)


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the gradient of w_1 has the wrong sign

    told by: w_1 & sign | w_1 & negative | w_1 & minus | w_1 & opposite
    """
    v = lerp(w_1, w_0, t)
    g = grad_q / (v * v)
    both = t * (1 - t) * g
    return g * w_0 * w_1, both * w_1, both * w_0


def corrected_barycentrics(e, w):
    """e is multiplied by w instead of divided by it

    told by: multipl | times w | e w | not divided by w | e_k w_k
    """
    n = e * w
    return n / n.sum(axis=-1, keepdims=True)


def corrected_barycentrics(e, w):
    """the sum is along the first axis, over the pixels, instead of along the last

    told by: first axis | axis 0 | last axis | wrong axis | over the pixels | axis
    """
    n = e / w
    total = n.sum(0)
    return n / total


def corrected_barycentrics(e, w):
    """negative weights are set to 0, although a point beside the face has them

    told by: negative | clip | below 0 | beside the face | outside the face
    """
    n = np.maximum(e / w, 0)
    return n / n.sum(-1, keepdims=True)


def normalize_backward(grad_b, b, s, axis=0):
    """the axis is ignored, the sum is always along the first one

    told by: axis | along the first | always 0
    """
    mixed = sum(g * weight for g, weight in zip(grad_b, b))
    return (grad_b - mixed) / s


def normalize_backward(grad_b, b, s, axis=0):
    """b is taken to sum to 1, which is not so in lab 7, where s is more than the sum of n (fine print)

    told by: sum to 1 | sums to 1 | lab 7 | small constant | sum to less | sum of b | add up to 1
    """
    total = b.sum(axis, keepdims=True)
    return (grad_b * total - (grad_b * b).sum(axis, keepdims=True)) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    """face 0 is left out, because > 0 stands for >= 0

    told by: face 0 | > 0 | >= 0 | first face | number 0
    """
    height, width = face_index.shape
    out = np.zeros((height, width, attributes.shape[1]))
    for i in range(height):
        for j in range(width):
            if face_index[i, j] > 0:
                corners = faces[face_index[i, j]]
                out[i, j] = barycentric[i, j] @ attributes[corners]
    return out


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the corners' order is reversed: b_0 belongs to corner 2 and b_2 to corner 0

    told by: order | reversed | 0 and 2 are exchanged & faces | exchanged & corner | swapped & corner | corner & 0 and 2 | wrong corner | other corner
    """
    out = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in zip(*np.nonzero(face_index >= 0)):
        v0, v1, v2 = faces[face_index[i, j]]
        b2, b1, b0 = barycentric[i, j]
        out[i, j] = b0 * attributes[v0] + b1 * attributes[v1] + b2 * attributes[v2]
    return out


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the attributes are read at the number of the face and the next two, not at the face's vertices

    told by: number of the face | faces & not used | faces & ignored | face's number | face number | faces[ | face index
    """
    V, C = attributes.shape
    out = np.zeros((*face_index.shape, C))
    for i, j in np.ndindex(*face_index.shape):
        f = face_index[i, j]
        if f >= 0:
            for k in range(3):
                out[i, j] += barycentric[i, j, k] * attributes[(f + k) % V]
    return out


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the mean of the corners' attributes, without the weights b

    told by: mean of | without & weights | weights & ignored | equal weights | barycentric & not used | weights b
    """
    out = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        out[i, j] = attributes[faces[face_index[i, j]]].mean(axis=0)
    return out


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """a vertex keeps the gradient of the last pixel that sees it: = stands for +=

    told by: last pixel | += | overwrit | summed over the pixels | not added | only one pixel | sum over
    """
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros(barycentric.shape)
    H, W = face_index.shape
    for i in range(H):
        for j in range(W):
            if face_index[i, j] < 0:
                continue
            for k in range(3):
                v = faces[face_index[i, j], k]
                grad_attributes[v] = barycentric[i, j, k] * grad_output[i, j]
                grad_barycentric[i, j, k] = np.dot(grad_output[i, j], attributes[v])
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """each corner gets the whole gradient of the pixel, without the factor b_k

    told by: b_k | whole gradient | full gradient | not weighted | without & weight | without & barycentric | barycentric & missing
    """
    grad_a = np.zeros(attributes.shape)
    grad_b = np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index != -1):
        corners = faces[face_index[i, j]]
        for v in corners:
            grad_a[v] += grad_output[i, j]
        grad_b[i, j] = attributes[corners] @ grad_output[i, j]
    return grad_a, grad_b


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """the mean of grad_barycentric's three numbers is subtracted, as if the weights had to sum to 1

    told by: mean & subtract | sum to 1 | sums to 1 | projected | two of the three | add up to 1 | independent
    """
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        v = faces[face_index[i, j]]
        np.add.at(grad_attributes, v, np.outer(barycentric[i, j], grad_output[i, j]))
        g = attributes[v] @ grad_output[i, j]
        grad_barycentric[i, j] = g - g.mean()
    return grad_attributes, grad_barycentric


def interpolate(attributes, faces, face_index, barycentric):
    """the rows of the product are laid out column by column, as if the pixels were counted that way

    told by: column by column | row by row | transpos | rows and columns | columns and rows | reshape | order
    """
    B = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    H, W = face_index.shape
    return (B @ attributes).reshape(W, H, -1).transpose(1, 0, 2)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """the two gradients are returned in the wrong order

    told by: order | exchanged | swapped | first & second | other way round
    """
    B = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    flat = grad_output.reshape(face_index.size, -1)
    grad_b = np.zeros((face_index.size, 3))
    for pixel, corners in seen_corners(face_index, faces):
        grad_b[pixel] = np.einsum("nc,knc->nk", flat[pixel], attributes[corners])
    return grad_b.reshape(barycentric.shape), B.T @ flat


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """the term of corner 2 is left out, only differences to two corners are added

    told by: corner 2 | third corner | last corner | two corners | db_2 | only two
    """
    H, W = face_index.shape
    out = np.zeros((H, W, attributes.shape[1], 2))
    for i in range(H):
        for j in range(W):
            if face_index[i, j] < 0:
                continue
            for k in range(2):
                v = faces[face_index[i, j], k]
                out[i, j] += np.outer(attributes[v], derivatives[i, j, k])
    return out


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """where no face is seen the result is not 0 but that of the last face, as -1 is used as an index

    told by: -1 & index | no face | last face | background | sees nothing
    """
    at_corners = attributes[faces[face_index]]
    return np.einsum("hwkc,hwkd->hwcd", at_corners, derivatives)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """the mean of x's and y's gradients instead of their sum goes to the attributes

    told by: mean | half | sum of both | averag | twice | factor 2
    """
    ax, bx = interpolate_backward(grad_output[..., 0], attributes, faces, face_index,
                                  derivatives[..., 0])
    ay, by = interpolate_backward(grad_output[..., 1], attributes, faces, face_index,
                                  derivatives[..., 1])
    return (ax + ay) / 2, np.stack([bx, by], axis=3)
