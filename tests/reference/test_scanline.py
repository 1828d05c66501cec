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
from reference import rasterization, scanline, transforms
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
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    np.testing.assert_allclose(barycentric[..., :2], uv, rtol=0, atol=1e-4)
    got = rasterization.barycentrics_derivatives(face_index, clip, faces)[:, :, :2]
    np.testing.assert_allclose(got, derivatives, rtol=0, atol=3e-5 * np.abs(derivatives).max())


def bits(pictures):
    return [picture.tobytes() for picture in pictures]


@pytest.mark.parametrize("seed", range(6))
def test_whole_meshes_and_the_loop_agree_to_the_bit(seed):
    """A pixel at an edge, a tie in depth or a face at the camera plane goes to another face."""
    rng = np.random.default_rng(seed)
    clip = rng.uniform([-2, -2, -1.5, -1], [2, 2, 1.5, 2], (60, 4))
    faces = rng.integers(0, 60, (80, 3))
    if seed % 2:  # vertices on pixel centres and corners, faces upon each other
        clip = np.round(clip * 8) / 8
        clip[:, 3] = 1 if seed < 4 else clip[:, 3]
        faces[40:] = faces[:40, ::-1]
    with np.errstate(all="ignore"):
        loop = half_plane_loop(clip, faces, 16, 24)
    assert (loop[0] >= 0).sum() > 100
    assert bits(scanline.rasterize(clip, faces, 16, 24)) == bits(loop)


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
    """One corner of each face with w = 0, others behind and in front."""
    clip = rng.normal(size=(36, 4))
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
    clip = unit * transforms.transform(transforms.to_homogeneous(floor),
                                       transforms.perspective(np.pi / 2, 1.0, 0.01, 100.0))
    px, py = (np.stack(np.meshgrid(np.arange(64), np.arange(64))) + 0.5) / 32 - 1
    w = -1 / py
    expected = (w > near) & (w < 10) & (np.abs(px * w) < 4.9)
    for turn in range(3):
        faces = np.roll([[0, 1, 2], [0, 2, 3]], turn, axis=1)
        face_index, depth = scanline.rasterize(clip, faces, 64, 64)
        np.testing.assert_array_equal(face_index >= 0, expected)
        barycentric = rasterization.barycentrics(face_index, clip, faces)
        corners = clip[faces[face_index[expected]]]
        at = (barycentric[expected][..., None] * corners).sum(1)
        # the point on the face projects back to its pixel and its depth
        np.testing.assert_allclose(at[:, 0] / at[:, 3], px[expected], rtol=0, atol=1e-9)
        np.testing.assert_allclose(at[:, 1] / at[:, 3], py[expected], rtol=0, atol=1e-9)
        np.testing.assert_allclose(at[:, 2] / at[:, 3], depth[expected], rtol=0, atol=1e-9)


def test_a_corner_beside_the_camera_loses_no_face():
    """Corners whose w is all rounding, as where a floor begins beside a camera that is turned."""
    rng = np.random.default_rng(0)
    for _ in range(50):
        eye, look = rng.normal(size=(2, 3))
        view = transforms.look_at(eye, eye + look, np.array([0.0, 1.0, 0.0]))
        world_from_view = np.linalg.inv(view)
        floor = np.array([[-4.9, -1, 0], [4.9, -1, 0], [4.9, -1, -10], [-4.9, -1, -10]])
        corners = transforms.transform(transforms.to_homogeneous(floor), world_from_view)
        clip = transforms.transform(corners, transforms.perspective(np.pi / 2, 1, 0.01, 100) @ view)
        face_index, _ = scanline.rasterize(clip, np.array([[0, 1, 2], [0, 2, 3]]), 32, 32)
        px, py = (np.stack(np.meshgrid(np.arange(32), np.arange(32))) + 0.5) / 16 - 1
        w = -1 / py
        np.testing.assert_array_equal(face_index >= 0, (w > 0) & (w < 10) & (np.abs(px * w) < 4.9))


def test_a_face_ten_million_pixels_wide_is_seen_at_any_size():
    """A legitimate face counts as beyond floating point."""
    clip = np.array([[-5e6, -5e6, 0, 1], [5e6, -5e6, 0, 1], [0, 1e7, 0, 1.0]])
    for size in (8, 512):
        assert (scanline.rasterize(clip, np.array([[0, 1, 2]]), size, size)[0] == 0).all()


def test_a_vertical_edge_of_equal_w_is_watertight():
    """Each face at the edge measures it from its own end: the far one has lost its digits."""
    clip = np.array([[0, -0.9, 0, 1], [0, 1e9, 0, 1], [-1, -0.9, 0, 1], [1, -0.9, 0, 1]])
    counts = coverage(clip, np.array([[0, 1, 2], [1, 0, 3]]), 16, 16)
    np.testing.assert_array_equal(counts, np.where(np.arange(16)[:, None] > 0, 1, 0) + 0 * counts)


def test_single_precision_is_taken_for_what_it_is():
    """Vertices in 32 bits are computed with in 32 bits."""
    clip, faces = golden("cube_64x64")[:2]
    assert bits(scanline.rasterize(clip.astype(np.float32), faces, 64, 64)) \
        == bits(scanline.rasterize(clip.astype(float), faces, 64, 64))


def test_chunks_change_nothing(monkeypatch):
    """A face or a row is lost or seen twice where one chunk ends and the next begins."""
    vertices, faces = mesh.torus(2000)
    view = transforms.translate(np.array([0.0, 0.0, -3.0]))
    projection = transforms.perspective(1.0, 1.0, 1.0, 9.0)
    clip = transforms.transform(transforms.to_homogeneous(vertices), projection @ view)
    whole = scanline.rasterize(clip, faces, 90, 70)
    for size in (1, 100, 4000):
        monkeypatch.setattr(arrays, "CHUNK", size)
        monkeypatch.setattr(arrays, "ROWS", size)
        assert bits(scanline.rasterize(clip, faces, 90, 70)) == bits(whole)


def coverage(clip, faces, width, height):
    """How many faces cover each sample."""
    counts = np.zeros(width * height, int)
    for pixel, _, _ in scanline.fragments(clip, faces, width, height):
        np.add.at(counts, pixel, 1)
    return counts.reshape(height, width)


def test_ten_thousand_shared_edges_are_watertight():
    """A hole or a double hit along an edge: 10,000 quadrangles of two faces, each in its own 8 x 8
    pixels, half of them with corners on pixel centres."""
    rng = np.random.default_rng(1)
    cells = np.stack(np.meshgrid(np.arange(100), np.arange(100)), -1).reshape(-1, 1, 2) * 8.0
    angle = (np.arange(4) + rng.uniform(0.1, 0.9, (10000, 4))) * np.pi / 2
    corners = 4 + 3.9 * np.stack([np.cos(angle), np.sin(angle)], -1)
    corners[::2] = np.floor(corners[::2]) + 0.5
    x, y = np.moveaxis(cells + corners, -1, 0)
    quads = np.arange(40000).reshape(-1, 4)
    counts = coverage(on_screen(x.ravel(), y.ravel(), 1024, 1024),
                      np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]), 1024, 1024)
    assert counts.max() == 1

    # Inside all four sides, to rounding: every sample of the quadrangle must have its face.
    p = np.stack(np.meshgrid(np.arange(800), np.arange(800)), -1) + 0.5
    p = p.reshape(100, 8, 100, 8, 2).swapaxes(1, 2).reshape(10000, 64, 2)
    a = (cells + corners)[:, None]
    side = np.roll(a, -1, 2) - a
    to_p = p[:, :, None] - a
    inside = (side[..., 0] * to_p[..., 1] - side[..., 1] * to_p[..., 0] > 1e-9).all(-1)
    cell_counts = counts[:800, :800].reshape(100, 8, 100, 8).swapaxes(1, 2).reshape(10000, 64)
    assert inside.sum() > 100_000
    assert (cell_counts[inside] == 1).all()


@pytest.mark.parametrize("spokes", [3, 4, 7])
def test_the_hub_of_a_fan_is_covered_once(spokes):
    """A vertex exactly on a pixel's centre falls between its faces, or is drawn by two of them."""
    rng = np.random.default_rng(spokes)
    for _ in range(300):
        angle = (np.arange(spokes) + rng.uniform(0, 0.5, spokes)) * 2 * np.pi / spokes
        x = np.append(8.5, 8.5 + 7 * np.cos(angle))
        y = np.append(8.5, 8.5 + 7 * np.sin(angle))
        k = np.arange(spokes)
        faces = np.stack([0 * k, k + 1, (k + 1) % spokes + 1], -1)
        counts = coverage(on_screen(x, y, 16, 16), faces, 16, 16)
        assert counts[8, 8] == 1 and counts.max() == 1


@pytest.mark.parametrize("vertex", [
    [np.nan, 0, 0, 1], [0, np.inf, 0, 1], [0, 0, 0, np.nan], [1e200, 1e200, 0, 1], [0, 0, 0, 0],
    [1e-320, 0, 0, 1e-320], [1e30, -1e30, 0, 1], [5, 5, 0, -1e-300], [-1, -1, 0.1, 1]], ids=str)
def test_a_hostile_vertex_spoils_no_other_face(vertex):
    """A crash, or a smear over the picture."""
    good = np.array([[-1.0, -1, 0.5, 1], [1, -1, 0.5, 1], [-1, 1, 0.5, 1]])
    clip = np.concatenate([good, good - [0, 0, 0.4, 0]])
    clip[5] = vertex
    clip[4] = [-0.99, -1, 0.1, 1]  # a sliver, so that little of the good face is hidden
    alone = scanline.rasterize(good, np.array([[0, 1, 2]]), 32, 32)
    face_index, depth = scanline.rasterize(clip, np.array([[0, 1, 2], [3, 4, 5]]), 32, 32)
    other = face_index != 1
    np.testing.assert_array_equal(face_index[other], alone[0][other])
    np.testing.assert_array_equal(depth[other], alone[1][other])
    if not np.isfinite(vertex).all() or (clip[5] == clip[3]).all():
        assert other.all()


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


# --- what lab 2 asks of its own loop -----------------------------------------------------------

CLAIMS = [check for check in vars(lab_2).values()
          if any(mark.args == ("2.13",) for mark in getattr(check, "pytestmark", ()))]
assert len(CLAIMS) >= 12


@pytest.mark.parametrize("rasterize", [half_plane_loop, scanline.rasterize])
@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.__name__)
def test_what_lab_2_claims_of_rasterize_loop_holds(claim, rasterize, rng):
    """What the claim's own docstring names, in a rasterizer that lab 2 does not ask for."""
    given = {"impl": types.SimpleNamespace(rasterize_loop=rasterize), "rng": rng}
    claim(**{name: given[name] for name in inspect.signature(claim).parameters})


@pytest.mark.parametrize("z", [-1.0, 1.0])
def test_a_face_in_the_near_or_far_plane_is_seen(z):
    """< for <=, or a depth that rounding has moved beyond the plane."""
    clip = np.array([[-1.0, -1.0, z, 1.0], [1.1, -1.3, z, 1.0], [-1.2, 1.7, z, 1.0]])
    clip *= np.array([[1.0], [3.0], [0.7]])
    assert scanline.rasterize(clip, np.array([[0, 1, 2]]), 4, 4)[0][0, 0] == 0
    clip[:, 2] *= 1.0 + 1e-9
    assert (scanline.rasterize(clip, np.array([[0, 1, 2]]), 4, 4)[0] == -1).all()


@pytest.mark.parametrize(("width", "height"), [(3, 9), (9, 3)])
def test_a_face_from_behind_the_camera_reaches_all_ends(width, height):
    """Width and height are swapped on the way to the bounding box."""
    clip = np.array([[-9.0, -9.0, -0.9, 1.0], [9.0, -9.0, 0.9, 1.0], [0.0, 30.0, 0.0, -1.0]])
    face_index, depth = scanline.rasterize(clip, np.array([[0, 1, 2]]), width, height)
    np.testing.assert_array_equal(face_index, np.zeros((height, width)))
    expected = 0.1 * ((np.arange(width) + 0.5) * 2 / width - 1)  # a tenth of ndc x
    np.testing.assert_allclose(depth, np.tile(expected, (height, 1)), atol=1e-9)
