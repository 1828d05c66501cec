"""Figures: every dot where the arrays say it is, and every stated number right."""
import io

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.text import Text
from PIL import Image, ImageSequence

from course.given import image, plot, plot_triangle

pytestmark = pytest.mark.usefixtures("style")


def dots(axes):
    """The dots that an Axes covers, (height, width, 3) from 0 to 255, row 0 at the bottom."""
    axes.figure.set_dpi(100 * plot.DOTS)
    axes.figure.canvas.draw()
    drawn = np.asarray(axes.figure.canvas.buffer_rgba())[::-1, :, :3]
    left, bottom, right, top = np.round(axes.bbox.extents).astype(int)
    return drawn[bottom:top, left:right]


def screen(height, width):
    """An Axes with the coordinates of a picture of this size, and nothing in it."""
    axes, = plot.panels([(height, width)])
    plot.screen(axes, width, height)
    return axes


def texts(axes):
    return [text.get_text() for text in axes.texts]


def assert_is_enlarged(shown, picture):
    """Each pixel of the picture is a square of equal dots; the lines between are not looked at."""
    zoom = shown.shape[0] // picture.shape[0]
    expected = np.round(picture * 255).repeat(zoom, axis=0).repeat(zoom, axis=1)
    assert shown.shape == expected.shape
    y, x = np.indices(shown.shape[:2]) % zoom
    inside = (2 <= y) & (y < zoom - 2) & (2 <= x) & (x < zoom - 2) if zoom > 4 else y >= 0
    inside[[0, 1, -2, -1]] = inside[:, [0, 1, -2, -1]] = False
    assert np.abs(shown[inside] - expected[inside]).max() <= 1


def png(figure):
    content = io.BytesIO()
    figure.savefig(content, metadata={"Software": None})
    return content.getvalue()


def test_every_pixel_is_the_same_number_of_dots(rng):
    """Interpolation, a zoom that is not whole, and panels that begin between two dots."""
    pictures = [rng.random((12, 10, 3)), rng.random((7, 30, 3)), rng.random((150, 150, 3))]
    axes = plot.panels([picture.shape[:2] for picture in pictures])
    for place, picture in zip(axes, pictures, strict=True):
        plot.image(place, picture, "a title of two lines, which must not move the picture at all")
    for place, picture in zip(axes, pictures, strict=True):
        assert_is_enlarged(dots(place), picture)


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


def test_a_picture_can_be_an_inset():
    """A magnifying glass over a picture, which stands in no row of panels."""
    axes, = plot.panels([(8, 8)])
    plot.image(axes, np.zeros((8, 8)))
    plot.image(axes.inset_axes((0.5, 0.5, 0.5, 0.5)), np.ones((2, 2)), "the upper right corner")
    shown = dots(axes)
    assert shown[-20, -20].min() == 255 and shown[20, 20].max() == 0


def test_grey_is_not_stretched_to_black_and_white():
    """Scaling each picture by its own range, which hides an error of brightness."""
    axes, = plot.panels([(2, 2)])
    plot.image(axes, np.array([[0.5, 0.25], [0.5, 7.0]]))
    shown = dots(axes)
    middle = shown.shape[0] // 4
    assert abs(int(shown[middle, middle, 0]) - 128) <= 1
    assert shown[-middle, -middle, 0] == 255


@pytest.mark.parametrize(("pictures", "sizes"), [
    ([(16, 16), (64, 64), (4, 4)], [(256, 256)] * 3), ([(8, 4), (4, 8)], [(320, 640), (440, 220)]),
    ([(1024, 1024)] * 2, [(440, 440)] * 2), ([(64, 64)] * 4, [(200, 200)] * 4)])
def test_pictures_are_shown_alike_and_fill_the_page(pictures, sizes):
    """A row of resolutions in which each picture has another size; a picture that leaves the page.
    """
    axes = plot.panels(pictures)
    assert [tuple(np.round(place.bbox.size, 6)) for place in axes] == sizes


def test_a_panel_that_would_be_small_is_refused():
    """A row of five pictures of the size of stamps."""
    with pytest.raises(ValueError, match=r"would be \[152. 152.\] displayed pixels, and 200"):
        plot.panels([(64, 64)] * 5)


def test_a_chart_beside_pictures_has_room_for_its_labels():
    """Labels of the axis that lie over the picture beside it."""
    picture, axes = plot.panels([(8, 8), (8, 8)])
    plot.image(picture, np.eye(8))
    plot.chart(axes).plot([0, 1000], [0, 1000])
    axes.set_ylabel("loss")
    axes.figure.canvas.draw()
    assert axes.get_tightbbox().x0 > picture.bbox.x1
    assert axes.get_tightbbox().y0 >= 0


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


def test_titles_of_a_strip_stay_on_the_page_and_apart():
    """A long title that runs into the next one, or off the top."""
    long = "sixteen samples for each pixel, and the silhouette is still not what it should be " * 2
    figure = plot.strip([np.eye(32)] * 4, [long] * 4)
    figure.canvas.draw()
    titles = figure.findobj(lambda artist: isinstance(artist, Text) and "sixteen" in str(artist))
    boxes = [title.get_window_extent() for title in titles]
    assert max(box.y1 for box in boxes) <= figure.bbox.height
    edges = [*[box.x0 for box in boxes[1:]], figure.bbox.width]
    assert all(box.x1 < edge for box, edge in zip(boxes, edges, strict=True))


def test_near_is_bright_far_is_dark_and_no_surface_is_neither():
    """An inverted scale; a background that could be a depth."""
    colours = plot.depth_colours(np.array([[1.0, 2.0, 3.0, np.inf]]))[0]
    brightness = colours.sum(axis=-1)
    assert brightness[0] > brightness[1] > brightness[2]
    every_depth = plot.depth_colours(np.linspace(0, 1, 500)[None])[0]
    assert np.abs(every_depth - colours[3]).max(axis=-1).min() > 0.1


def test_a_depth_picture_states_its_range():
    """A scale that counts the background in, or the wrong way round."""
    axes, = plot.panels([(2, 2)])
    plot.depth(axes, np.array([[2.5, np.inf], [np.inf, 4.25]]))
    assert texts(axes) == ["2.5", "4.25"]


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


def test_barycentrics_are_red_green_blue_on_white():
    """Components in another order, a black background."""
    axes, = plot.panels([(2, 2)])
    barycentric = np.concatenate([np.eye(3), np.zeros((1, 3))]).reshape(2, 2, 3)
    plot.barycentric(axes, barycentric, np.array([[0, 0], [0, -1]]))
    assert axes.images[0].get_array().tolist() == [[[1, 0, 0], [0, 1, 0]], [[0, 0, 1], [1, 1, 1]]]


def test_a_wireframe_draws_each_edge_once_and_keeps_the_screen():
    """Shared edges drawn twice, thus darker; vertices off the screen that shrink the picture."""
    vertices = np.array([[0, 0, 0.5], [4, 0, 0.5], [4, 4, 0.5], [0, 40, 0.5]])
    axes = screen(4, 4)
    plot.wireframe(axes, vertices, np.array([[0, 1, 2], [0, 2, 3]]))
    assert len(axes.collections[0].get_segments()) == 5
    assert axes.get_xlim() == axes.get_ylim() == (0, 4)


def test_a_wireframe_of_thousands_of_faces_stays_visible_and_open():
    """Lines so thick that they run together, or so thin that they vanish."""
    row, column = np.indices((51, 51))
    vertices = 5.0 * np.stack([column, row], axis=-1).reshape(-1, 2)
    corner = (51 * row + column)[:50, :50].reshape(-1, 1, 1)
    faces = (corner + np.array([[0, 1, 52], [0, 52, 51]])).reshape(-1, 3)
    axes = screen(256, 256)
    plot.wireframe(axes, vertices, faces)
    ink = 255 - dots(axes)[20:-40, 20:-40].mean()
    assert 30 < ink < 70


def test_samples_stand_at_pixel_centres_and_are_filled_where_covered():
    """Samples at the pixels' corners; rows and columns exchanged."""
    axes, = plot.panels([(2, 4)])
    covered = np.zeros((2, 4), bool)
    covered[1, 3] = True
    triangle = np.array([[0.2, 0.2], [3.9, 0.4], [3.6, 1.9]])
    plot_triangle.triangle_pixels(axes, triangle, 4, 2, covered)
    samples = axes.collections[-1]
    where = np.asarray(samples.get_offsets())
    assert {tuple(place) for place in where} == {(x + 0.5, y + 0.5)
                                                 for x in range(4) for y in range(2)}
    white = (samples.get_facecolors()[:, :3] == 1).all(axis=1)
    assert where[~white].tolist() == [[3.5, 1.5]]
    assert texts(axes) == ["0", "1", "2"]


def test_both_signs_have_one_scale():
    """A scale from least to greatest value, on which zero is not white; no scale for zeros."""
    axes, zeros = plot.panels([(1, 3), (2, 2)])
    plot.signed(axes, np.array([[-4.0, 0.0, 1.0]]))
    below, zero, above = axes.images[0].get_array()[0]
    assert below[0] - below[2] > 0.3 > above[2] - above[0] > 0 and np.ptp(zero) < 0.02
    assert texts(axes) == ["-4", "+4"]
    plot.signed(zeros, np.zeros((2, 2)))
    assert zeros.images[0].get_array().min() > 0.9


def edge_values(a, b, width, height):
    y, x = np.indices((height, width)) + 0.5
    return (a[1] - b[1]) * (x - a[0]) + (b[0] - a[0]) * (y - a[1])


def test_an_edge_function_is_white_at_zero_and_its_normal_points_into_the_blue():
    """A colour scale that is not centred; a normal that points outside."""
    a, b = np.array([1.0, 1.0]), np.array([7.0, 3.0])
    axes, = plot.panels([(8, 8)])
    values = edge_values(a, b, 8, 8)
    values[0, 0] = 0.0
    plot_triangle.edge_function(axes, values, a, b)
    shown = axes.images[0].get_array()
    assert np.ptp(shown[0, 0]) < 0.02 and shown[0, 0].min() > 0.95
    assert shown[7, 0, 2] > shown[7, 0, 0] and shown[0, 7, 0] > shown[0, 7, 2]
    name = axes.texts[texts(axes).index("n")]
    end = np.array(name.xy)
    assert np.dot(end - (a + b) / 2, b - a) == pytest.approx(0)
    assert (a[1] - b[1]) * (end[0] - a[0]) + (b[0] - a[0]) * (end[1] - a[1]) > 0


def test_arrows_point_downhill_and_state_their_scale():
    """Arrows along the gradient, so that a step would go uphill; a scale nobody can read off."""
    axes = screen(16, 16)
    plot.arrows(axes, np.array([[4.0, 4.0], [8.0, 8.0]]), np.array([[3.0, 4.0], [0.5, 0.0]]))
    quiver = axes.collections[-1]
    assert quiver.U.tolist() == [-3.0, -0.5] and quiver.V.tolist() == [-4.0, 0.0]
    assert 5 / quiver.scale == 2
    assert texts(axes) == ["longest arrow: |gradient| = 5"]


def test_zero_gradients_are_told_not_divided_by():
    """Arrows of length nan, or no word of what is missing."""
    axes = screen(4, 4)
    plot.arrows(axes, np.ones((2, 2)), np.zeros((2, 2)))
    with np.errstate(all="raise"):
        dots(axes)
    assert texts(axes) == ["no gradient"]


def test_labels_have_a_colour_and_a_count_each():
    """A label has the colour or the name of another one, or the legend tells of absent ones."""
    axes, = plot.panels([(2, 3)], columns=3)
    plot.labels(axes, np.array([[0, 2, 2], [2, 0, 2]]), ["sky", "sea", "land"])
    picture = axes.images[0].get_array()
    assert (picture[0, 0] == picture[1, 1]).all() and (picture[0, 0] != picture[0, 1]).any()
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["sky: 2", "land: 4"]


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
