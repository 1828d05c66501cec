"""Mistakes of lab 6; each docstring goes on after "this is what comes out when"."""


def look_up(texels, index, weight):
    """the weights are left out: it is the plain sum of the K texels"""
    return texels[index].sum(1)


def look_up(texels, index, weight):
    """the weights are ignored: it is the plain mean of the K texels"""
    return texels[index].mean(1)


def look_up(texels, index, weight):
    """it is divided by the sum of the weights, as a weighted mean is; they need not add up to 1,
    and are taken as they are"""
    return np.einsum("nk,nkc->nkc", weight, texels[index]).sum(1) / weight.sum(1, keepdims=True)


def look_up(texels, index, weight):
    """it is the mean of the K weighted texels instead of their sum: it is divided by K"""
    return np.einsum("nk,nkc->nkc", weight, texels[index]).mean(1)


def look_up(texels, index, weight):
    """only the last of the K texels is left, as each overwrites the one before instead of being
    added (+=)"""
    return weight[:, -1:] * texels[index[:, -1]]


def look_up(texels, index, weight):
    """the last of the K texels is left out"""
    return np.einsum("nk,nkc->nc", weight[:, :-1], texels[index[:, :-1]])


def look_up_backward(grad_colour, texels, index, weight):
    """a texel that is named several times keeps only the last gradient: grad[index] += ... adds
    only once, and = overwrites. All must be added, as np.add.at or M^T does"""
    grad_weight = np.einsum("nc,nkc->nk", grad_colour, texels[index])
    grad_texels = np.zeros(texels.shape)
    grad_texels[index] += weight[..., None] * grad_colour[:, None]
    return grad_texels, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """the weights are left out of grad_texels: each texel gets the whole gradient, not times its
    weight"""
    grad_weight = np.einsum("nc,nkc->nk", grad_colour, texels[index])
    grad_texels = np.zeros(texels.shape)
    for k in range(index.shape[1]):
        np.add.at(grad_texels, index[:, k], grad_colour)
    return grad_texels, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """grad_weight is the mean over the channels instead of their sum"""
    start = np.arange(0, index.size + 1, index.shape[1])
    matrix = csr_array((weight.ravel(), index.ravel(), start), (len(index), len(texels)))
    return matrix.T @ grad_colour, (grad_colour[:, None] * texels[index]).mean(-1)


def look_up_backward(grad_colour, texels, index, weight):
    """grad_weight is multiplied by the weight again: the derivative by a weight is the texel
    alone"""
    start = np.arange(0, index.size + 1, index.shape[1])
    matrix = csr_array((weight.ravel(), index.ravel(), start), (len(index), len(texels)))
    return matrix.T @ grad_colour, weight * (grad_colour[:, None] * texels[index]).sum(-1)


def bilinear_backward(grad_weight, uv, width, height):
    """the two weights of each axis are exchanged: row[0] and column[0] are 1 - a, row[1] and
    column[1] are a"""
    row_weight = linear_texels(uv[:, 1], height)[1][::-1]
    column_weight = linear_texels(uv[:, 0], width)[1][::-1]
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack([(grad_column[1] - grad_column[0]) * width,
                     (grad_row[1] - grad_row[0]) * height], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """the other factor of the product is left out: the gradient of a column's weight is
    multiplied by the row's weight, and that of a row's by the column's"""
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = grad_weight.sum(1)
    grad_column = grad_weight.sum(0)
    return np.stack([(grad_column[1] - grad_column[0]) * width,
                     (grad_row[1] - grad_row[0]) * height], -1)
