"""Lab 6 once more: texels one by one, a bilinear form."""
import numpy as np


def linear_texels(x, size):
    below, share = np.divmod(np.multiply(x, size) - 0.5, 1)
    first = below.astype(int)
    return np.array([first, first + 1]), np.array([1 - share, share])


def bilinear_backward(grad_weight, uv, width, height):
    grad = np.reshape(grad_weight, (-1, 2, 2))  # point, row, column
    u, v = np.transpose(uv)
    across, along = linear_texels(u, width)[1], linear_texels(v, height)[1]
    change = np.array([-1, 1])
    by_u = np.einsum("nij,in,j->n", grad, along, change) * width
    by_v = np.einsum("nij,i,jn->n", grad, change, across) * height
    return np.array([by_u, by_v]).T
