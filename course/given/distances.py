"""Distances to a triangle mesh, and between two of them.

Points (P, 3) and a mesh as in course/given/mesh.py, whose faces may be without area. How near
a point is to a triangle: Ericson 2005, "Real-time collision detection", chapter 5.
"""
import numpy as np
from scipy.spatial import cKDTree

from . import inputs

NO_AREA = 1e-12  # twice a face's area over its longest side squared: up to this it has none


def closest_on_triangles(p, triangles):
    """The point of each triangle that is nearest to p: p (N, 3), triangles (N, 3, 3) -> (N, 3).

    A triangle is its inside, its sides and its corners. If it has no area, it is its sides. If they
    have no length either, it is a point.
    """
    side = np.roll(triangles, -1, -2) - triangles                  # (N, 3, 3)
    normal = np.cross(side[:, 0], side[:, 1])
    square = (normal**2).sum(-1)
    length = (side**2).sum(-1)
    to_p = p[:, None] - triangles
    # On each side, as far along it as p is, but not beyond its ends; the nearest of the three.
    t = np.clip((to_p * side).sum(-1) / np.where(length > 0, length, 1), 0, 1)
    on_side = triangles + t[..., None] * side
    nearest = ((p[:, None] - on_side)**2).sum(-1).argmin(1)
    on_side = on_side[np.arange(len(p)), nearest]
    # Straight down to the plane, if that is within: on the left of all three sides. Of a triangle
    # without area the normal is rounding, and what it calls left, too.
    height = (to_p[:, 0] * normal).sum(-1) / np.where(square > 0, square, 1)
    left = (np.cross(side, to_p) * normal[:, None]).sum(-1)
    within = (left >= 0).all(1) & (square > (NO_AREA * length.max(1))**2)
    return np.where(within[:, None], p - height[:, None] * normal, on_side)


def closest_points(points, vertices, faces):
    """The point on a mesh that is nearest to each of points (P, 3): (P, 3)."""
    _, closest = closest_faces(points, vertices, faces)
    return closest


def closest_faces(points, vertices, faces):
    """The face of a mesh nearest to each of points (P, 3), and its nearest point: (P,), (P, 3).

    The nearest vertex of the mesh bounds the distance. Only faces whose ball is nearer are tried.
    ValueError for what is no mesh, see `inputs.require_mesh`.
    """
    inputs.require_mesh(vertices, faces)
    triangles = vertices[faces]
    middle = triangles.mean(1)
    larger = 1 + 1e-9  # that rounding may leave none out
    radius = np.linalg.norm(triangles - middle[:, None], axis=-1).max(1) * larger
    bound = cKDTree(triangles.reshape(-1, 3)).query(points)[0] * larger
    tree = cKDTree(middle)
    nearest, closest = np.empty(len(points), int), np.empty((len(points), 3))
    for block in np.array_split(np.arange(len(points)), len(points) // 256 + 1):
        near = tree.query_ball_point(points[block], bound[block] + radius.max())
        point = np.repeat(block, [len(each) for each in near])
        face = np.concatenate([*near, []]).astype(int)
        away = np.linalg.norm(points[point] - middle[face], axis=1)
        reached = away <= bound[point] + radius[face]
        point, face = point[reached], face[reached]
        found = closest_on_triangles(points[point], triangles[face])
        order = np.lexsort([np.linalg.norm(points[point] - found, axis=1), point])
        first = order[np.unique(point[order], return_index=True)[1]]
        nearest[block], closest[block] = face[first], found[first]
    return nearest, closest


def distance_to_surface(points, vertices, faces):
    """How far points (P, 3) are from the nearest point of a mesh: (P,)."""
    return np.linalg.norm(closest_points(points, vertices, faces) - points, axis=1)


def sample_surface(vertices, faces, count, rng):
    """Points (count, 3) spread evenly over a mesh's area, with random numbers from rng.

    ValueError for what is no mesh, see `inputs.require_mesh`.
    """
    inputs.require_mesh(vertices, faces)
    a, b, c = vertices[faces.T]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    a, b, c = vertices[faces[rng.choice(len(faces), count, p=area / area.sum())].T]
    u, v = rng.uniform(size=(2, count, 1))
    folded = u + v > 1
    u, v = np.where(folded, 1 - u, u), np.where(folded, 1 - v, v)
    return a + u * (b - a) + v * (c - a)


def surface_distances(vertices, faces, other_vertices, other_faces, count=4000, seed=0):
    """From points of one mesh to the other: their mean distance, and the greatest (Hausdorff's).

    The points are all vertices and `count` random ones. The mean is over the random ones alone,
    so equal areas count equally. This measures one side: swap the meshes for the other.
    """
    points = sample_surface(vertices, faces, count, np.random.default_rng(seed))
    used = vertices[np.unique(faces)]
    distance = distance_to_surface(np.concatenate([points, used]), other_vertices, other_faces)
    return distance[:count].mean(), distance.max()
