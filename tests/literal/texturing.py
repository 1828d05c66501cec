"""Lab 6 as printed: what one types who has read the questions and the equations."""


def linear_texels(x, size):
    p = size * x - 1 / 2
    j = np.floor(p)
    a = p - j
    return np.stack([j, j + 1]).astype(int), np.stack([1 - a, a])


def look_up(texels, index, weight):
    return (weight[..., None] * texels[index]).sum(1)


def bilinear_backward(grad_weight, uv, width, height):
    _, row = linear_texels(uv[:, 1], height)
    _, column = linear_texels(uv[:, 0], width)
    g00, g01, g10, g11 = grad_weight.T
    # row = 1 - b, b and column = 1 - a, a, where a changes by width du and b by height dv
    grad_a = row[0] * (g01 - g00) + row[1] * (g11 - g10)
    grad_b = column[0] * (g10 - g00) + column[1] * (g11 - g01)
    return np.stack([width * grad_a, height * grad_b], -1)
