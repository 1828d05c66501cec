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
    """p = u (w - 1), as if u = 0 and u = 1 were the centres of the first and the last texel

    told by: w - 1 | size - 1 | align | first and & last texel | corners aligned | centres of the first
    """
    p = x * (size - 1)
    j = np.floor(p).astype(int)
    frac = p - j
    return np.stack((j, j + 1)), np.stack((1.0 - frac, frac))


def linear_texels(x, size):
    """p is rounded to the nearest number instead of down, so a weight can be negative

    told by: rounded | rounding | nearest | floor | weight & negative
    """
    p = x * size - 0.5
    j = np.round(p).astype(int)
    a = p - j
    return np.stack([j, j + 1]), np.stack([1 - a, a])


def look_up(texels, index, weight):
    """only the last texel of each row counts, because = stands for +=

    told by: last texel | += | overwrit | not added | only one texel | sum over k | added
    """
    colours = np.zeros((index.shape[0], texels.shape[1]))
    for n in range(index.shape[0]):
        for k in range(index.shape[1]):
            colours[n] = weight[n, k] * texels[index[n, k]]
    return colours


def look_up(texels, index, weight):
    """the colours are summed in float32

    told by: float32 | single precision | precision | float64 | 32 bit
    """
    values = texels.astype(np.float32)[index]
    return np.einsum("nk,nkc->nc", weight.astype(np.float32), values).astype(float)


def bilinear_backward(grad_weight, uv, width, height):
    """the chain rule's factors width and height are left out: da = w du

    told by: by width | da = w | width and height & left out | width and height & missing | chain rule | per texel | in texels
    """
    _, (r0, r1) = linear_texels(uv[:, 1], height)
    _, (c0, c1) = linear_texels(uv[:, 0], width)
    g00, g01, g10, g11 = grad_weight.T
    du = r0 * (g01 - g00) + r1 * (g11 - g10)
    dv = c0 * (g10 - g00) + c1 * (g11 - g01)
    return np.stack([du, dv], axis=-1)


def bilinear_backward(grad_weight, uv, width, height):
    """the last factors are exchanged: u's gradient is multiplied by the height, v's by the width

    told by: width and height | exchanged | swapped | height and width | by the height | u's & height
    """
    _, row = linear_texels(uv[:, 1], height)
    _, column = linear_texels(uv[:, 0], width)
    g = grad_weight.T
    grad_u = height * (row[0] * (g[1] - g[0]) + row[1] * (g[3] - g[2]))
    grad_v = width * (column[0] * (g[2] - g[0]) + column[1] * (g[3] - g[1]))
    return np.stack([grad_u, grad_v], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """the number 2 i + j is read with i as the column and j as the row

    told by: 2 i + j | i and j | j and i | row and column | rows and columns | transpos | column by column
    """
    _, row = linear_texels(uv[:, 1], height)
    _, column = linear_texels(uv[:, 0], width)
    result = np.zeros(uv.shape)
    for i in (0, 1):
        for j in (0, 1):
            g = grad_weight[:, 2 * j + i]
            result[:, 0] += g * row[i] * (2 * j - 1) * width
            result[:, 1] += g * column[j] * (2 * i - 1) * height
    return result


def bilinear_backward(grad_weight, uv, width, height):
    """the other axis' weights are left out: the differences of both rows are just added

    told by: other axis | row's weight | product rule | just added | weights & left out | without & weight
    """
    g00, g01, g10, g11 = grad_weight.T
    grad_u = (g01 - g00 + g11 - g10) * width
    grad_v = (g10 - g00 + g11 - g01) * height
    return np.stack([grad_u, grad_v], -1)
