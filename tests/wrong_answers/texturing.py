"""Wrong answers to texturing, written without a look at the checks."""


def linear_texels(x, size):
    """the half texel is added instead of subtracted

    told by: half & added | half & sign | + 1/2 | + 0.5 | next texel | plus & half | one texel
    """
    p = x * size + 0.5
    j = np.floor(p).astype(int)
    return np.stack([j, j + 1]), np.stack([1 - (p - j), p - j])


def look_up(texels, index, weight):
    """a texel that is named twice in a row counts once: its weights overwrite each other in M instead of adding up

    told by: twice | overwr | same texel | more than once | several times | adds up | add up
    """
    M = np.zeros((len(index), len(texels)))
    M[np.arange(len(index))[:, None], index] = weight
    return M @ texels


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
