"""Wrong answers to texture_cubes, written without a look at the checks."""


def face_light(corners, ambient, directional, towards):
    """the direction l is divided by its length, but it is to be used as it is

    told by: towards & length | l & divided & length | towards & normali | l & normali | l & as it is | towards & unit
    """
    e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    n = np.cross(e1, e2)
    size = np.linalg.norm(n, axis=1, keepdims=True)
    n = n / np.where(size > 0, size, 1)
    direction = towards / np.linalg.norm(towards)
    return ambient + np.maximum(n @ direction, 0)[:, None] * directional
