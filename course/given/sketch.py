"""Labelled drawings for geometric arguments. Each function adds to an Axes that `sheet` made.

Points are (x, y) in the drawing's own units, x right and y up. A label is plain text or "$x_0$".
Offsets of labels are in points, of which 72 are an inch.
"""
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Arc, FancyBboxPatch

from .plot import BLACK, BLUE, GREY, HALO, LINE, ORANGE, PAGE_WIDTH, PURPLE, SKY, title_of

SIZE = 11                                          # of a label, in points
DARKER = {ORANGE: "#8a5a00", SKY: "#1f6fa8", PURPLE: "#96407a"}  # for text in these colours
GAP = 14                                           # around drawings, in displayed pixels


def sheet(*limits, titles=None, height=420):
    """One figure with an empty drawing for each (x0, x1, y0, y1), side by side -> list of Axes.

    One scale for all, so that they fill the page's width, and height, in displayed pixels, at most.

    >>> before, after = sheet((0, 2, 0, 1), (0, 2, 0, 1), titles=["Before", "After"])
    """
    x0, x1, y0, y1 = np.transpose(limits)
    wide = x1 - x0
    high = np.max(y1 - y0)
    scale = min((PAGE_WIDTH - GAP * (len(limits) + 1)) / wide.sum(), height / high)
    gap = (PAGE_WIDTH - scale * wide.sum()) / (len(limits) + 1)
    page = np.ceil([PAGE_WIDTH, scale * high + (2 * LINE if titles else 0) + 2 * GAP])
    figure = plt.figure(figsize=page / 100, layout="none")
    left = gap + np.append(0, np.cumsum(scale * wide + gap))
    places = []
    for k, title in enumerate(titles or [""] * len(limits)):
        axes = figure.add_axes((left[k] / page[0], GAP / page[1],
                                scale * wide[k] / page[0], scale * high / page[1]))
        frame(axes, x0[k], x1[k], y0[k], y0[k] + high, title)
        places.append(axes)
    return places


def frame(axes, x0, x1, y0, y1, title=""):
    """Set an Axes' limits and title: after `clear`, in a film, or for an Axes of another figure."""
    axes.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal")
    axes.set_axis_off()
    title_of(axes, title)


def label(axes, at, text, color=BLACK, offset=(0, 0), **style):
    """Text beside a point, or on it."""
    side = {-1: "right", 0: "center", 1: "left"}[int(np.sign(offset[0]))]
    level = {-1: "top", 0: "center", 1: "bottom"}[int(np.sign(offset[1]))]
    axes.annotate(text, at, offset, textcoords="offset points", ha=side, va=level,
                  color=DARKER.get(color, color),
                  **{"fontsize": SIZE, "path_effects": HALO, "zorder": 6, **style})


def dot(axes, at, text="", color=BLACK, offset=(6, 6), filled=True):
    """A point with its name: filled, or a ring."""
    axes.plot(*at, "o", color=color, markersize=6, markerfacecolor=color if filled else "white",
              zorder=5)
    label(axes, at, text, color, offset)


def line(axes, *points, color=BLACK, width=1.6, dashed=False, closed=False):
    """Straight lines from each point to the next; closed: and back to the first."""
    axes.plot(*np.transpose([*points, *points[:closed]]), color=color, linewidth=width,
              linestyle=(0, (4, 3)) if dashed else "-", solid_capstyle="round", zorder=3)


def area(axes, *points, color=SKY, alpha=0.3):
    """A filled polygon without an outline."""
    axes.fill(*np.transpose(points), color=color, alpha=alpha, linewidth=0, zorder=1)


def arrow(axes, start, end, text="", color=BLACK, offset=(0, 9), width=1.8, bend=0.0):
    """An arrow, its name beside its middle. bend: 0 is straight, 0.3 a bow."""
    _from_to(axes, start, end, text, color, offset, arrowstyle="-|>", linewidth=width,
             mutation_scale=13, connectionstyle=f"arc3,rad={bend}")


def measure(axes, start, end, text, color=BLACK, offset=(0, 9)):
    """A distance: a line with a bar at each end, its length's name beside its middle."""
    _from_to(axes, start, end, text, color, offset, arrowstyle="|-|", linewidth=1.2,
             mutation_scale=4)


def _from_to(axes, start, end, text, color, offset, **style):
    style |= {"color": color, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=style, zorder=4)
    label(axes, np.add(start, end) / 2, text, color, offset)


def angle(axes, at, start, end, text, radius=0.5, color=BLACK):
    """The arc at a point from one direction to another, in degrees, counter-clockwise."""
    axes.add_patch(Arc(at, 2 * radius, 2 * radius, theta1=start, theta2=end, color=color,
                       linewidth=1.3, zorder=4))
    middle = np.radians((start + end) / 2)
    label(axes, np.add(at, 1.45 * radius * np.array([np.cos(middle), np.sin(middle)])), text, color)


def pixel(axes, column, row, shade=None):
    """The square of one pixel, its centre a dot; shade: 0 black to 1 white, or a colour."""
    fill = "none" if shade is None else str(shade) if np.ndim(shade) == 0 else shade
    axes.add_patch(mpl.patches.Rectangle((column, row), 1, 1, facecolor=fill, edgecolor=GREY,
                                         linewidth=1.0, zorder=2))
    axes.plot(column + 0.5, row + 0.5, ".", color=GREY, markersize=4, zorder=2.5)


def box(axes, centre, text, size=(1.6, 0.7), color=BLUE):
    """A step of a pipeline: a rounded box of size (width, height) with text in it."""
    corner = np.subtract(centre, np.divide(size, 2))
    axes.add_patch(FancyBboxPatch(corner, *size, boxstyle="round,pad=0,rounding_size=0.1",
                                  facecolor=(*mpl.colors.to_rgb(color), 0.12), edgecolor=color,
                                  linewidth=1.3, zorder=2))
    label(axes, centre, text, path_effects=None, fontsize=SIZE - 1)
