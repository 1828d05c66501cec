"""Wrong answers to mipmapping, written without a look at the checks."""


def halve(image):
    """the sum of the four texels is divided by 2 instead of 4

    told by: divided by 2 | twice | factor 2 | divided by 4 | 1/4 | factor of 2 | double
    """
    height, width, channels = image.shape
    a, b = min(height, 2), min(width, 2)
    cut = image.reshape(height // a, a, width // b, b, channels)
    return cut.sum((1, 3)) / max(1, a * b // 2)


def mip_level(jacobian, width, height):
    """J is scaled by columns: width goes to the x derivatives and height to the y derivatives, instead of u and v

    told by: columns | width & height & exchanged | width & height & swapped | x derivatives | not square | u & width & v & height
    """
    in_texels = jacobian * np.array([width, height])
    sx, sy, tx, ty = (in_texels[:, i, j] for i in (0, 1) for j in (0, 1))
    A, B, C = sx**2 + tx**2, sy**2 + ty**2, sx * sy + tx * ty
    with np.errstate(divide="ignore"):
        return 0.5 * np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2))


def blend_levels(level, top):
    """the level is rounded to the nearest integer, not floored: f can be negative

    told by: floor | nearest | np.round | rounded | rint | f & negative | fraction & negative
    """
    inside = np.clip(level, 0, top)
    low = np.rint(inside).astype(int)
    high = np.minimum(low + 1, top)
    return low, high, inside - low
