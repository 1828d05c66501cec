"""Figures of the course. Each function draws arrays into the matplotlib Axes that it is given.

Pictures have row 0 at the bottom. Pixel [row i, column j] covers [j, j+1] x [i, i+1], so that
triangles, samples and arrows are drawn over a picture in the same screen coordinates.

`panels` makes the Axes for pictures, `plt.subplots` those for curves, sketch.py those for
drawings. `film` shows a figure that moves.
"""
import io
import textwrap

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patheffects import withStroke
from PIL import Image

from .image import to_srgb

# Okabe and Ito, "Color Universal Design", 2008: hues that colour-blind readers tell apart. Their
# vermilion looks orange, so RED is a red: dark, to be told from GREEN without its hue.
BLACK, ORANGE, SKY, GREEN, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#C2152E", "#CC79A7")
GREY, PALE = "#767676", "#a8a8a8"                  # beside a colour; what was there before it
LABELS = "#f2f2f2", "#cfcfcf", BLACK, GREY, ORANGE, SKY, PURPLE, RED, GREEN, BLUE
BACKGROUND = (0.80, 0.88, 0.95)                    # where a depth picture shows no surface
DEPTHS = mpl.colormaps["magma_r"]                  # near to far
SIGNED = mpl.colors.LinearSegmentedColormap.from_list(  # below zero red and darker, above blue
    "signed", ["#7a0c1e", "#e0656e", "#ffffff", "#6db3e0", BLUE])
HALO = [withStroke(linewidth=2.5, foreground="white")]

# The layout of `panels`, in displayed pixels, of which a figure has 100 to the inch. Each is drawn
# with DOTS x DOTS dots, for today's screens and for print.
DOTS = 2
PAGE_WIDTH, PANEL_HEIGHT = 960, 640                # as wide as a page; the highest picture
SMALLEST = 200                                     # a panel's longer side
LEFT, BOTTOM, RIGHT, LINE = 28, 28, 12, 19        # room for tick labels, scale, gap, a title line


def style():
    """Make all figures of a notebook alike, whatever the reader's own settings are."""
    mpl.rcdefaults()
    mpl.rcParams.update({
        "figure.dpi": 100, "figure.figsize": (9.6, 3.4), "figure.constrained_layout.use": True,
        "font.size": 9.5, "axes.titlesize": 10.5, "axes.titlelocation": "left",
        "axes.titlepad": 5,
        "axes.prop_cycle": mpl.cycler(color=[BLUE, RED, GREEN, PURPLE, ORANGE, SKY, BLACK]),
        "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
        "axes.axisbelow": True, "grid.color": "#e6e6e6", "grid.linewidth": 0.7,
        "legend.frameon": False, "lines.linewidth": 1.8, "image.cmap": "gray",
        "mathtext.fontset": "cm",
    })
    if "inline" in mpl.get_backend():
        _show_whole_figures()


def _show_whole_figures():
    """Keep Jupyter from trimming the margins: then all figures of a page have one width."""
    from matplotlib_inline.backend_inline import set_matplotlib_formats
    from matplotlib_inline.config import InlineBackend

    inline = InlineBackend.instance()
    inline.print_figure_kwargs = {"bbox_inches": None, "metadata": {"Software": None}}
    set_matplotlib_formats("retina")               # DOTS dots for each displayed pixel


# Axes for pictures

def panels(shapes, columns=None, title_lines=2):
    """One figure with an Axes for each picture, whose pixels are a whole number of dots wide.

    shapes: the pictures' (height, width) -> list of Axes, row by row, `columns` in a row. Above
    each is room for so many lines of a title.
    One column has room for 920 displayed pixels, two for 440, three for 280, four for 200. A
    picture that is too large is shrunk. ValueError: a picture would be under 200 x 200.

    >>> left, right = panels([(64, 64), (8, 8)])
    """
    columns = columns or len(shapes)
    sizes = _sizes(np.array(shapes), PAGE_WIDTH // columns - LEFT - RIGHT)
    rows = -(-len(sizes) // columns)
    heights = [sizes[columns * row:columns * (row + 1), 0].max() + BOTTOM + LINE * title_lines + 6
               for row in range(rows)]
    page = np.array([PAGE_WIDTH, np.ceil(sum(heights))])
    figure = plt.figure(figsize=page / mpl.rcParams["figure.dpi"], layout="none")
    axes = []
    for index, size in enumerate(sizes):
        row, column = divmod(index, columns)
        corner = (LEFT + PAGE_WIDTH * column // columns, BOTTOM + sum(heights[row + 1:]))
        axes.append(figure.add_subplot(rows, columns, index + 1))
        axes[-1].set_position((*(corner / page), *(size[::-1] / page)))
    return axes


def _sizes(shapes, room):
    """Shapes (N, 2) of pictures -> sizes (N, 2) in displayed pixels that fill the room's width.

    A picture's pixel is a whole number of dots wide, unless the picture is large or would come
    out small. If there is one size for all, they get it: 16 x 16 and 64 x 64 become 256 x 256.
    """
    common = np.lcm.reduce(shapes)
    same_zoom = np.all(common[0] * shapes[:, 1] == common[1] * shapes[:, 0])
    if same_zoom and common[1] <= DOTS * room and common[0] <= DOTS * PANEL_HEIGHT:
        shapes = np.broadcast_to(common, shapes.shape)
    largest = DOTS * np.minimum(room / shapes[:, 1], PANEL_HEIGHT / shapes[:, 0])
    zoom = np.floor(largest)
    is_small = (zoom * shapes.max(axis=1) < DOTS * SMALLEST) | (zoom < 0.7 * largest)
    sizes = shapes * np.where(is_small, largest, zoom)[:, None] / DOTS
    if sizes.max(axis=1).min() < SMALLEST:
        raise ValueError(f"a panel would be {sizes[np.argmin(sizes.max(axis=1))].round()} displayed"
                         f" pixels, and {SMALLEST} is the least: put fewer in a row")
    return np.floor(DOTS * sizes) / DOTS


def chart(axes):
    """Make an Axes of `panels` one for curves: its box shrinks, to leave room for labels."""
    box = axes.get_position()
    left, bottom = np.array([34, 18]) / axes.figure.bbox.size
    axes.set_position((box.x0 + left, box.y0 + bottom, box.width - left, box.height - bottom))
    return axes


def strip(pictures, titles, columns=None, light=False):
    """Pictures side by side, `columns` in a row -> figure. End its line with a semicolon.

    pictures, light: as for `image`. titles: one sentence for each.
    """
    columns = columns or len(pictures)
    lines = max(_wrapped(title, PAGE_WIDTH / columns).count("\n") + 1 for title in titles)
    axes = panels([np.shape(picture)[:2] for picture in pictures], columns, lines)
    for place, picture, title in zip(axes, pictures, titles, strict=True):
        image(place, picture, title, light)
    return axes[0].figure


def screen(axes, width, height, title=""):
    """An empty screen of width x height pixels. Its two corners are labelled, y is up."""
    axes.set(xlim=(0, width), ylim=(0, height), aspect="equal",
             xticks=(0, width), yticks=(0, height))
    axes.tick_params(length=0, pad=3, labelsize=9, labelcolor=GREY)
    axes.grid(False)
    axes.spines[:].set(visible=True, color=GREY, linewidth=0.6)
    title_of(axes, title)


def title_of(axes, title):
    """A title in lines that fit over the Axes."""
    grid = axes.get_gridspec()                     # None for an inset
    room = axes.figure.bbox.width / grid.ncols if grid else axes.bbox.width
    axes.set_title(_wrapped(title, room), loc="left", pad=5)


def _wrapped(title, width):
    letter = 7.6                                   # pixels to a letter of a title, on average
    return "\n".join(textwrap.wrap(title, max(12, int((width - LEFT - RIGHT) / letter))))


# What moves

def film(figure, draw, frames, seconds=0.1):
    """Show a figure that moves, for ever: draw(frame) draws each of the frames into its Axes.

    Before each frame the Axes are emptied. seconds: of a frame, or of each frame in turn. The film
    begins with its last frame, which is what a printer shows, or a program that shows no films.
    """
    from IPython import display  # only notebooks need it

    pictures = []
    for frame in frames:
        for axes in figure.axes:
            axes.clear()
        draw(frame)
        dots = figure.dpi
        figure.set_dpi(DOTS * dots)
        figure.canvas.draw()
        pictures.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3]))
        figure.set_dpi(dots)
    plt.close(figure)
    stay = np.rint(1000 * np.broadcast_to(seconds, len(pictures))).astype(int).tolist()
    content = io.BytesIO()
    pictures[-1].save(content, "PNG", save_all=True, append_images=pictures[:-1], loop=0,
                      duration=[stay[-1], *stay[:-1]])
    width, height = np.array(pictures[0].size) // DOTS
    display.display(display.Image(content.getvalue(), format="png", width=int(width),
                                  height=int(height)))


# Pictures

def image(axes, picture, title="", light=False):
    """A picture (H, W) or (H, W, 3), as it is: 0 black, 1 full, beyond that clipped.

    light: the picture holds amounts of light, whose means are what a pixel receives, and is shown
    with the numbers that a screen takes for them (image.to_srgb).
    """
    picture = np.clip(np.asarray(picture, float), 0, 1)
    picture = to_srgb(picture) if light else picture
    height, width = picture.shape[:2]
    zoom = DOTS * axes.bbox.width / width          # dots to a pixel: a whole number, or many
    is_sharp = zoom > 2.9 or (zoom > 0.99 and abs(zoom - round(zoom)) < 0.01)
    axes.imshow(picture, origin="lower", extent=(0, width, 0, height), cmap="gray", vmin=0, vmax=1,
                interpolation="nearest" if is_sharp else "antialiased")
    if axes.bbox.width >= 16 * width:              # pixels that are looked at one by one
        pixel_borders(axes, width, height)
    screen(axes, width, height, title)


def pixel_borders(axes, width, height):
    axes.hlines(np.arange(1, height), 0, width, color="#cccccc", linewidth=0.5, zorder=0.5)
    axes.vlines(np.arange(1, width), 0, height, color="#cccccc", linewidth=0.5, zorder=0.5)


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
    value = np.where(face % 2, 0.90, 0.64) + 0.1 * (face * np.sqrt(3) % 1)  # neighbours, in grey
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
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0, fontsize=9)


def signed(axes, values, title="", largest=None):
    """Values (H, W) of both signs: red below zero, white at zero, blue above, on one scale.

    The scale ends at the largest value, or where largest says: what is beyond has its colour.
    """
    most = np.nanmax(np.abs(values), initial=0.0) or 1.0
    end = largest or most
    beyond = "≥ " if largest and most > largest else ""
    image(axes, SIGNED(0.5 + 0.5 * np.asarray(values) / end)[..., :3], title)
    _scale(axes, SIGNED, f"{beyond.replace('≥', '≤')}{-end:.3g}", f"{beyond}{end:+.3g}")


def _scale(axes, colours, low, high):
    """A colour scale under the picture, between the labels of the two corners."""
    dots = axes.bbox.height
    bar = axes.inset_axes((0.36, -15 / dots, 0.28, 7 / dots))
    bar.imshow(np.linspace(0, 1, 128)[None], aspect="auto", cmap=colours)
    bar.set_axis_off()
    for x, side, text in ((0.345, "right", low), (0.655, "left", high)):
        axes.text(x, -11.5 / dots, text, transform=axes.transAxes, ha=side, va="center",
                  fontsize=9, color="#444444")


# Meshes on the screen

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
    width = np.clip(0.04 * length, 0.25, 1.0)
    collection.set_linewidth(width)
    if width > 0.8:                                # few lines: to be seen on dark pixels, too
        collection.set_path_effects([withStroke(linewidth=width + 1.6, foreground="white")])


# Gradients

def arrows(axes, points, gradients, color=GREEN, of_longest=None):
    """The descent direction, -gradient (N, 2), at points (N, 2): where a step would move them.

    All arrows have one scale: the longest is an eighth of the Axes wide, its gradient is stated.
    of_longest: the gradient that gets this length instead, to compare two Axes.
    """
    lengths = np.linalg.norm(gradients, axis=1)
    longest = lengths.max(initial=0.0)
    axes.scatter(*points.T, s=12, color=color, zorder=5)
    if longest > 0:
        scale = (of_longest or longest) / (np.ptp(axes.get_xlim()) / 8)
        axes.quiver(*points.T, *-gradients.T, color=color, angles="xy", scale_units="xy",
                    scale=scale, width=0.007, zorder=4, path_effects=HALO)
    stated = f"longest arrow: |gradient| = {longest:.3g}" if longest else "no gradient"
    axes.annotate(stated, (1, 0), (-5, 6), xycoords="axes fraction", textcoords="offset points",
                  ha="right", color=color, fontsize=9, path_effects=HALO, zorder=5,
                  bbox={"color": "white", "alpha": 0.8, "pad": 1.5})
