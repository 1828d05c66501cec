"""Cube maps of lab 6 once more: tables for frames, loops for vectors."""
import numpy as np


def measures(d):
    """(out . d, right . d, down . d) of each face."""
    x, y, z = d
    return (x, -z, -y), (-x, z, -y), (y, x, z), (-y, x, -z), (z, x, -y), (-z, -x, -y)


def on_face(directions):
    faces, places = [], []
    for d in directions:
        all_sides = measures(d)
        largest = max(side[0] for side in all_sides)
        face = [side[0] for side in all_sides].index(largest)
        m, s, t = all_sides[face]
        faces.append(face)
        places.append([0.5 + 0.5 * s / m, 0.5 + 0.5 * t / m])
    return faces, places


def frame_of(face):
    """The rows out, right and down, as what `measures` does to the axes."""
    return np.transpose([measures(axis)[face] for axis in np.eye(3)])


def on_face_backward(grad_uv, directions):
    grad = np.zeros(np.shape(directions))
    for n, face in enumerate(on_face(directions)[0]):
        out, right, down = frame_of(face)
        m = out @ directions[n]
        for g, axis in zip(grad_uv[n], (right, down), strict=True):
            grad[n] += g * (m * axis - (axis @ directions[n]) * out) / (2 * m**2)
    return grad


def across_edge(face, column, row, size):
    found = []
    for f, c, r, n in zip(face, column, row, size, strict=True):
        out, right, down = frame_of(f)
        centre = n * out + (2 * c + 1 - n) * right + (2 * r + 1 - n) * down
        on_edge = np.clip(centre, -n, n)
        step = centre - on_edge           # along this face, and out of the next one
        beyond = next(g for g in range(6) if frame_of(g)[0] @ step > 0)
        _, right, down = frame_of(beyond)
        here = on_edge - out              # half a texel below the edge
        found.append((beyond, (right @ here + n) // 2, (down @ here + n) // 2))
    return tuple(np.array(part).astype(int) for part in zip(*found, strict=True))


def face_footprint(directions, jacobian):
    footprints = []
    for d, change, face in zip(directions, jacobian, on_face(directions)[0], strict=True):
        out, right, down = frame_of(face)
        m, grown = out @ d, out @ change
        footprints.append([(m * (axis @ change) - (axis @ d) * grown) / (2 * m * m)
                           for axis in (right, down)])
    return np.array(footprints)
