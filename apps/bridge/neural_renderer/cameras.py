"""From vertices in the world to x, y in ndc and z, the distance in front of the camera.

Cameras look along z, with x to the right and y up, so their pictures show a right-handed world in a
mirror, and its faces from behind.
"""
import math

import torch
from torch.nn.functional import normalize

from apps.bridge.tensors import require

SHORTEST = 1e-5  # vectors as short as this are not made longer


def as_vectors(value, like):
    """A vector, or one for each of N pictures: numbers or a tensor -> (1 or N, 1, 3)."""
    return torch.as_tensor(value, dtype=like.dtype, device=like.device).reshape(-1, 1, 3)


def look_at(vertices, eye, at=(0, 0, 0), up=(0, 1, 0)):
    """vertices (N, V, 3) as a camera at eye sees them that looks at a point.

    eye, at, up: (3,) or (N, 3).
    """
    return look(vertices, eye, as_vectors(at, vertices) - as_vectors(eye, vertices), up)


def look(vertices, eye, direction=(0, 1, 0), up=None):
    """vertices (N, V, 3) as a camera at eye sees them that looks in a direction.

    eye, direction, up: (3,) or (N, 3). up is (0, 1, 0) if it is not given. RuntimeError where
    nothing says what is right. (The original's picture has no width then.)
    """
    up = as_vectors((0, 1, 0) if up is None else up, vertices)
    forward = normalize(as_vectors(direction, vertices), dim=-1, eps=SHORTEST)
    right = torch.linalg.cross(up, forward)
    for n, sideways in enumerate(right.norm(dim=-1)):
        require(not sideways <= SHORTEST, f"the camera of picture {n} looks along up, or its "
                "direction or up has no length: move the eye, or give another up")
    right = normalize(right, dim=-1)
    axes = right, torch.linalg.cross(forward, right), forward
    from_eye = vertices - as_vectors(eye, vertices)
    return torch.stack([(from_eye * axis).sum(-1) for axis in axes], -1)


def perspective(vertices, angle=30.0):
    """vertices (N, V, 3) as a camera sees them, divided by z: angle degrees from the middle of the
    picture is its border.
    """
    x, y, z = vertices.unbind(-1)
    slope = torch.tan(torch.deg2rad(torch.as_tensor(angle, dtype=z.dtype, device=z.device)))
    return torch.stack([x / z / slope, y / z / slope, z], -1)


def projection(vertices, K, R, t, dist_coeffs, orig_size, eps=1e-9):
    """vertices (N, V, 3) as OpenCV's camera sees them, in a picture of orig_size x orig_size.

    K, R: (3, 3) or (N, 3, 3); t: (3,), (N, 3) or (N, 1, 3); dist_coeffs: k1, k2, p1, p2, k3, (5,)
    or (N, 5). K counts rows from the top.
    """
    K, R, coefficients = (torch.as_tensor(given, dtype=vertices.dtype, device=vertices.device)
                          for given in (K, R, dist_coeffs))
    x, y, z = (vertices @ R.mT + as_vectors(t, vertices)).unbind(-1)
    x, y = distort(x / (z + eps), y / (z + eps), coefficients.reshape(-1, 5).T[..., None])
    u, v, _ = (torch.stack([x, y, torch.ones_like(z)], -1) @ K.mT).unbind(-1)
    return torch.stack([2 * u / orig_size - 1, 1 - 2 * v / orig_size, z], -1)


def distort(x, y, coefficients):
    """Where a lens moves x and y (N, V): Brown's model, as OpenCV has it."""
    k1, k2, p1, p2, k3 = coefficients
    r2 = x**2 + y**2
    radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
    return (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
            y * radial + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y)


def get_points_from_angles(distance, elevation, azimuth, degrees=True):
    """Where an eye is, seen from 0: three numbers, or (N, 3) of tensors (N,)."""
    kind = torch if torch.is_tensor(distance) else math
    unit = math.pi / 180 if degrees else 1
    up, around = unit * elevation, unit * azimuth
    point = (distance * kind.cos(up) * kind.sin(around), distance * kind.sin(up),
             -distance * kind.cos(up) * kind.cos(around))
    return point if kind is math else torch.stack(point, -1)
