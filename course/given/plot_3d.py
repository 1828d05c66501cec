"""Meshes in space, drawn as lines and flat faces: sharp at any size, without our labs.

y is up, as on the screen. Pictures of meshes by the course's own rasterizer are plot.py's.
"""
import matplotlib as mpl
import numpy as np
from matplotlib.collections import PolyCollection

from . import plot

LIGHT = np.array([-0.45, 0.65, 0.62])              # towards the light, as the viewer sees it
CLAY, INK = "#d9c7ae", "#333333"                   # of faces and of edges


def surface(axes, vertices, faces, azimuth=30, elevation=20, colours=CLAY, edges=INK, title=""):
    """A mesh, its faces lit and outlined, seen from far away (no perspective), nearest in front.

    vertices (V, 3), faces (F, 3), or (F, K) of polygons. The viewer is at azimuth degrees from +z
    towards +x, and elevation degrees up. colours: of the faces, one or (F, 3). edges: their colour,
    or "none".
    The mesh fills the Axes. Give `axes.set(xlim=..., ylim=...)` afterwards for a scale of its own.
    """
    points = vertices @ turn(azimuth, elevation).T
    corners = points[faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    shade = 0.45 + 0.55 * np.clip(np.abs(normal @ LIGHT), 0, 1) ** 0.8
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    lit = shade[:, None] * mpl.colors.to_rgba_array(colours)[:, :3]
    length = np.median(np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1))
    dots = axes.bbox.height * length / np.ptp(points, axis=0)[:2].max()
    axes.add_collection(PolyCollection(
        corners[order, :, :2], facecolors=lit[order], antialiaseds=True,
        edgecolors=lit[order] if edges == "none" else edges,
        linewidths=0.3 if edges == "none" else np.clip(0.025 * dots, 0.15, 0.8)))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_axis_off()
    plot.title_of(axes, title)


def turn(azimuth, elevation):
    """The rotation (3, 3) from the world to a viewer at these angles, in degrees."""
    a, b = np.radians([azimuth, elevation])
    about_y = np.array([[np.cos(a), 0, -np.sin(a)], [0, 1, 0], [np.sin(a), 0, np.cos(a)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    return about_x @ about_y
