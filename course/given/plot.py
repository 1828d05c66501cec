"""Figures of the course. Each function draws arrays into the matplotlib Axes that it is given.

Pictures have row 0 at the bottom. Pixel [row i, column j] covers [j, j+1] x [i, i+1], so that
triangles, samples and arrows are drawn over a picture in the same screen coordinates.

A notebook calls `style()` once. `panels` makes the Axes for pictures, `plt.subplots` all others.
"""
import textwrap

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patheffects import withStroke

# Okabe and Ito, "Color Universal Design", 2008: hues that colour-blind readers tell apart.
BLACK, ORANGE, SKY, GREEN, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00", "#CC79A7")
GREY = "#8a8a8a"
LABELS = "#f2f2f2", "#cfcfcf", BLACK, GREY, ORANGE, SKY, PURPLE, RED, BLUE, GREEN
BACKGROUND = (0.80, 0.88, 0.95)                    # where a depth picture shows no surface
DEPTHS = mpl.colormaps["magma_r"]                  # near to far
SIGNED = mpl.colormaps["RdBu"]                     # below zero red, above zero blue
HALO = [withStroke(linewidth=2.5, foreground="white")]

# The layout of `panels`, in dots, of which a figure has 100 to the inch.
PAGE_WIDTH, PANEL_HEIGHT = 900, 520                # as wide as a notebook; the highest picture
LEFT, BOTTOM, RIGHT, LINE = 26, 24, 14, 17         # room for tick labels, scale, gap, a title line


def style():
    """Make all figures of a notebook alike, whatever the reader's own settings are."""
    mpl.rcdefaults()
    mpl.rcParams.update({
        "figure.dpi": 100, "figure.figsize": (9, 3.2), "figure.constrained_layout.use": True,
        "font.size": 8.5, "axes.titlesize": 9.5, "axes.titlelocation": "left",
        "axes.prop_cycle": mpl.cycler(color=[BLUE, RED, GREEN, PURPLE, ORANGE, SKY, BLACK]),
        "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
        "axes.axisbelow": True, "grid.color": "#e6e6e6", "grid.linewidth": 0.7,
        "legend.frameon": False, "lines.linewidth": 1.6, "image.cmap": "gray",
    })
    if "inline" in mpl.get_backend():
        _show_whole_figures()


def _show_whole_figures():
    """Keep Jupyter from trimming the margins: then all figures of a page have one width."""
    from matplotlib_inline.backend_inline import set_matplotlib_formats
    from matplotlib_inline.config import InlineBackend

    inline = InlineBackend.instance()
    inline.print_figure_kwargs = {"bbox_inches": None, "metadata": {"Software": None}}
    set_matplotlib_formats("png")


# Axes for pictures

def panels(shapes, columns=None):
    """One figure with an Axes for each picture, in which a pixel is a whole number of dots wide.

    shapes: the pictures' (height, width) -> list of Axes, row by row, `columns` in a row.
    One column has room for 860 dots, two for 410, three for 260, four for 185. A picture that is
    too large for that, or higher than 520 dots, is shown at 1/2, 1/3, ... of its size.

    >>> left, right = panels([(64, 64), (8, 8)])
    """
    return _panels(shapes, columns or len(shapes), title_lines=2)


def _panels(shapes, columns, title_lines):
    sizes = _whole_sizes(np.array(shapes), _room(PAGE_WIDTH / columns))
    rows = -(-len(sizes) // columns)
    heights = [sizes[columns * row:columns * (row + 1), 0].max() + BOTTOM + LINE * title_lines + 6
               for row in range(rows)]
    page = np.array([PAGE_WIDTH, sum(heights)])
    figure = plt.figure(figsize=page / mpl.rcParams["figure.dpi"], layout="none")
    axes = []
    for index, size in enumerate(sizes):
        row, column = divmod(index, columns)
        corner = (LEFT + PAGE_WIDTH * column // columns, BOTTOM + sum(heights[row + 1:]))
        axes.append(figure.add_subplot(rows, columns, index + 1))
        axes[-1].set_position((*(corner / page), *(size[::-1] / page)))
    return axes


def _room(width):
    return width - LEFT - RIGHT


def _whole_sizes(shapes, room):
    """Shapes (N, 2) of pictures -> sizes (N, 2) in dots: whole multiples that fit the room.

    One size for all, where there is one: 16 x 16 and 64 x 64 are both shown at 128 x 128.
    """
    common = np.lcm.reduce(shapes)
    same_zoom = np.all(common[0] * shapes[:, 1] == common[1] * shapes[:, 0])
    if same_zoom and common[1] <= room and common[0] <= PANEL_HEIGHT:
        shapes = np.broadcast_to(common, shapes.shape)
    zoom = np.minimum(room / shapes[:, 1], PANEL_HEIGHT / shapes[:, 0])
    zoom = np.where(zoom >= 1, np.floor(zoom), 1 / np.ceil(1 / zoom))
    return np.round(shapes * zoom[:, None]).astype(int)


def strip(pictures, titles, columns=None):
    """Pictures side by side, `columns` in a row -> figure. End its line with a semicolon.

    pictures: arrays (H, W) or (H, W, 3) with values in [0, 1]. titles: one sentence for each.
    """
    columns = columns or len(pictures)
    lines = max(_wrapped(title, PAGE_WIDTH / columns).count("\n") + 1 for title in titles)
    axes = _panels([np.shape(picture)[:2] for picture in pictures], columns, lines)
    for place, picture, title in zip(axes, pictures, titles, strict=True):
        image(place, picture, title)
    return axes[0].figure


def screen(axes, width, height, title=""):
    """An empty screen of width x height pixels. Its two corners are labelled, y is up."""
    axes.set(xlim=(0, width), ylim=(0, height), aspect="equal",
             xticks=(0, width), yticks=(0, height))
    axes.tick_params(length=0, pad=3, labelsize=7, labelcolor=GREY)
    axes.grid(False)
    axes.spines[:].set(visible=True, color=GREY, linewidth=0.6)
    _title(axes, title)


def _title(axes, title):
    grid = axes.get_gridspec()                     # None for an inset
    room = axes.figure.bbox.width / grid.ncols if grid else axes.bbox.width
    axes.set_title(_wrapped(title, room), loc="left", pad=5)


def _wrapped(title, width):
    letter = 6.6                                   # dots to a letter of a title, on average
    return "\n".join(textwrap.wrap(title, max(12, int(_room(width) / letter))))


# Pictures

def image(axes, picture, title=""):
    """A picture (H, W) or (H, W, 3), as it is: 0 black, 1 full, beyond that clipped."""
    picture = np.clip(np.asarray(picture, float), 0, 1)
    height, width = picture.shape[:2]
    enlarged = round(axes.bbox.width) >= width     # only a picture that is shrunk is filtered
    axes.imshow(picture, origin="lower", extent=(0, width, 0, height), cmap="gray", vmin=0, vmax=1,
                interpolation="nearest" if enlarged else "antialiased")
    screen(axes, width, height, title)


def depth(axes, depth, title=""):
    """Depth (H, W): near is bright, far is dark, no surface (np.inf) is pale blue.

    The scale under the picture goes from the nearest depth to the farthest.
    """
    image(axes, depth_colours(depth), title)
    seen = depth[np.isfinite(depth)]
    if seen.size:
        _scale(axes, DEPTHS, f"{seen.min():.3g}", f"{seen.max():.3g}")


def depth_colours(depth):
    """Depth (H, W), np.inf where there is no surface -> picture (H, W, 3)."""
    seen = np.isfinite(depth)
    near, far = (depth[seen].min(), depth[seen].max()) if seen.any() else (0, 1)
    span = far - near if far > near else 1.0       # a single depth is near
    colours = DEPTHS((np.where(seen, depth, near) - near) / span)[..., :3]
    return np.where(seen[..., None], colours, BACKGROUND)


def face_index(axes, face_index, title=""):
    """Face index (H, W): a colour for each face, white where there is none (-1)."""
    image(axes, face_colours(face_index), title)


def face_colours(face_index):
    """Face index (...), -1 for no face -> colours (..., 3). A face has one colour in all pictures.

    Hues a golden section apart differ for neighbouring numbers, and never come round to the same.
    """
    face = np.asarray(face_index)
    hue = face * (np.sqrt(5) - 1) / 2 % 1
    saturation = 0.35 + 0.45 * (face * np.sqrt(2) % 1)
    value = 0.75 + 0.25 * (face * np.sqrt(3) % 1)
    colours = mpl.colors.hsv_to_rgb(np.stack([hue, saturation, value], axis=-1))
    return np.where(face[..., None] >= 0, colours, 1.0)


def barycentric(axes, barycentric, face_index, title=""):
    """Barycentrics (H, W, 3): vertices 0, 1, 2 are red, green, blue. White where face_index < 0."""
    image(axes, np.where(face_index[..., None] >= 0, barycentric, 1.0), title)


def labels(axes, labels, names, title=""):
    """Labels (H, W), indices into names: a colour for each. The legend counts what occurs."""
    colours = np.array([mpl.colors.to_rgb(LABELS[k % len(LABELS)]) for k in range(len(names))])
    image(axes, colours[labels], title)
    for label, count in zip(*np.unique(labels, return_counts=True), strict=True):
        axes.plot([], [], "s", color=colours[label], markeredgecolor=GREY, markeredgewidth=0.4,
                  label=f"{names[label]}: {count:,}")
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0, fontsize=7.5)


def before_after(axes, before, after, titles):
    """Two pictures of one shape and their difference, in three Axes. titles: of the first two.

    The difference is after - before, averaged over the channels: red darker, blue brighter.
    """
    image(axes[0], before, titles[0])
    image(axes[1], after, titles[1])
    change = np.asarray(after, float) - before
    change = change.reshape(*change.shape[:2], -1).mean(axis=-1)
    changed = np.mean(change != 0)
    signed(axes[2], change, f"{changed:.1%} of the pixels differ")


def signed(axes, values, title=""):
    """Values (H, W) of both signs: red below zero, white at zero, blue above, on one scale."""
    largest = np.nanmax(np.abs(values), initial=0.0) or 1.0
    image(axes, SIGNED(0.5 + 0.5 * np.asarray(values) / largest)[..., :3], title)
    _scale(axes, SIGNED, f"{-largest:.3g}", f"{largest:+.3g}")


def _scale(axes, colours, low, high):
    """A colour scale under the picture, between the labels of the two corners."""
    dots = axes.bbox.height
    bar = axes.inset_axes((0.36, -13 / dots, 0.28, 6 / dots))
    bar.imshow(np.linspace(0, 1, 128)[None], aspect="auto", cmap=colours)
    bar.set_axis_off()
    for x, side, text in ((0.345, "right", low), (0.655, "left", high)):
        axes.text(x, -10 / dots, text, transform=axes.transAxes, ha=side, va="center",
                  fontsize=7, color="#444444")


# Triangles on the screen

def wireframe(axes, vertices, faces, color=BLACK):
    """The edges of faces (F, 3) between screen positions (V, 2), each once, over a picture or not.

    The finer the mesh, the finer the lines: from 1 point down to 0.25.
    """
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    lines = vertices[np.unique(edges, axis=0), :2]
    collection = axes.add_collection(LineCollection(lines, colors=color))
    axes.set_aspect("equal")
    axes.autoscale_view()                          # an Axes that shows a screen keeps its limits
    start, end = axes.transData.transform(lines.reshape(-1, 2)).reshape(-1, 2, 2).swapaxes(0, 1)
    length = np.nanmedian(np.linalg.norm(end - start, axis=1))
    collection.set_linewidth(np.clip(0.04 * length, 0.25, 1.0))


def triangle_pixels(axes, triangle, width, height, covered=None, title=""):
    """One triangle (3, 2) in screen coordinates on a grid of width x height pixels.

    The dots are the samples, at the pixels' centres: filled where covered (H, W) is true.
    """
    covered = np.zeros((height, width), bool) if covered is None else covered
    screen(axes, width, height, title)
    axes.hlines(np.arange(height), 0, width, color="#dddddd", linewidth=0.7, zorder=0.5)
    axes.vlines(np.arange(width), 0, height, color="#dddddd", linewidth=0.7, zorder=0.5)
    axes.imshow(np.where(covered[..., None], mpl.colors.to_rgba(SKY, 0.35), 0),
                origin="lower", extent=(0, width, 0, height), interpolation="nearest")
    row, column = np.indices(covered.shape)
    pixel = axes.bbox.width / width * 72 / axes.figure.dpi
    axes.scatter(column + 0.5, row + 0.5, s=np.clip(0.22 * pixel, 1.5, 6) ** 2, linewidths=0.8,
                 facecolors=np.where(covered.ravel(), BLUE, "white"), edgecolors=BLUE, zorder=2)
    _outline(axes, triangle)
    if width <= 16:
        axes.set(xticks=range(width + 1), yticks=range(height + 1))


def _outline(axes, triangle):
    axes.fill(*np.transpose(triangle), fill=False, edgecolor=RED, linewidth=1.5, zorder=3)
    axes.plot(*np.transpose(triangle), "o", color=RED, markersize=4, zorder=3)
    outward = triangle - np.mean(triangle, axis=0)
    outward = outward / np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-12)
    for index, (corner, direction) in enumerate(zip(triangle, outward, strict=True)):
        axes.annotate(str(index), corner, 11 * direction, textcoords="offset points", color=RED,
                      weight="bold", ha="center", va="center", path_effects=HALO, zorder=4)


def edge_function(axes, values, a, b, title=""):
    """An edge function's values (H, W) at the pixel centres, red outside and blue inside.

    The line through a (2,) and b (2,) is where it should be zero. The arrow from a to b is the
    edge, the other one its normal n = (a_y - b_y, b_x - a_x), which should point into the blue.
    """
    signed(axes, values, title)
    a, b = np.asarray(a, float), np.asarray(b, float)
    axes.axline(a, b, color=BLACK, linewidth=0.8, linestyle=(0, (4, 3)))
    normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
    middle, length = (a + b) / 2, 0.14 * np.ptp(axes.get_xlim())
    _arrow(axes, a, b, BLACK)
    _arrow(axes, middle, middle + length * normal, GREEN)
    for point, name, color in ((a, "a", BLACK), (b, "b", BLACK),
                               (middle + length * normal, "n", GREEN)):
        axes.annotate(name, point, -9 * normal if name != "n" else 7 * normal,
                      textcoords="offset points", color=color, weight="bold",
                      ha="center", va="center", path_effects=HALO)


def _arrow(axes, start, end, color):
    axes.annotate("", end, start, arrowprops={
        "arrowstyle": "-|>", "color": color, "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0})


# Gradients

def arrows(axes, points, gradients, color=GREEN):
    """The descent direction, -gradient (N, 2), at points (N, 2): where a step would move them.

    All arrows have one scale: the longest is an eighth of the Axes wide, its gradient is stated.
    """
    lengths = np.linalg.norm(gradients, axis=1)
    longest = lengths.max(initial=0.0)
    axes.scatter(*points.T, s=9, color=color, zorder=4)
    if longest > 0:
        scale = longest / (np.ptp(axes.get_xlim()) / 8)
        axes.quiver(*points.T, *-gradients.T, color=color, angles="xy", scale_units="xy",
                    scale=scale, width=0.007, zorder=4, path_effects=HALO)
    stated = f"longest arrow: |gradient| = {longest:.3g}" if longest else "no gradient"
    axes.annotate(stated, (1, 0), (-5, 6), xycoords="axes fraction", textcoords="offset points",
                  ha="right", color=color, fontsize=8, path_effects=HALO, zorder=5,
                  bbox={"color": "white", "alpha": 0.8, "pad": 1.5})


def gradient_check(axes, analytic, numeric, name="gradient"):
    """The analytic gradient against central differences, of any one shape, element by element.

    The title states the largest difference, relative to the largest central difference.
    """
    analytic, numeric = np.ravel(analytic), np.ravel(numeric)
    difference = np.abs(analytic - numeric)
    error = difference.max() / max(np.abs(numeric).max(), np.finfo(float).tiny)
    wrong = ~(difference <= 1e-6 * np.abs(numeric).max())       # nan is wrong, too
    axes.axline((0, 0), slope=1, color=GREY, linewidth=0.8)
    axes.scatter(numeric[~wrong], analytic[~wrong], s=14, color=BLUE, alpha=0.6, linewidths=0)
    axes.scatter(numeric[wrong], analytic[wrong], s=18, color=RED, marker="x", linewidths=1)
    axes.set(xlabel="central difference", ylabel="analytic")
    verdict = f"{wrong.sum()} of {wrong.size} differ" if wrong.any() else f"all {wrong.size} agree"
    _title(axes, f"{name}: {verdict}, largest relative error {error:.1e}")


# The camera

def frustum(axes, corners, eye, points=None, title=""):
    """A camera in the world, in an Axes of projection "3d". y is up, as on the screen.

    corners (8, 3): the near plane's four in turn, then the far plane's in the same order.
    eye (3,). points (N, 3), such as a mesh's vertices, are drawn as dots.
    """
    corners, eye = np.asarray(corners, float), np.asarray(eye, float)
    near, far = corners[:4], corners[4:]
    for ring, color, name in ((near, RED, "near"), (far, BLUE, "far")):
        axes.plot(*_upright(ring[[0, 1, 2, 3, 0]]), color=color, linewidth=1.8)
        axes.text(*_upright(ring[2]), f"  {name}", color=color)
    for start, end in zip(near, far, strict=True):
        axes.plot(*_upright(np.stack([eye, start])), color=GREY, linewidth=0.7)
        axes.plot(*_upright(np.stack([start, end])), color=BLUE, linewidth=1.2)
    axes.scatter(*_upright(eye), color=BLACK, s=16)
    axes.text(*_upright(eye), "  eye", color=BLACK)
    points = np.empty((0, 3)) if points is None else points
    axes.scatter(*_upright(points), color=GREEN, s=4, linewidths=0, alpha=0.8)
    _world(axes, np.concatenate([corners, eye[None], points]))
    _title(axes, title)


def _world(axes, points):
    """Axes named and scaled alike around points (N, 3)."""
    axes.set_box_aspect(_upright(np.ptp(points, axis=0)))
    for axis, name in ((axes.xaxis, "z"), (axes.yaxis, "x"), (axes.zaxis, "y")):
        axis.set_label_text(name)
        axis.labelpad = -4
        axis.set_major_locator(mpl.ticker.MaxNLocator(4, integer=True))
        axis.set_pane_color("white")
        axis.set_tick_params(labelsize=7, labelcolor=GREY, pad=0)


def _upright(points):
    """World (..., 3) -> the coordinates z, x, y, of which matplotlib draws the last one up."""
    return np.moveaxis(np.asarray(points)[..., [2, 0, 1]], -1, 0)
