"""Wrong answers to texturing, written without a look at the checks."""


def linear_texels(x, size):
    """p is u (w - 1), as if the first and the last texel's centres were at 0 and 1 (align_corners)

    told by: w - 1 | size - 1 | align_corners | align corners | centres & ends | last texel's centre
    """
    p = np.asarray(x) * (size - 1)
    j = np.floor(p).astype(int)
    a = p - j
    return np.array([j, j + 1]), np.array([1 - a, a])


def linear_texels(x, size):
    """the two weights are exchanged: a goes to j instead of j + 1

    told by: exchanged | swapped | 1 - a | mixed up | reversed | farther
    """
    p = x * size - 0.5
    j = np.floor(p)
    a = p - j
    return np.stack([j, j + 1]).astype(int), np.stack([a, 1 - a])


def linear_texels(x, size):
    """the half texel is added instead of subtracted

    told by: half & added | half & sign | + 1/2 | + 0.5 | next texel | plus & half | one texel
    """
    p = x * size + 0.5
    j = np.floor(p).astype(int)
    return np.stack([j, j + 1]), np.stack([1 - (p - j), p - j])


def look_up(texels, index, weight):
    """the mean over the K texels instead of the sum: divided by K

    told by: mean & sum | mean over | mean of | divided by K | division by K | averag | 1 / K
    """
    return np.mean(weight[:, :, None] * texels[index], axis=1)


def look_up(texels, index, weight):
    """the weights are normalised to sum to 1

    told by: normal | sum to 1 | add up to 1 | sum of the weights | sum of its weights
    """
    out = np.zeros((len(index), texels.shape[1]))
    for n in range(len(index)):
        share = weight[n] / weight[n].sum()
        for t, part in zip(index[n], share):
            out[n] += part * texels[t]
    return out


def look_up(texels, index, weight):
    """a texel that is named twice in a row counts once: its weights overwrite each other in M instead of adding up

    told by: twice | overwr | same texel | more than once | several times | adds up | add up
    """
    M = np.zeros((len(index), len(texels)))
    M[np.arange(len(index))[:, None], index] = weight
    return M @ texels


def look_up_backward(grad_colour, texels, index, weight):
    """grad_weight is multiplied by the weight itself

    told by: grad_weight & itself | times the weight | times weight | multiplied by & weight | does not depend on weight | weight too many | weight once more
    """
    grad_texels = np.zeros(texels.shape)
    grad_weight = np.zeros(weight.shape)
    for n in range(len(index)):
        for k in range(index.shape[1]):
            grad_texels[index[n, k]] += weight[n, k] * grad_colour[n]
            grad_weight[n, k] = weight[n, k] * (grad_colour[n] @ texels[index[n, k]])
    return grad_texels, grad_weight


def bilinear_backward(grad_weight, uv, width, height):
    """the factors width and height are missing: the result is a gradient by texels, not by u and v

    told by: width & missing | factor & width | da = w du | in texels | per texel | times the width | multiplied by & width
    """
    _, rows = linear_texels(uv[:, 1], height)
    _, columns = linear_texels(uv[:, 0], width)
    g = grad_weight.reshape(-1, 2, 2)
    by_u = rows[0] * (g[:, 0, 1] - g[:, 0, 0]) + rows[1] * (g[:, 1, 1] - g[:, 1, 0])
    by_v = columns[0] * (g[:, 1, 0] - g[:, 0, 0]) + columns[1] * (g[:, 1, 1] - g[:, 0, 1])
    return np.column_stack([by_u, by_v])


def bilinear_backward(grad_weight, uv, width, height):
    """the other axis's weights are missing: the four differences are added without row and column weights

    told by: other axis | other direction | row weight | column weight | product rule | unweighted | not weighted | other factor & product | other axis' weights
    """
    g = grad_weight.reshape(-1, 2, 2)
    by_u = g[:, :, 1].sum(1) - g[:, :, 0].sum(1)
    by_v = g[:, 1].sum(1) - g[:, 0].sum(1)
    return np.stack([by_u * width, by_v * height], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """the four weights are read as 2 j + i, columns before rows

    told by: 2 j + i | 2 i + j | order of the four | transpos | rows and columns | columns before rows | column by column
    """
    _, (r0, r1) = linear_texels(uv[:, 1], height)
    _, (c0, c1) = linear_texels(uv[:, 0], width)
    out = np.empty(uv.shape)
    g00, g10, g01, g11 = grad_weight.T
    out[:, 0] = (r0 * (g01 - g00) + r1 * (g11 - g10)) * width
    out[:, 1] = (c0 * (g10 - g00) + c1 * (g11 - g01)) * height
    return out


def footprint_points(uv, jacobian, n):
    """J is transposed: d is a row vector times J

    told by: transpos | row vector | J^T | rows and columns | d @ J | columns of J
    """
    steps = (np.arange(n) + 0.5) / n - 0.5
    points = []
    for y in steps:
        for x in steps:
            points.append(uv + np.array([x, y]) @ jacobian)
    return np.array(points)


def linear_texels(x, size):
    """the half texel is missing: p = w u, as if a texel's centre were at j / w

    told by: half a texel | half texel | 0.5 | centre & texel | - 1/2 | shift & half
    """
    p = x * size
    low = np.floor(p)
    part = p - low
    j = low.astype(int)
    return np.stack([j, j + 1]), np.stack([1 - part, part])


def linear_texels(x, size):
    """the two weights are exchanged: a belongs to j, and 1 - a to j + 1

    told by: weights & exchanged | weights & swapped | weights & mixed up | wrong way round | weights & interchanged | weights & reversed
    """
    p = x * size - 0.5
    j = np.floor(p).astype(int)
    a = p - j
    return np.array([j, j + 1]), np.array([a, 1 - a])


def look_up(texels, index, weight):
    """the mean over the K texels, not the sum

    told by: mean | averag | divided by K | / K | factor K | 1/K | K times
    """
    gathered = texels[index]
    return (gathered * weight[..., None]).mean(axis=1)


def look_up(texels, index, weight):
    """the colours are added up in float32

    told by: float32 | single precision | digits | precision | 32 bit | rounded
    """
    colours = np.zeros((len(index), texels.shape[1]), dtype=np.float32)
    for k in range(index.shape[1]):
        colours += weight[:, k, None] * texels[index[:, k]]
    return colours


def look_up_backward(grad_colour, texels, index, weight):
    """grad_texels is added with += at repeated indices: only the last of several look-ups counts

    told by: repeated | += | np.add.at | several times | only the last | named many times | add up | overwrit | more than once
    """
    to_texels = np.zeros(texels.shape)
    to_texels[index] += weight[..., None] * grad_colour[:, None]
    to_weight = (grad_colour[:, None] * texels[index]).sum(-1)
    return to_texels, to_weight


def bilinear_backward(grad_weight, uv, width, height):
    """rows and columns are exchanged in grad_weight: 2 j + i instead of 2 i + j

    told by: 2 i + j | rows and columns | row & column & exchanged | transpos | row & column & swapped | row & column & mixed up
    """
    _, row = linear_texels(uv[:, 1], height)
    _, column = linear_texels(uv[:, 0], width)
    to_row = np.zeros((2, len(uv)))
    to_column = np.zeros((2, len(uv)))
    for i in range(2):
        for j in range(2):
            g = grad_weight[:, i + 2 * j]
            to_row[i] += g * column[j]
            to_column[j] += g * row[i]
    return np.stack([width * (to_column[1] - to_column[0]), height * (to_row[1] - to_row[0])], 1)


def bilinear_backward(grad_weight, uv, width, height):
    """width and height are left out: the gradient is for u and v in texels

    told by: width & height & missing | width & height & left out | factor & width | in texels | times width | da = w du | size & factor | width & forgot | chain rule
    """
    _, (top, bottom) = linear_texels(uv[:, 1], height)
    _, (left, right) = linear_texels(uv[:, 0], width)
    g = grad_weight.T
    by_u = top * (g[1] - g[0]) + bottom * (g[3] - g[2])
    by_v = left * (g[2] - g[0]) + right * (g[3] - g[1])
    return np.stack([by_u, by_v], axis=-1)
