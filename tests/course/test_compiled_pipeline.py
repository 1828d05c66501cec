"""The kernels, with and without numba, are the pipeline of NumPy: the same bits, and gradients."""
import os
import subprocess
import sys
import time

import numpy as np
import pytest

from course.given import compiled, mesh
from course.given.compiled import without_kernels
from labkit import places
from reference import antialiasing, compiled_pipeline, pipeline, rasterization, transforms
from reference.pipeline import Colours

WIDTH, HEIGHT = 13, 11
SCENES = 300 if compiled.is_installed() else 25  # kernels of plain Python are slow
BUFFERS = "clip", "face_index", "depth", "barycentric", "colour"


def hostile(rng):
    """Few vertices, on a coarse grid: corners on pixels' centres, slivers, equal depths. Some w are
    negative or 0, and some numbers nan.
    """
    x, y = rng.integers(-2, 2 * WIDTH + 3, 12) / 2, rng.integers(-2, 2 * HEIGHT + 3, 12) / 2
    w = rng.choice([1.0, 1.0, 2.0, 0.5], 12)
    clip = np.stack([2 * x / WIDTH - 1, 2 * y / HEIGHT - 1, rng.integers(-5, 6, 12) / 4,
                     np.ones(12)], -1) * w[:, None]
    kind = rng.integers(4)
    if kind == 1:
        clip = rng.normal(size=(12, 4)) * [1, 1, 0.3, 1]
    if kind == 2:
        clip[rng.integers(12), 3] *= rng.choice([0.0, -1.0, 1e-13])
    if kind == 3:
        clip[rng.integers(12), rng.integers(4)] = rng.choice([np.nan, np.inf, 1e200])
    return clip, rng.integers(0, 12, (rng.integers(1, 20), 3))


def ball(rng):
    """Many small faces, half of them hidden."""
    positions, faces = mesh.icosphere(2000 if compiled.is_installed() else 80)
    camera = transforms.perspective(0.9, WIDTH / HEIGHT, 0.1, 20.0)
    camera = camera @ transforms.translate(np.array([0.1, -0.2, -3.0]))
    return pipeline.to_clip(positions, camera), faces


def scenes():
    rng = np.random.default_rng(3)
    for build in [ball] + [hostile] * SCENES:
        clip, faces = build(rng)
        colours = Colours(rng.normal(size=(len(clip), rng.choice([1, 3]))))
        background = rng.normal(size=colours.colours.shape[1])
        yield (clip, faces, antialiasing.opposite_corners(faces), colours, WIDTH, HEIGHT,
               background), rng


def is_sound(clip, faces, drawn):
    """No number is huge, no vertex near the camera plane, no sliver seen: they lose digits."""
    if not np.abs(clip).max() < 1e3 or np.abs(clip[:, 3]).min() < 1e-2:
        return False
    x, y, _ = rasterization.screen_points(clip, WIDTH, HEIGHT)
    seen = faces[np.unique(drawn.face_index[drawn.face_index >= 0])]
    corners = np.stack([x, y], -1)[seen]
    sides = np.roll(corners, 1, 1) - corners
    area = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    return (area > 1e-2 * (sides**2).sum(2).max(1)).all()


def same(found, expected):
    return np.array_equal(found, expected, equal_nan=True)


def test_pictures_and_buffers_are_the_same_bits():
    """A tie is decided otherwise, or a sum is rounded otherwise, on one pixel of many."""
    blended, met = 0, 0
    for scene, _ in scenes():
        with np.errstate(all="ignore"):
            expected, buffers = without_kernels(pipeline.draw)(*scene)
            picture, drawn = compiled_pipeline.draw(*scene)
            assert same(picture, expected)
            for name in BUFFERS:
                assert same(getattr(drawn, name), getattr(buffers, name)), name
            for found, pairs in zip(drawn.pairs, buffers.pairs, strict=True):
                assert same(found, pairs)
        blended += len(buffers.pairs.c)
        met += (buffers.pairs.ends[0] >= len(scene[0])).sum()
    assert blended > SCENES and met > SCENES / 5


def test_gradients_are_the_same_but_for_the_order_of_sums():
    """A run's sum, an edge's end or the pixels of a pair are left out or counted twice."""
    compared = 0
    for scene, rng in scenes():
        clip, faces, _, colours, *_ = scene
        with np.errstate(all="ignore"):
            _, buffers = without_kernels(pipeline.draw)(*scene)
            _, drawn = compiled_pipeline.draw(*scene)
            if not is_sound(clip, faces, drawn):
                continue
        compared += 1
        upstream = rng.normal(size=buffers.colour.shape)
        depth = rng.normal(size=buffers.depth.shape)
        expected, grad_clip = without_kernels(pipeline.draw_backward)(
            upstream, buffers, faces, colours, depth)
        found, clip_found = compiled_pipeline.draw_backward(upstream, drawn, faces, colours, depth)
        for gradient, other in (expected.colours, found.colours), (grad_clip, clip_found):
            assert np.abs(gradient - other).max() <= 1e-12 * np.abs(gradient).max()
    assert compared > SCENES / 5


def all_of(scene, threads, monkeypatch):
    """What a scene gives with so many threads, as arrays."""
    monkeypatch.setattr(compiled, "cores", lambda: threads)
    picture, drawn = compiled_pipeline.draw(*scene)
    upstream = np.sin(np.arange(picture.size)).reshape(picture.shape)
    material, grad_clip = compiled_pipeline.draw_backward(upstream, drawn, *scene[1:4:2])
    return picture, drawn.face_index, drawn.depth, *drawn.pairs, *material, grad_clip


@pytest.mark.parametrize("by_faces", [False, True])
def test_two_threads_find_the_same_bits_as_one(by_faces, monkeypatch):
    """Threads add to one vertex in the order in which they come, or two faces are equally deep."""
    monkeypatch.setattr(compiled_pipeline, "SMALL", 0)
    monkeypatch.setattr(compiled_pipeline, "BAND", 20)
    for (scene, _), _ in zip(scenes(), range(12), strict=False):
        scene = list(scene)
        if by_faces:
            repeated = 1 + WIDTH * HEIGHT // len(scene[1])
            scene[1] = np.tile(scene[1], (repeated, 1))
            scene[2] = np.tile(scene[2], (repeated, 1))
        with np.errstate(all="ignore"):
            one, two = (all_of(scene, threads, monkeypatch) for threads in (1, 2))
        assert all(map(same, one, two))


def test_faces_without_their_vertices_are_refused():
    """A kernel reads on in memory."""
    clip = np.ones((3, 4))
    for faces in np.array([[0, 1, 3]]), np.array([[0, -1, 2]]), np.array([[0.0, 1.0, 2.0]]):
        with pytest.raises(ValueError, match="faces"):
            compiled_pipeline.visible(clip, faces, 4, 4)


def one_face(scale=1.0, faces=((0, 1, 2),)):
    """A face over half of 4 x 4 pixels, and what `draw` makes of it."""
    clip = scale * np.array([[-1.0, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]])
    scene = clip, np.array(faces), np.full((1, 3), -1), Colours(np.eye(3)), 4, 4, np.zeros(3)
    return scene, compiled_pipeline.draw(*scene)


@pytest.mark.parametrize("width, height", [(0, 4), (4, 0)])
def test_a_picture_may_have_no_pixels(width, height):
    """A division by its width, or a row that ends before it begins."""
    scene, _ = one_face()
    image = pipeline.Texture(np.ones((3, 2)), np.array([[0, 1, 2]]), np.ones((2, 2, 3)))
    for material in scene[3], image:
        picture, buffers = compiled_pipeline.draw(*scene[:3], material, width, height, np.zeros(3))
        assert picture.shape == (height, width, 3)
        _, grad_clip = compiled_pipeline.draw_backward(picture, buffers, scene[1], material)
        assert not grad_clip.any()


def changed(scene, **parts):
    names = "clip", "faces", "opposite", "material", "width", "height", "background"
    return *(parts.get(name, part) for name, part in zip(names, scene, strict=True)),


@pytest.mark.parametrize("parts", [
    {"clip": np.ones((3, 3))}, {"clip": np.ones((2, 4))}, {"faces": np.array([[0, 1]])},
    {"opposite": np.zeros((1, 2), int)}, {"opposite": np.zeros((0, 3), int)},
    {"material": Colours(np.ones((2, 3)))}, {"material": Colours(np.ones((3, 2)))},
    {"background": np.zeros(4)},
    {"material": pipeline.Texture(np.ones((3, 2)), np.zeros((0, 3), int), np.ones((2, 2, 3)))},
    {"material": pipeline.Texture(np.ones((2, 2)), np.array([[0, 1, 2]]), np.ones((2, 2, 3)))},
    {"material": pipeline.Texture(np.ones((3, 1)), np.array([[0, 1, 2]]), np.ones((2, 2, 3)))},
    {"material": pipeline.Texture(np.ones((3, 2)), np.array([[0, 1, 2]]), np.ones((2, 2, 2)))}])
def test_a_scene_of_wrong_sizes_is_refused_before_a_kernel_reads_it(parts):
    """A kernel reads on in memory: garbage in the picture, or the process dies."""
    scene = changed(one_face()[0], **parts)
    for draw in compiled_pipeline.draw, without_kernels(pipeline.draw):
        with pytest.raises((ValueError, IndexError)):
            draw(*scene)


def ways_back(buffers, **parts):
    """Calls of the way back, compiled and not, of which a part is changed."""
    pairs = buffers.pairs._replace(**{name: parts.pop(name) for name in ("ends", "other")
                                      if name in parts})
    given = {"grad_picture": np.ones((4, 4, 3)), "faces": np.array([[0, 1, 2]]),
             "material": Colours(np.eye(3))} | parts
    buffers = buffers._replace(pairs=pairs, **{name: given.pop(name) for name in
                                               ("face_index", "clip") if name in given})
    for way in compiled_pipeline.draw_backward, without_kernels(pipeline.draw_backward):
        yield lambda way=way: way(given["grad_picture"], buffers, given["faces"], given["material"])


@pytest.mark.parametrize("parts", [
    {"grad_picture": np.ones((1, 1, 3))}, {"grad_picture": np.ones((4, 3, 3))},
    {"grad_picture": np.ones((4, 4, 2))}, {"face_index": np.ones((4, 4), np.int32)},
    {"face_index": np.zeros((5, 4), np.int32)}, {"faces": np.array([[0, 1, 3]])},
    {"faces": np.array([[0, -4, 1]])}, {"faces": np.zeros((0, 3), int)},
    {"material": Colours(np.ones((2, 3)))}, {"clip": np.ones((2, 4))},
    {"other": np.full(3, 16)}, {"other": np.zeros(2, int)}, {"ends": np.full((2, 3), 3)}])
def test_a_way_back_of_wrong_sizes_is_refused(parts):
    """Gradients are added to what lies beside an array."""
    (_, (_, buffers)) = one_face()
    for way in ways_back(buffers, **parts):
        with pytest.raises((ValueError, IndexError)):
            way()


def test_pixels_gradients_of_another_size_are_refused():
    """The kernel reads beside them."""
    (_, (_, buffers)) = one_face()
    for to_vertices in compiled_pipeline.to_vertices, without_kernels(pipeline.to_vertices):
        with pytest.raises((ValueError, IndexError)):
            to_vertices(np.ones((3, 4, 1)), buffers, np.array([[0, 1, 2]]))
        with pytest.raises((ValueError, IndexError)):
            to_vertices(np.ones((4, 4, 1)), buffers, np.array([[0, 1, 3]]))


def test_the_way_back_takes_the_material_that_it_is_given():
    """It takes the one that was drawn."""
    (_, (_, buffers)) = one_face()
    given = Colours(np.arange(9.0).reshape(3, 3)**2)
    (found, found_clip), (expected, grad_clip) = (
        way() for way in ways_back(buffers, material=given))
    np.testing.assert_allclose(found.colours, expected.colours, rtol=1e-12)
    np.testing.assert_allclose(found_clip, grad_clip, rtol=0, atol=1e-12)
    assert np.abs(grad_clip - next(ways_back(buffers))()[1]).max() > 1


@pytest.mark.parametrize("scale", [1e-300, 1e-170, 1e160, 1e300])
@pytest.mark.parametrize("is_textured", [False, True])
def test_the_unit_of_clip_space_is_free(scale, is_textured):
    """Products of two coordinates over- or underflow: NaN, or 0, for the gradients of colours."""
    material = Colours(np.eye(3))
    if is_textured:
        image = np.random.default_rng(0).normal(size=(4, 4, 3))
        uv = np.array([[0.1, 0.2], [0.8, 0.3], [0.4, 0.9]])
        material = pipeline.Texture(uv, np.array([[0, 1, 2]]), image)
    (expected, grad_clip), (found, found_clip) = (
        compiled_pipeline.draw_backward(np.ones((4, 4, 3)) * [1, 2, 3], drawn, scene[1], material)
        for scene, (_, drawn) in (one_face(), one_face(scale)))
    np.testing.assert_allclose(found[0], expected[0], rtol=1e-12)
    np.testing.assert_allclose(found_clip * scale, grad_clip, rtol=0, atol=1e-12)


@pytest.mark.parametrize("numba", ["None", "sys.modules.get('numba')"])
def test_the_reference_uses_kernels_where_numba_is(numba):
    """Nobody uses them, or labs and what is checked do, which run what a student wrote."""
    code = f"""
import sys, importlib.util
installed = importlib.util.find_spec("numba") is not None and {numba} is not None
from course.given import compiled
compiled.is_installed = lambda: installed
from reference import pipeline
from labs import pipeline as own
print(installed == hasattr(pipeline.draw, "__wrapped__"), hasattr(own.draw, "__wrapped__"))
"""
    told = subprocess.run([sys.executable, "-c", code], cwd=places.ROOT, capture_output=True,
                          text=True, check=True).stdout
    assert told.split() == ["True", "False"]


KERNEL = """from collections import namedtuple
from course.given.compiled import kernel
Pair = namedtuple("Pair", "x y")
@kernel
def total(pair): return pair.x + pair.y
print(total(Pair(2.0, 3.0)))
"""


@pytest.mark.skipif(not compiled.is_installed(), reason="nothing is compiled")
def test_a_named_tuple_of_a_kernel_may_get_another_name(tmp_path):
    """numba fails at what it kept: it looks for the old name before it sees that a file changed."""
    module = tmp_path / "changed_kernels.py"
    for age, name in (60, "Pair"), (-60, "Both"):
        module.write_text(KERNEL.replace("Pair", name))
        os.utime(module, (time.time() - age,) * 2)
        done = subprocess.run([sys.executable, "-c", "import changed_kernels"], text=True,
                              capture_output=True, cwd=tmp_path, check=True,
                              env=os.environ | {"PYTHONPATH": f"{tmp_path}:{places.ROOT}"})
        assert done.stdout == "5.0\n"


def test_without_the_kernels_a_released_reference_is_numpy(monkeypatch):
    """A hand-out has solutions of labs 1 to 9, no course/fast, and numba: nothing is drawn."""
    monkeypatch.setattr(compiled, "is_installed", lambda: True)
    def draw(): ...
    draw.__module__ = "reference.pipeline"
    assert compiled.has_kernels("not_handed_out")(draw) is draw
    assert compiled.has_kernels("compiled_pipeline")(draw).__wrapped__ is draw


@pytest.mark.parametrize("slow", [0, 1, 6])
def test_the_results_of_bands_come_in_their_order(slow):
    """What was done ahead during a slow band comes before it, twice, or not at all."""
    def band(k):
        time.sleep(0.03 * (k == slow))
        return k

    for threads in (1, 2, 3):
        bands = [(k,) for k in range(12)]
        assert list(compiled.each_band(band, bands, threads)) == list(range(12))


def test_an_error_in_a_band_is_raised():
    """It stays in a thread, and the picture lacks some rows."""
    with pytest.raises(ZeroDivisionError):
        list(compiled.each_band(lambda k: 1 / k, [(k,) for k in (3, 2, 1, 0)], 2))
