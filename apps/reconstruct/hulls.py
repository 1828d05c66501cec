"""Where the object is: a ball around it, from cameras and silhouettes, and whether these agree.

An axis is the ray from a camera through the middle of its silhouette. The axes nearly meet in the
object. The visual hull is all points that every silhouette covers. The object is in there.
"""
from typing import NamedTuple

import numpy as np
from scipy import ndimage

from .camera_files import require

CELLS = 48          # of the hull's grid, along an axis
COVERED = 0.1       # a pixel of more coverage is in the silhouette
CROPPED = 0.01      # a smaller part of a silhouette outside of the ball is noise: specks
UNFILLED = 0.05     # a smaller part of a silhouette that the hull does not fill is noise
ONE_SIDE = 20       # degrees from the mean axis: no depth is seen
SAME = 1e-6         # the difference of two cameras that are one


class Outline(NamedTuple):
    """A Shot, the pixels (N, 2) of its silhouette, as column and row from below, and how many
    pixels each of the picture's is away from it (H, W).
    """

    shot: tuple
    pixels: np.ndarray
    away: np.ndarray


def ball(scene, shots, pictures):
    """The centre (3,) and the radius of a ball around the object, and sentences on that.

    ValueError where cameras and silhouettes cannot be right.
    """
    outlines = [outline(*each) for each in zip(shots, pictures, strict=True)]
    require_different(outlines, scene)
    require_sides(outlines)
    points, reach = hull_around(outlines)
    if not len(points):
        raise ValueError(disagreement(outlines, scene))
    centre = (points.min(0) + points.max(0)) / 2
    radius = size_around(outlines, centre, points, reach)
    middle = ", ".join(f"{number:.3g}" for number in centre)
    taken = (f"the object is taken to lie in a ball of radius {radius:.3g} around ({middle}), "
             "found from the silhouettes")
    return (centre, radius), [taken, *doubts(outlines, points, reach)]


def outline(shot, picture):
    """The Outline of a Shot with this picture (H, W, 4)."""
    covered = picture[..., 3] > COVERED
    covered = covered if covered.any() else picture[..., 3] == picture[..., 3].max()
    return Outline(shot, np.argwhere(covered)[:, ::-1], ndimage.distance_transform_edt(~covered))


# --- a camera's rays ----------------------------------------------------------------------------


def eye(shot):
    """Where the camera is (3,)."""
    return shot.world_from_camera[:3, 3]


def rays(shot, pixels):
    """Unit vectors (N, 3) in the world, from the camera through the centres of pixels (N, 2)."""
    column, row = pixels.T + 0.5
    up = shot.cy - (shot.height - row)
    camera = np.stack([(column - shot.cx) / shot.fx, up / shot.fy, -np.ones(len(pixels))], 1)
    world = camera @ shot.world_from_camera[:3, :3].T
    return world / np.linalg.norm(world, axis=1, keepdims=True)


def seen_at(shot, points):
    """Points (N, 3) -> column, row from below, and depth (N,), which is above 0 in front."""
    right, up, back = ((points - eye(shot)) @ shot.world_from_camera[:3, :3]).T
    depth = np.where(back < 0, -back, np.inf)
    return (shot.cx + shot.fx * right / depth, shot.height - shot.cy + shot.fy * up / depth, -back)


def axis(outline):
    """The unit vector (3,) through the silhouette's middle."""
    return rays(outline.shot, outline.pixels.mean(0, keepdims=True))[0]


def nearest_to_axes(outlines):
    """The point (3,) whose squared distances from the axes have the least sum."""
    # A distance from the axis e + s d is that of (I - d d^T) x from (I - d d^T) e.
    across = [np.eye(3) - np.outer(d, d) for d in map(axis, outlines)]
    eyes = [eye(outline.shot) for outline in outlines]
    return np.linalg.lstsq(np.concatenate(across), np.concatenate(
        [a @ e for a, e in zip(across, eyes, strict=True)]))[0]


# --- the hull -----------------------------------------------------------------------------------


def hull_around(outlines):
    """Points (N, 3) of a grid that fill the visual hull, and how far it may reach beyond them.

    The first grid lies around the axes' meeting point, each later one around the hull so far.
    """
    centre = nearest_to_axes(outlines)
    half = 2 * max(size_at(outline, centre) for outline in outlines)
    for _ in range(3):
        points, reach = hull(outlines, centre, half)
        if not len(points):
            break
        low, high = points.min(0), points.max(0)
        centre, half = (low + high) / 2, (high - low).max() / 2 + 2 * reach
    return points, reach


def hull(outlines, centre, half):
    """The points of a grid from centre - half to centre + half that every silhouette covers, or has
    nearer than half a cell's diagonal, and that length: so nothing thin is lost.
    """
    points, reach = grid(centre, half)
    for outline in outlines:
        points = points[is_covered(outline, points, reach)]
    return points, reach


def grid(centre, half):
    """The centres (N, 3) of cells from centre - half to centre + half, and half a cell's diagonal.
    """
    cell = 2 * half / CELLS
    steps = (np.arange(CELLS) + 0.5) * cell - half
    points = centre + np.stack(np.meshgrid(steps, steps, steps), -1).reshape(-1, 3)
    return points, cell * np.sqrt(3) / 2


def is_covered(outline, points, reach):
    """Which points (N, 3) the silhouette covers, or has nearer than reach. Not those out of the
    frame.
    """
    column, row, depth = seen_at(outline.shot, points)
    height, width = outline.away.shape
    column, row = np.floor(column), np.floor(row)
    within = (depth > 0) & (column >= 0) & (column < width) & (row >= 0) & (row < height)
    pixel = tuple(np.where(within, number, 0).astype(int) for number in (row, column))
    return within & (outline.away[pixel] * depth <= reach * outline.shot.fx)


def size_at(outline, point):
    """The radius of the silhouette, were it at the point's depth."""
    depth = np.linalg.norm(point - eye(outline.shot))
    return depth * np.linalg.norm(np.ptp(outline.pixels, axis=0) + 1) / 2 / outline.shot.fx


def size_around(outlines, centre, points, reach):
    """The radius of a ball that holds the hull's points, and what half of the silhouettes show.

    The hull is too small where cameras are a little wrong, and a silhouette may have specks.
    """
    shown = [np.quantile(distance_of(one.shot, one.pixels, centre), 1 - CROPPED)
             for one in outlines]
    return max(np.linalg.norm(points - centre, axis=1).max() + reach, np.median(shown))


# --- what can be wrong --------------------------------------------------------------------------


def require_different(outlines, scene):
    """ValueError where two pictures have one camera, or all cameras are at one place."""
    eyes = np.array([eye(one.shot) for one in outlines])
    turns = np.array([one.shot.world_from_camera[:3, :3] for one in outlines])
    spread = np.linalg.norm(eyes - eyes.mean(0), axis=1).max()
    for k in range(1, len(outlines)):
        same = ((np.abs(eyes[:k] - eyes[k]).max(1) <= SAME * spread)
                & (np.abs(turns[:k] - turns[k]).max((1, 2)) <= SAME))
        require(not same.any(), f"{outlines[k].shot.name} and "
                f"{outlines[same.argmax()].shot.name} have the same camera in {scene.file}: if the "
                "object was turned, cameras are given as seen from the object")
    require(spread > SAME * np.abs(eyes).max(), f"all cameras in {scene.file} are at one place: "
            "is it the matrices' inverse that leads from the camera to the world?")


def require_sides(outlines):
    """ValueError if all pictures show the object from just one side."""
    axes = np.array([axis(one) for one in outlines])
    mean = axes.mean(0) / max(np.linalg.norm(axes.mean(0)), 1e-9)
    most = np.degrees(np.arccos(np.clip(axes @ mean, -1, 1))).max()
    require(most > ONE_SIDE, f"all views are from one side, within {most:.0f} degrees of their "
            "mean direction, and do not show how deep the object is: take pictures from all around")


def disagreement(outlines, scene):
    """A sentence on cameras and silhouettes that have no point in common."""
    without = [one.shot.name for k, one in enumerate(outlines)
               if len(hull_around(outlines[:k] + outlines[k + 1:])[0])]
    if without:
        return ("no point of space is in the silhouettes of all pictures, but without "
                f"{' or '.join(without[:5])} there is one: look at the camera and the mask of that "
                "picture, or leave it out")
    return (f"the cameras in {scene.file} do not agree, and leaving one out does not help: does "
            "each matrix lead from the camera to the world, does the camera look along its own -z "
            "(OpenCV's along +z), and is the angle of the lens right?")


def doubts(outlines, points, reach):
    """A warning in a list where the hull's points (N, 3) do not fill the silhouettes."""
    empty = [(~is_filled(one, points, reach)).mean() for one in outlines]
    if max(empty) <= UNFILLED:
        return []
    middle, half = (points.max(0) + points.min(0)) / 2, np.ptp(points, axis=0).max()
    around, reach = grid(middle, half)
    missing = ~np.array([is_covered(one, around, reach) for one in outlines])
    alone = missing & (missing.sum(0) == 1)  # what one silhouette, and no other, leaves out
    suspect = outlines[int(alone.sum(1).argmax())].shot.name
    return [f"the silhouettes agree badly: {max(empty):.0%} of that in "
            f"{outlines[int(np.argmax(empty))].shot.name} is not in all others, and {suspect} "
            "leaves out most: look at its camera and its mask"]


def is_filled(outline, points, reach):
    """Which of a silhouette's pixels show something near the points (N, 3)."""
    column, row, depth = seen_at(outline.shot, points)
    height, width = outline.away.shape
    hit = np.zeros((height, width), bool)
    hit[np.clip(row, 0, height - 1).astype(int), np.clip(column, 0, width - 1).astype(int)] = True
    away = ndimage.distance_transform_edt(~hit)[tuple(outline.pixels.T[::-1])]
    return away <= 1 + 2 * reach * outline.shot.fx / depth.min()


def distance_of(shot, pixels, point):
    """How far the rays through pixels (N, 2) pass a point (3,): (N,)."""
    return np.linalg.norm(np.cross(rays(shot, pixels), point - eye(shot)), axis=1)
