"""Lab 10's light as printed: what one types who has read the questions and the equations."""


def face_light(corners, ambient, directional, towards):
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal = normal / np.linalg.norm(normal, axis=1)[:, None]
    return ambient + directional * np.maximum(0, normal @ towards)[:, None]
