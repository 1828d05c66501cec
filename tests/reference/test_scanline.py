"""Whole pictures of lab 2: the fast rasterizer, and the loop that it equals to the bit."""
import inspect
import tracemalloc
import types
from pathlib import Path

import numpy as np
import pytest
from half_planes import half_plane_loop
from screen_scenes import on_screen

from course.given import arrays, mesh
from reference import interpolation, pipeline, rasterization, scanline, transforms
from tests.labs import test_rasterization as lab_2

GOLDEN = np.load(Path(__file__).parent.parent / "golden" / "rasterize.npz")
SCENES = sorted({key.split("/")[0] for key in GOLDEN})


def golden(scene):
    return [GOLDEN[f"{scene}/{key}"] for key in
            ("clip", "faces", "face_index", "uv", "depth", "derivatives")]


@pytest.mark.parametrize("scene", SCENES)
def test_pictures_are_those_of_nvdiffrast(scene):
    """Another face, depth, weight or derivative than nvdiffrast's kernels give. Tolerances are
    those measured between its kernels in 32 and 64 bits (tests/golden/README.md)."""
    clip, faces, expected, uv, depth, derivatives = golden(scene)
    clip, faces = clip.astype(float), faces.astype(int)
    face_index, got_depth = scanline.rasterize(clip, faces, *expected.shape[::-1])
    np.testing.assert_array_equal(face_index, expected)
    seen = expected >= 0
    np.testing.assert_allclose(got_depth[seen], depth[seen], rtol=0, atol=2e-5)
    barycentric = interpolation.barycentrics(face_index, clip, faces)
    np.testing.assert_allclose(barycentric[..., :2], uv, rtol=0, atol=1e-4)
    got = interpolation.barycentrics_derivatives(face_index, clip, faces)[:, :, :2]
    np.testing.assert_allclose(got, derivatives, rtol=0, atol=3e-5 * np.abs(derivatives).max())


def bits(pictures):
    return [picture.tobytes() for picture in pictures]


def heap(seed, least_w, turn):
    """80 faces, for odd seeds with vertices on pixel centres and corners, and upon each other:
    wound alike, or the other way round if turn is -1.
    """
    rng = np.random.default_rng(seed)
    clip = rng.uniform([-2, -2, -1.5, least_w], [2, 2, 1.5, 2], (60, 4))
    faces = rng.integers(0, 60, (80, 3))
    if seed % 2:
        clip = np.round(clip * 8) / 8
        clip[:, 3] = 1 if seed < 4 or least_w > 0 else clip[:, 3]
        faces[40:] = faces[:40, ::turn]
    return clip, faces, 16, 24


@pytest.mark.parametrize("seed", range(6))
def test_whole_meshes_and_the_loop_agree_to_the_bit(seed):
    """A pixel at an edge, a tie in depth or a face at the camera plane goes to another face."""
    given = heap(seed, -1, -1)
    with np.errstate(all="ignore"):
        loop = half_plane_loop(*given)
    assert (loop[0] >= 0).sum() > 100
    assert bits(scanline.rasterize(*given)) == bits(loop)


@pytest.mark.parametrize("seed", range(6))
def test_it_draws_what_lab_2_draws(seed):
    """A sample on an edge, a tie or a clockwise face goes to another face; another depth."""
    given = heap(seed, 0.3, 1)
    with np.errstate(all="ignore"):
        face_index, depth = rasterization.rasterize.written(*given)
    by_rows = scanline.rasterize(*given)
    np.testing.assert_array_equal(by_rows[0], face_index)
    np.testing.assert_allclose(by_rows[1], depth, rtol=0, atol=1e-9)


def tips(rng, w):
    """Faces up to 1e9 pixels long and far thinner than one, their tips aimed at pixel centres."""
    tip, length = rng.integers(0, 8, (12, 2)) + 0.5, 10.0 ** rng.uniform(5, 9, (12, 1))
    angle = rng.uniform(0, 2 * np.pi, (12, 1))
    along = np.concatenate([np.cos(angle), np.sin(angle)], 1)
    across = along[:, ::-1] * [-1, 1] * length * 10.0 ** rng.uniform(-12, -6, (12, 1))
    tip -= along * rng.uniform(-0.5, 0.5, (12, 1))
    corners = np.stack([tip, tip + along * length, tip + 0.7 * along * length + across], 1)
    x, y = corners.reshape(-1, 2).T
    return on_screen(x, y, 8, 8) * np.tile(w, 12)[:, None]


def slivers(rng):
    """Corners on a line through pixel centres, but for the last bits."""
    start, step = rng.integers(0, 8, (12, 1, 2)) + 0.5, rng.integers(-3, 4, (12, 1, 2))
    corners = start + step * rng.permutation(3)[None, :, None]
    x, y = (corners + rng.integers(-3, 4, corners.shape) * 2.0 ** -50).reshape(-1, 2).T
    return on_screen(x, y, 8, 8)


def in_camera_plane(rng):
    """One corner of each face with w = 0, others behind and in front. One face is a point, 0."""
    clip = rng.normal(size=(36, 4)) * (np.arange(36) > 2)[:, None]
    clip[::3, 3] = 0
    return clip


def small_w(rng):
    """Corners on both sides of the camera plane and very near to it."""
    clip = rng.normal(size=(36, 4))
    clip[:, 3] *= 10.0 ** rng.uniform(-14, 0, 36)
    return clip


def in_near_plane(rng):
    """z = w but for the last bit."""
    clip = rng.uniform([-2, -2, 0, 0.3], [2, 2, 0, 2], (36, 4))
    clip[:, 2] = -clip[:, 3] * (1 + rng.integers(-1, 2, 36) * 2.0 ** -52)
    return clip


def broken(rng):
    """Numbers that are not finite, or become so on screen."""
    clip = rng.uniform([-2, -2, -1, -1], [2, 2, 1, 2], (36, 4))
    clip[rng.integers(0, 36, 9), rng.integers(0, 4, 9)] = rng.choice([np.nan, np.inf, 1e308], 9)
    return clip


HOSTILE = {"tips": lambda rng: tips(rng, [1, 1, 1]), "tips, w": lambda rng: tips(rng, [.5, 1, 1.5]),
           **{make.__name__: make for make in (slivers, in_camera_plane, small_w, in_near_plane,
                                               broken)}}


@pytest.mark.parametrize("make", HOSTILE.values(), ids=HOSTILE)
def test_hostile_faces_agree_with_the_loop_to_the_bit(make):
    """The loop and the rows bound a face differently, or take another w, end or corner for it."""
    faces = np.arange(36).reshape(12, 3)
    seen = 0
    for seed in range(60):
        clip = make(np.random.default_rng(seed))
        with np.errstate(all="ignore"):
            loop = half_plane_loop(clip, faces, 8, 8)
        assert bits(scanline.rasterize(clip, faces, 8, 8)) == bits(loop), f"seed {seed}"
        seen += (loop[0] >= 0).sum()
    assert seen > 100


@pytest.mark.parametrize("unit", [1e-13, 1.0, 1e5])
@pytest.mark.parametrize("near", [-1e-17, 0.0, 1e-17, 1e-12, 1e-9, 1e-5, 1.0])
def test_the_order_of_corners_changes_nothing(near, unit):
    """A floor that begins below the camera: measured from the wrong corner, it vanishes."""
    floor = np.array([[-4.9, -1, -near], [4.9, -1, -near], [4.9, -1, -10], [-4.9, -1, -10]])
    clip = unit * pipeline.to_clip(floor, transforms.perspective(np.pi / 2, 1.0, 0.01, 100.0))
    px, py = (np.stack(np.meshgrid(np.arange(64), np.arange(64))) + 0.5) / 32 - 1
    w = -1 / py
    expected = (w > near) & (w < 10) & (np.abs(px * w) < 4.9)
    for turn in range(3):
        faces = np.roll([[0, 1, 2], [0, 2, 3]], turn, axis=1)
        face_index, depth = scanline.rasterize(clip, faces, 64, 64)
        np.testing.assert_array_equal(face_index >= 0, expected)
        barycentric = interpolation.barycentrics(face_index, clip, faces)
        corners = clip[faces[face_index[expected]]]
        at = (barycentric[expected][..., None] * corners).sum(1)
        # the point on the face projects back to its pixel and its depth
        np.testing.assert_allclose(at[:, 0] / at[:, 3], px[expected], rtol=0, atol=1e-9)
        np.testing.assert_allclose(at[:, 1] / at[:, 3], py[expected], rtol=0, atol=1e-9)
        np.testing.assert_allclose(at[:, 2] / at[:, 3], depth[expected], rtol=0, atol=1e-9)


def test_single_precision_is_taken_for_what_it_is():
    """Vertices in 32 bits are computed with in 32 bits."""
    clip, faces = golden("cube_64x64")[:2]
    assert bits(scanline.rasterize(clip.astype(np.float32), faces, 64, 64)) \
        == bits(scanline.rasterize(clip.astype(float), faces, 64, 64))


def test_chunks_change_nothing(monkeypatch):
    """A face or a row is lost or seen twice where one chunk ends and the next begins."""
    vertices, faces = mesh.torus(2000)
    clip = pipeline.to_clip(vertices - [0, 0, 3], transforms.perspective(1.0, 1.0, 1.0, 9.0))
    whole = scanline.rasterize(clip, faces, 90, 70)
    for size in (1, 100, 4000):
        monkeypatch.setattr(arrays, "CHUNK", size)
        monkeypatch.setattr(arrays, "ROWS", size)
        assert bits(scanline.rasterize(clip, faces, 90, 70)) == bits(whole)


@pytest.mark.parametrize("faces", [[[0, 1, -1]], [[0, 1, 3]], [[0.0, 1.0, 2.0]], [[0, 1]]], ids=str)
def test_faces_that_name_no_vertex_are_refused(faces):
    """-1 is drawn with the last vertex, 3 of 3 raises NumPy's own error."""
    with pytest.raises(ValueError, match="faces"):
        scanline.rasterize(np.eye(3, 4), np.array(faces), 4, 4)


@pytest.mark.parametrize("kind", [np.uint8, np.uint64, np.int8])
def test_vertices_may_be_integers(kind):
    """-w wraps around where it is unsigned, and every face lies beyond the picture."""
    clip, faces = np.array([[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1]]), np.array([[0, 1, 2]])
    expected = scanline.rasterize(clip.astype(float), faces, 8, 8)
    assert (expected[0] == 0).sum() == 6
    assert bits(scanline.rasterize(clip.astype(kind), faces, 8, 8)) == bits(expected)


def test_memory_does_not_grow_with_overdraw():
    """All fragments are held at once: 100 faces, each as large as the picture, are 6.5 million."""
    triangle = np.array([[-1.0, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]])
    clip = np.concatenate([triangle + [0, 0, depth, 0] for depth in np.linspace(-0.9, 0.9, 100)])
    tracemalloc.start()
    face_index, _ = scanline.rasterize(clip, np.arange(300).reshape(-1, 3), 256, 256)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert (face_index == 0).all()
    assert peak < 20e6


# --- what lab 2 asks of its own rasterizer -----------------------------------------------------

@pytest.mark.parametrize("rasterize", [half_plane_loop, scanline.rasterize])
def test_the_near_and_the_far_plane_are_part_of_the_picture(rasterize):
    """< for <= where the depth is compared with -1 and 1, or a depth that rounding moves beyond."""
    near = np.array([[-1.3, -1.7, -1.0, 1.0], [3.9, -1.2, -1.0, 1.0], [-1.1, 4.7, -1.0, 1.0]])
    for sign in 1, -1:
        face_index, depth = rasterize(near * [1, 1, sign, 1], np.array([[0, 1, 2]]), 13, 11)
        assert (face_index == 0).all()
        assert (depth == -sign).all()


CLAIMS = [check for check in vars(lab_2).values()
          if any(mark.args == ("2.6",) for mark in getattr(check, "pytestmark", ()))]
assert len(CLAIMS) >= 8


@pytest.mark.parametrize("rasterize", [half_plane_loop, scanline.rasterize])
@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.__name__)
def test_what_lab_2_claims_of_rasterize_holds(claim, rasterize, rng):
    """What the claim's own docstring names, in a rasterizer that lab 2 does not ask for."""
    given = {"impl": types.SimpleNamespace(rasterize=rasterize), "rng": rng}
    claim(**{name: given[name] for name in inspect.signature(claim).parameters})
