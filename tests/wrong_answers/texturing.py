"""Wrong answers to texturing, written without a look at the checks."""


def linear_texels(x, size):
    """the half texel is forgotten: p = w u instead of w u - 1/2

    told by: half a texel | half texel | 1/2 | - 0.5 | centre & texel | corner & texel
    """
    p = np.asarray(x * size)
    j = np.floor(p).astype(int)
    a = p - j
    return np.stack([j, j + 1]), np.stack([1 - a, a])


def linear_texels(x, size):
    """astype(int) cuts towards 0 instead of floor, so a negative p gets the wrong texel

    told by: towards 0 | toward 0 | floor | negative | truncat | towards zero | astype
    """
    p = x * size - 0.5
    j = p.astype(int)
    a = p - j
    return np.array([j, j + 1]), np.array([1 - a, a])


def linear_texels(x, size):
    """the two weights are exchanged: a belongs to texel j and 1 - a to j + 1

    told by: exchanged | swapped | a of j | 1 - a & j + 1 | other texel | mixed up | reversed
    """
    position = x * size - 0.5
    lower = np.floor(position).astype(int)
    t = position - lower
    return np.stack([lower, lower + 1]), np.stack([t, 1 - t])


def linear_texels(x, size):
    """the numbers are already clipped to the texture, although they may lie outside of it

    told by: clip | clamp | outside | boundary | below 0 | beyond
    """
    p = x * size - 0.5
    j = np.floor(p)
    a = p - j
    first = np.clip(j, 0, size - 1).astype(int)
    second = np.clip(j + 1, 0, size - 1).astype(int)
    return np.stack([first, second]), np.stack([1 - a, a])


def linear_texels(x, size):
    """the second texel is j - 1 instead of j + 1

    told by: j - 1 | left & right | one before | on the other side | j + 1 | lower neighbour
    """
    p = x * size - 0.5
    j = np.floor(p).astype(int)
    a = p - j
    return np.stack([j, j - 1]), np.stack([1 - a, a])


def look_up(texels, index, weight):
    """the weights are ignored: the plain mean of the K texels

    told by: weights are ignored | plain mean | mean of | without & weight | not weighted | equal weight | weights & not used
    """
    return texels[index].mean(axis=1)


def look_up(texels, index, weight):
    """the sum is divided by the sum of the weights, which must not be made 1

    told by: sum of the weights | normalis | divided by | weights sum to 1 | add up to 1 | weighted mean
    """
    gathered = texels[index]
    total = (gathered * weight[:, :, None]).sum(1)
    return total / weight.sum(1, keepdims=True)


def look_up(texels, index, weight):
    """a row that names a texel twice keeps only one of its weights in the matrix

    told by: twice | several times | more than once | same texel | only one of | repeated | overwrit
    """
    M = np.zeros((len(index), len(texels)))
    M[np.arange(len(index))[:, None], index] = weight
    return M @ texels


def look_up(texels, index, weight):
    """the last of the K texels is left out

    told by: last texel | last one | K - 1 | texel & left out | off by one | all but
    """
    N, K = index.shape
    colours = np.zeros((N, texels.shape[1]))
    for k in range(K - 1):
        colours += weight[:, k:k + 1] * texels[index[:, k]]
    return colours


def look_up_backward(grad_colour, texels, index, weight):
    """`grad[index] += ...` adds only once where a texel is named several times

    told by: += | only once | several times | repeated | many times | more than once | add.at
    """
    grad_texels = np.zeros(texels.shape)
    grad_texels[index] += weight[..., None] * grad_colour[:, None, :]
    grad_weight = (texels[index] * grad_colour[:, None, :]).sum(-1)
    return grad_texels, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """grad_weight is multiplied by the weight again

    told by: multiplied by the weight | times the weight | weight again | factor weight | weight & twice
    """
    grad_texels = np.zeros(texels.shape)
    grad_weight = np.zeros(weight.shape)
    for n in range(len(index)):
        for k in range(index.shape[1]):
            t = index[n, k]
            grad_texels[t] += weight[n, k] * grad_colour[n]
            grad_weight[n, k] = weight[n, k] * (grad_colour[n] @ texels[t])
    return grad_texels, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """the gradients of the texels are gathered without the factor weight

    told by: without & weight | not weighted | weight & left out | weight & missing | whole gradient | weight & forgotten
    """
    grad_texels = np.zeros(texels.shape)
    for k in range(index.shape[1]):
        np.add.at(grad_texels, index[:, k], grad_colour)
    grad_weight = np.einsum("nc,nkc->nk", grad_colour, texels[index])
    return grad_texels, grad_weight


def bilinear_backward(grad_weight, uv, width, height):
    """the sign is flipped, since the derivative of 1 - a is taken for 1 and that of a for -1

    told by: sign | derivative of 1 - a | opposite | negative | minus
    """
    row = linear_texels(uv[:, 1], height)[1]
    column = linear_texels(uv[:, 0], width)[1]
    g = grad_weight.reshape(-1, 2, 2)
    by_column = np.einsum("nij,in->jn", g, row)
    by_row = np.einsum("nij,jn->in", g, column)
    return np.stack([(by_column[0] - by_column[1]) * width,
                     (by_row[0] - by_row[1]) * height], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """the results come in the order v, u

    told by: order | v, u | exchanged | swapped | u and v | v first | mixed up
    """
    _, row = linear_texels(uv[:, 1], height)
    _, column = linear_texels(uv[:, 0], width)
    pairs = grad_weight.T.reshape(2, 2, -1)
    along_row = (pairs * column).sum(1)
    along_column = (pairs * row[:, None]).sum(0)
    grad_u = (along_column[1] - along_column[0]) * width
    grad_v = (along_row[1] - along_row[0]) * height
    return np.column_stack([grad_v, grad_u])


def bilinear_backward(grad_weight, uv, width, height):
    """central differences give the mean of both sides on a texel's centre, not the derivative for larger u (fine print)

    told by: central difference | finite difference | texel's centre | centre of a texel | both sides | corner of the weights | for a larger
    """
    def value(u, v):
        _, row = linear_texels(v, height)
        _, column = linear_texels(u, width)
        first, _ = linear_texels(uv[:, 1], height)
        start, _ = linear_texels(uv[:, 0], width)
        p = u * width - 0.5 - start[0]
        q = v * height - 0.5 - first[0]
        # the four weights go on as hats beyond their own square
        column = np.maximum(1 - np.abs(p - np.array([[0], [1]])), 0)
        row = np.maximum(1 - np.abs(q - np.array([[0], [1]])), 0)
        return sum(grad_weight[:, 2 * i + j] * row[i] * column[j] for i in (0, 1) for j in (0, 1))

    eps = 1e-5
    u, v = uv.T
    du = (value(u + eps, v) - value(u - eps, v)) / (2 * eps)
    dv = (value(u, v + eps) - value(u, v - eps)) / (2 * eps)
    return np.stack([du, dv], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """width and height are multiplied as one pair, which fails when they are arrays (N,) (fine print)

    told by: arrays | array (N | (N,) | broadcast | levels | one for each
    """
    _, row = linear_texels(uv[:, 1], height)
    _, column = linear_texels(uv[:, 0], width)
    a, b, c, d = grad_weight.T
    slope = np.stack([(b - a) * row[0] + (d - c) * row[1],
                      (c - a) * column[0] + (d - b) * column[1]], -1)
    return slope * np.array([width, height])


def footprint_points(uv, jacobian, n):
    """J is transposed: its columns are multiplied instead of its rows

    told by: transpos | J^T | rows and columns | columns instead of | columns and rows | exchanged
    """
    offset = (np.arange(n) + 0.5) / n - 0.5
    points = []
    for dy in offset:
        for dx in offset:
            points.append(uv + dx * jacobian[:, 0] + dy * jacobian[:, 1])
    return np.array(points)


def footprint_points(uv, jacobian, n):
    """d goes from edge to edge of the pixel, -1/2 to 1/2, instead of to the squares' centres

    told by: edge | linspace | -1/2 to 1/2 | centres | border | corner
    """
    t = np.linspace(-0.5, 0.5, n)
    dx, dy = np.meshgrid(t, t)
    d = np.stack([dx.ravel(), dy.ravel()], -1)
    return uv[None] + np.einsum("nij,kj->kni", jacobian, d)


def footprint_points(uv, jacobian, n):
    """the points come column by column instead of row by row

    told by: column by column | row by row | order | x and y | columns first | indexing
    """
    t = (np.arange(n) + 0.5) / n - 0.5
    dx, dy = np.meshgrid(t, t, indexing="ij")
    d = np.stack([dx.ravel(), dy.ravel()], -1)
    return uv[None] + np.einsum("nij,kj->kni", jacobian, d)
