"""Mistakes of lab 6; each docstring goes on after "this is what comes out when"."""


def linear_texels(x, size):
    """texel j is taken to lie at j / size, which is its border, not its centre"""
    position = x * size
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


def linear_texels(x, size):
    """the two weights are swapped"""
    position = x * size - 0.5
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([weight, 1 - weight])


def linear_texels(x, size):
    """it is cut towards 0: below 0 it is one too high"""
    position = x * size - 0.5
    first = np.trunc(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


def look_up(texels, index, weight):
    """the weights are left out"""
    return texels[index].sum(1)


def look_up(texels, index, weight):
    """it is divided by the sum of the weights; they are taken as they are"""
    return np.einsum("nk,nkc->nkc", weight, texels[index]).sum(1) / weight.sum(1, keepdims=True)


def look_up(texels, index, weight):
    """it is the mean of the weighed texels instead of their sum"""
    return np.einsum("nk,nkc->nkc", weight, texels[index]).mean(1)


def look_up_backward(grad_colour, texels, index, weight):
    """a texel that a row names twice gets one of its gradients; they add up"""
    grad_weight = in_parts(lambda grad, texel: np.einsum("nc,nkc->nk", grad, texels.take(texel, 0)),
                           grad_colour, index)
    grad_texels = np.zeros(texels.shape)
    for at, w, g in zip(index, weight, grad_colour, strict=True):
        grad_texels[at] += w[:, None] * g
    return grad_texels, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """each texel gets the whole gradient, not its weight's"""
    start = np.arange(0, index.size + 1, index.shape[1])
    matrix = csr_array((weight.ravel(), index.ravel(), start), (len(index), len(texels)))
    grad_weight = in_parts(lambda grad, texel: np.einsum("nc,nkc->nk", grad, texels.take(texel, 0)),
                           grad_colour, index)
    return (matrix != 0).T @ grad_colour, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """the weights' gradient is the mean over the channels instead of the sum"""
    start = np.arange(0, index.size + 1, index.shape[1])
    matrix = csr_array((weight.ravel(), index.ravel(), start), (len(index), len(texels)))
    grad_weight = in_parts(
        lambda grad, texel: np.einsum("nc,nkc->nk", grad, texels.take(texel, 0) / texels.shape[1]),
        grad_colour,
        index,
    )
    return matrix.T @ grad_colour, grad_weight


def bilinear_backward(grad_weight, uv, width, height):
    """sizes are left out: u runs from 0 to 1, x from 0 to the width"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack([(grad_column[1] - grad_column[0]),
                     (grad_row[1] - grad_row[0])], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """width and height are swapped"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack(
        [(grad_column[1] - grad_column[0]) * height, (grad_row[1] - grad_row[0]) * width], -1
    )


def bilinear_backward(grad_weight, uv, width, height):
    """the gradients by u and by v are swapped"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack(
        [(grad_row[1] - grad_row[0]) * height, (grad_column[1] - grad_column[0]) * width], -1
    )


def footprint_points(uv, jacobian, n):
    """d is measured from the pixel's lower left corner instead of its centre"""
    offset = (np.arange(n) + 0.5) / n
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)


def footprint_points(uv, jacobian, n):
    """the Jacobian is transposed"""
    offset = (np.arange(n) + 0.5) / n - 0.5
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None]).sum(-2)


def footprint_points(uv, jacobian, n):
    """points go column by column; they go row by row"""
    offset = (np.arange(n) + 0.5) / n - 0.5
    d = np.stack(np.meshgrid(offset, offset, indexing="ij"), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)
