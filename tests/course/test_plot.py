"""Figures: rows where the arrays say they are, in colours that all readers tell apart.

What else they draw stands in the lectures, whose pictures are compared once a week.
"""
import io

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from PIL import Image, ImageSequence

from course.given import image, plot

pytestmark = pytest.mark.usefixtures("style")


def dots(axes):
    """The dots that an Axes covers, (height, width, 3) from 0 to 255, row 0 at the bottom."""
    axes.figure.set_dpi(100 * plot.DOTS)
    axes.figure.canvas.draw()
    drawn = np.asarray(axes.figure.canvas.buffer_rgba())[::-1, :, :3]
    left, bottom, right, top = np.round(axes.bbox.extents).astype(int)
    return drawn[bottom:top, left:right]


def png(figure):
    content = io.BytesIO()
    figure.savefig(content, metadata={"Software": None})
    return content.getvalue()


def test_row_0_is_at_the_bottom_and_overlays_share_its_coordinates():
    """Rows upside down, and an extent half a pixel off."""
    picture = np.zeros((4, 6, 3))
    picture[0, 5] = 1.0
    axes, = plot.panels([(4, 6)])
    plot.image(axes, picture)
    axes.fill([1, 2, 2, 1], [3, 3, 4, 4], color="white", linewidth=0, snap=True)
    shown = dots(axes)
    zoom = shown.shape[0] // 4
    assert shown[zoom // 2, int(5.5 * zoom)].min() == 255
    assert shown[int(3.5 * zoom), int(1.5 * zoom)].min() == 255
    assert shown[zoom // 2, zoom // 2].max() == 0


def test_a_panel_that_would_be_small_is_refused():
    """A row of five pictures of the size of stamps."""
    with pytest.raises(ValueError, match=r"would be \[152. 152.\] displayed pixels, and 200"):
        plot.panels([(64, 64)] * 5)


# Machado, Oliveira and Fernandes 2009, severity 1.0, table of the supplement: how linear colours
# look to the colour-blind.
BLIND = {
    "no": np.eye(3),
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
               [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
               [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
               [0.004733, 0.691367, 0.303900]]}


def lab(linear):
    """Linear sRGB colours (N, 3) -> CIE L*a*b* of D65."""
    xyz = linear @ np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722],
                             [0.0193, 0.1192, 0.9505]]).T / [0.9505, 1.0, 1.089]
    f = np.where(xyz > 216 / 24389, np.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], -1)


def least_distance(points):
    distances = np.linalg.norm(points[:, None] - points, axis=-1)
    return distances[np.triu_indices(len(points), 1)].min()


@pytest.mark.parametrize("kind", BLIND)
def test_the_colours_differ_for_the_colour_blind(kind):
    """Two curves that some readers cannot tell apart."""
    names = plot.BLACK, plot.ORANGE, plot.SKY, plot.GREEN, plot.BLUE, plot.RED
    linear = image.to_linear([mpl.colors.to_rgb(name) for name in names])
    assert least_distance(lab(np.clip(linear @ np.array(BLIND[kind]).T, 0, 1))) > 15


def test_the_colours_of_two_curves_differ_in_grey_print():
    """Blue and red of one brightness, the two that most figures compare; red that is orange."""
    colours = np.array([mpl.colors.to_rgb(name) for name in (plot.BLUE, plot.ORANGE, plot.RED)])
    brightness = lab(image.to_linear(colours))[:, 0]
    assert least_distance(brightness[:2, None]) > 15
    red, green, blue = colours[2]
    assert red > 0.7 and max(green, blue) < 0.25


def test_a_film_shows_each_frame_for_its_time(monkeypatch):
    """Axes that keep the frame before; a last frame that goes by, and is not what is printed."""
    shown = []
    monkeypatch.setattr("IPython.display.display", shown.append)
    figure, axes = plt.subplots(figsize=(4, 3))
    plot.film(figure, lambda k: axes.plot([0, k], color=plot.RED), range(3), [0.1, 0.1, 0.8])
    film, = shown
    opened = Image.open(io.BytesIO(film.data))
    assert (opened.n_frames, opened.size, film.width, film.height) == (3, (800, 600), 400, 300)
    durations = [frame.info["duration"] for frame in ImageSequence.Iterator(opened)]
    assert durations == [800, 100, 100]
    assert len(axes.lines) == 1 and not plt.get_fignums()


@pytest.mark.parametrize("depth, seen_as", [(np.inf, plot.BACKGROUND), (3.0, plot.DEPTHS(0.0)[:3])])
def test_an_empty_or_flat_depth_picture_is_drawn(depth, seen_as):
    """The least of no depths, division by a range that is zero."""
    axes, = plot.panels([(2, 2)])
    plot.depth(axes, np.full((2, 2), depth))
    assert np.array_equal(plot.depth_colours(np.full((1, 1), depth)), [[seen_as]])


def test_faces_have_stable_colours_that_differ_and_none_is_white():
    """Colours that depend on which other faces are seen; neighbours alike; the background lost."""
    colours = plot.face_colours(np.arange(5000))
    assert np.array_equal(plot.face_colours(np.array([[-1, 4321]]))[0, 1], colours[4321])
    assert np.array_equal(plot.face_colours(np.array(-1)), np.ones(3))
    assert np.abs(np.diff(colours, axis=0)).max(axis=-1).min() > 0.3
    assert len(np.unique(np.round(colours * 255), axis=0)) > 4800
    assert colours.min(axis=-1).max() < 0.9


def test_zero_gradients_are_told_not_divided_by():
    """Arrows of length nan, or no word of what is missing."""
    axes, = plot.panels([(4, 4)])
    plot.screen(axes, 4, 4)
    plot.arrows(axes, np.ones((2, 2)), np.zeros((2, 2)))
    with np.errstate(all="raise"):
        dots(axes)
    assert [text.get_text() for text in axes.texts] == ["no gradient"]


def test_a_figure_is_small_and_does_not_tell_versions(rng):
    """Pictures that fill the repository; bytes that change with every matplotlib."""
    y, x = np.indices((128, 128)) / 128
    shaded = np.stack([x, y, x * y], axis=-1)
    content = png(plot.strip([shaded] * 3, ["red", "green", "blue: the finding stands here"]))
    assert len(content) < 60_000
    opened = Image.open(io.BytesIO(content))
    assert opened.width == plot.PAGE_WIDTH and "Software" not in opened.info


def test_the_readers_own_settings_change_nothing():
    """A matplotlibrc or an earlier cell that leaves its mark on the course's figures."""
    expected = png(plot.strip([np.eye(4)], ["eye"]))
    mpl.rcParams.update({"font.size": 20, "image.origin": "upper", "savefig.facecolor": "red"})
    plot.style()
    assert png(plot.strip([np.eye(4)], ["eye"])) == expected
