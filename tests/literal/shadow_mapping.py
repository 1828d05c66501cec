"""Lab 14 as printed: what one types who has read the questions and the equations."""


def map_position(q, clip_from_light, width, height):
    C = clip_from_light
    w = C[3, 2] * q[:, 2] + C[3, 3]
    x = (C[0, 0] * q[:, 0] / w + 1) * width / 2
    y = (C[1, 1] * q[:, 1] / w + 1) * height / 2
    return np.stack([x, y], -1)


def distance_slopes(normal, q, clip_from_light, width, height):
    C = clip_from_light
    if C[3, 2] == 0:
        facing, far = normal[:, 2], np.ones(len(q))
    else:
        facing, far = -(normal * q).sum(1) / -q[:, 2], -q[:, 2]
    slope_x = normal[:, 0] / facing * far * 2 / (C[0, 0] * width)
    slope_y = normal[:, 1] / facing * far * 2 / (C[1, 1] * height)
    return np.stack([slope_x, slope_y], -1)


def slope_scaled_bias(slope, constant, factor, most):
    corners = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]]) / 2
    return np.minimum(constant + factor * (slope @ corners.T).max(1), most)
