"""Lab 6, the pyramid and the level, as printed."""


def halve(image):
    return (image[::2, ::2] + image[::2, 1::2] + image[1::2, ::2] + image[1::2, 1::2]) / 4


def mip_level(jacobian, width, height):
    s_x, s_y = width * jacobian[:, 0, 0], width * jacobian[:, 0, 1]
    t_x, t_y = height * jacobian[:, 1, 0], height * jacobian[:, 1, 1]
    A = s_x**2 + t_x**2
    B = s_y**2 + t_y**2
    C = s_x * s_y + t_x * t_y
    S = (A + B) / 2
    R = np.sqrt((A - B)**2 / 4 + C**2)
    return 1 / 2 * np.log2(S + R)


def blend_levels(level, top):
    level = np.clip(level, 0, top)
    lower = np.floor(level)
    fraction = level - lower
    upper = np.minimum(lower + 1, top)
    return lower.astype(int), upper.astype(int), fraction
