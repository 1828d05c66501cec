"""Mistakes of lab 6; each docstring goes on after "this is what comes out when"."""


def linear_texels(x, size):
    """the half texel is forgotten: p = w u instead of w u - 1/2. Texel j is taken to lie at j / w,
    which is its border, not its centre"""
    position = x * size
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


def linear_texels(x, size):
    """the two weights are exchanged: 1 - a is that of texel j, and a that of j + 1"""
    position = x * size - 0.5
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([weight, 1 - weight])


def linear_texels(x, size):
    """a negative number is cut (truncated) towards 0, as astype(int) does, instead of by floor:
    below 0 it is one too high"""
    position = x * size - 0.5
    first = np.trunc(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


def linear_texels(x, size):
    """the numbers are already clipped (clamped) to the texture. They may lie outside of it: the
    boundary comes later"""
    position = x * size - 0.5
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return (np.clip(np.stack([first, first + 1]), 0, np.asarray(size) - 1),
            np.stack([1 - weight, weight]))


def linear_texels(x, size):
    """half a texel is added instead of subtracted: p = w u - 1/2"""
    position = x * size + 0.5
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


def linear_texels(x, size):
    """p is x (size - 1), as if the first and the last centre were the corners of the texture
    (align corners). It is w u - 1/2"""
    position = x * (size - 1)
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


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
    """the factors width and height are left out: u runs from 0 to 1, and w u from 0 to the width"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack([(grad_column[1] - grad_column[0]),
                     (grad_row[1] - grad_row[0])], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """width and height are exchanged: the gradient of u has the factor width, that of v height"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack(
        [(grad_column[1] - grad_column[0]) * height, (grad_row[1] - grad_row[0]) * width], -1
    )


def bilinear_backward(grad_weight, uv, width, height):
    """the results come in the order v, u: the gradients of u and v are exchanged"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack(
        [(grad_row[1] - grad_row[0]) * height, (grad_column[1] - grad_column[0]) * width], -1
    )


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
    """the four texels are taken column by column, as if weight 2 j + i were row[i] column[j].
    They go row by row, 2 i + j"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1).swapaxes(0, 1)
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


def footprint_points(uv, jacobian, n):
    """d is measured from the pixel's lower left corner instead of its centre"""
    offset = (np.arange(n) + 0.5) / n
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)


def footprint_points(uv, jacobian, n):
    """the Jacobian is transposed: its columns are multiplied by d instead of its rows"""
    offset = (np.arange(n) + 0.5) / n - 0.5
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None]).sum(-2)


def footprint_points(uv, jacobian, n):
    """the points come column by column instead of row by row"""
    offset = (np.arange(n) + 0.5) / n - 0.5
    d = np.stack(np.meshgrid(offset, offset, indexing="ij"), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)


def footprint_points(uv, jacobian, n):
    """d goes from edge to edge of the pixel, -1/2 to 1/2 as by linspace, instead of to the
    centres of the squares"""
    offset = np.linspace(-0.5, 0.5, n)
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)
