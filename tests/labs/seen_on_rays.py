"""What rays through the screen meet: an oracle of the checks of labs 2 and 4."""
import numpy as np


def seen_on_rays(places, clip, faces, width, height):
    """The nearest face between near and far at places (N, 2) on the screen, and its depth: (N,), -1
    and inf where there is none. Each face by a linear system.
    """
    rays = np.column_stack([2 * places / [width, height] - 1, np.ones(len(places))])
    weights = rays @ np.linalg.inv(clip[faces][..., [0, 1, 3]])
    depth = np.einsum("fnk,fk->fn", weights, clip[faces][..., 2])
    depth[(weights <= 0).any(-1) | (np.abs(depth) > 1)] = np.inf
    return np.where(depth.min(0) < np.inf, depth.argmin(0), -1), depth.min(0)
