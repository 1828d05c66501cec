"""The visual hull, with which a search for a shape begins: all points that every silhouette covers.
"""
import numpy as np
from scipy import ndimage

SHRUNK = 0.03  # of the grid [-1, 1]^3: how much smaller than the hull the search begins


def start(labs, capture, cells):
    """Lab 16's `start`, but with the visual hull in the place of the ball: a Scene of cells^3.

    A point is as far outside as the picture says that sees it farthest outside its silhouette. The
    start is a little smaller. So thin bridges, which no silhouette denies, are gone.
    """
    x = labs.multi_view_fit.start(cells)
    points = labs.marching_tetrahedra.grid_points(cells)
    views = zip(capture.pictures, capture.cameras, strict=True)
    outside = np.max([beyond(labs, picture, camera, points) for picture, camera in views], axis=0)
    return labs.multi_view_fit.bounded(x._replace(distance=outside + SHRUNK))


def beyond(labs, picture, camera, points):
    """How far points (G, 3) are outside of a picture's silhouette, below 0 inside: (G,).

    camera is clip_from_grid. x in clip space changes by the length of its first row for one unit
    across, and a pixel is 2 w / width of it.
    """
    height, width, _ = picture.shape
    covered = picture[..., 3] > 0.5
    pixels = (ndimage.distance_transform_edt(~covered) - ndimage.distance_transform_edt(covered)
              - np.where(covered, -0.5, 0.5))
    clip = labs.pipeline.to_clip(points, camera)
    column, row = (clip[:, :2] / clip[:, 3:] + 1).T * [[width / 2], [height / 2]] - 0.5
    found = ndimage.map_coordinates(pixels, [row, column], order=1, mode="nearest")
    return found * clip[:, 3] * 2 / (width * np.linalg.norm(camera[0, :3]))
