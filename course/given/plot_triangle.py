"""Figures of one triangle: the samples that it covers, and its edge functions."""
import matplotlib as mpl
import numpy as np

from . import plot


def triangle_pixels(axes, triangle, width, height, covered=None, title=""):
    """One triangle (3, 2) in screen coordinates on a grid of width x height pixels.

    The dots are the samples, at the pixels' centres: filled where covered (H, W) is true.
    """
    covered = np.zeros((height, width), bool) if covered is None else covered
    plot.screen(axes, width, height, title)
    plot.pixel_borders(axes, width, height)
    axes.imshow(np.where(covered[..., None], mpl.colors.to_rgba(plot.SKY, 0.35), 0),
                origin="lower", extent=(0, width, 0, height), interpolation="nearest")
    row, column = np.indices(covered.shape)
    pixel = axes.bbox.width / width * 72 / axes.figure.dpi
    axes.scatter(column + 0.5, row + 0.5, s=np.clip(0.22 * pixel, 1.5, 6) ** 2, linewidths=0.8,
                 facecolors=np.where(covered.ravel(), plot.BLUE, "white"),
                 edgecolors=plot.BLUE, zorder=2)
    _outline(axes, triangle)
    if width <= 16:
        axes.set(xticks=range(width + 1), yticks=range(height + 1))


def _outline(axes, triangle):
    axes.fill(*np.transpose(triangle), fill=False, edgecolor=plot.RED, linewidth=1.5, zorder=3)
    axes.plot(*np.transpose(triangle), "o", color=plot.RED, markersize=4, zorder=3)
    outward = triangle - np.mean(triangle, axis=0)
    outward = outward / np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-12)
    for index, (corner, direction) in enumerate(zip(triangle, outward, strict=True)):
        axes.annotate(str(index), corner, 11 * direction, textcoords="offset points",
                      color=plot.RED, weight="bold", ha="center", va="center",
                      path_effects=plot.HALO, zorder=4)


def edge_function(axes, values, a, b, title=""):
    """An edge function's values (H, W) at the pixel centres, red outside and blue inside.

    The line through a (2,) and b (2,) is where it should be zero. The arrow from a to b is the
    edge, the other one its normal n = (a_y - b_y, b_x - a_x), which should point into the blue.
    """
    plot.signed(axes, values, title)
    a, b = np.asarray(a, float), np.asarray(b, float)
    axes.axline(a, b, color=plot.BLACK, linewidth=0.8, linestyle=(0, (4, 3)))
    normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
    middle = (a + b) / 2
    length = 0.14 * np.ptp(axes.get_xlim())
    _arrow(axes, a, b, plot.BLACK)
    _arrow(axes, middle, middle + length * normal, plot.GREEN)
    for point, name, color in ((a, "a", plot.BLACK), (b, "b", plot.BLACK),
                               (middle + length * normal, "n", plot.GREEN)):
        axes.annotate(name, point, -9 * normal if name != "n" else 7 * normal,
                      textcoords="offset points", color=color, weight="bold",
                      ha="center", va="center", path_effects=plot.HALO)


def _arrow(axes, start, end, color):
    axes.annotate("", end, start, arrowprops={
        "arrowstyle": "-|>", "color": color, "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0})
