"""The reference's whole pictures of lab 8: antialias and its gradient."""
import numpy as np
import pytest
from screen_scenes import on_screen, soup

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import antialiasing, outlines, sampling, scanline, transforms

GOLDEN = np.load("tests/golden/antialias.npz")
SCENES = sorted({key.split("/")[0] for key in GOLDEN})
EDGES = (1, 2), (2, 0), (0, 1)


def golden(scene, *keys):
    arrays = [GOLDEN[f"{scene}/{key}"] for key in keys]
    return [a.astype(float if a.dtype.kind == "f" else int) for a in arrays]


def golden_inputs(scene):
    *pictures, clip, faces = golden(scene, "colour", "face_index", "depth", "clip", "faces")
    return *pictures, clip, faces, antialiasing.opposite_vertices(faces)


@pytest.mark.parametrize("scene", SCENES)
def test_pairs_and_pictures_are_those_of_nvdiffrast(scene):
    """Another edge, weight or colour than nvdiffrast's kernels give (tests/golden/README.md)."""
    inputs = golden_inputs(scene)
    expected, expected_alpha, output = golden(scene, "pairs", "alpha", "output")
    owner, other, c, ends, *_ = outlines.blended_pairs(*inputs[1:])
    corners = inputs[4][inputs[1].ravel()[owner]]
    edge = (~(corners[:, :, None] == ends.T[:, None]).any(2)).argmax(1)
    got = np.stack([owner, other, edge], 1)
    order, expected_order = (np.lexsort(pairs.T) for pairs in (got, expected))
    np.testing.assert_array_equal(got[order], expected[expected_order])
    alpha = antialiasing.blend_weight(c)
    np.testing.assert_allclose(alpha[order], expected_alpha[expected_order], rtol=0, atol=1e-5)
    np.testing.assert_allclose(outlines.antialias(*inputs), output, rtol=0, atol=1e-5)


@pytest.mark.parametrize("scene", SCENES)
def test_gradients_are_those_of_nvdiffrast(scene):
    """A gradient to another pixel or vertex, or with another epsilon."""
    grad_output, grad_colour, grad_clip = golden(scene, "grad_output", "grad_colour", "grad_clip")
    got = outlines.antialias_backward(grad_output, *golden_inputs(scene), epsilon=1e-3)
    np.testing.assert_allclose(got[0], grad_colour, rtol=0, atol=1.5e-5)
    np.testing.assert_allclose(got[1], grad_clip, rtol=0, atol=1e-9 * np.abs(grad_clip).max())


# --- scenes ------------------------------------------------------------------------------------

def turned(vertices, angle, distance=3.0, fov_y=0.9, aspect=1.0):
    view = transforms.translate(np.array([0.0, 0.0, -distance]))
    view = view @ transforms.rotate(np.array([0.4, 1.0, 0.2]), angle)
    clip_from_world = transforms.perspective(fov_y, aspect, 0.1, 20.0) @ view
    return transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)


def drawn(clip, faces, width, height, rng):
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    return rng.normal(size=(height, width, 2)), face_index, depth


def antialias_by_hand(colour, face_index, depth, clip, faces):
    """Eqs. (1) to (5) pair by pair, and the number of pairs that are blended."""
    height, width = face_index.shape
    x, y = ((clip[:, axis] / clip[:, 3] + 1) / 2 * size for axis, size in ((0, width), (1, height)))
    output, count = colour.copy(), 0
    for dy, dx in (0, 1), (1, 0):
        for row, column in np.ndindex(height - dy, width - dx):
            owner, other = (row, column), (row + dy, column + dx)
            if face_index[owner] == face_index[other]:
                continue
            if not depth[owner] < depth[other]:
                owner, other = other, owner
            face = faces[face_index[owner]]
            edge, c = last_crossing(clip[face], width, height, owner, other)
            if edge is None or not is_silhouette(clip[:, [0, 1, 3]], faces, face, edge):
                continue
            run, rise = (abs(a[face[EDGES[edge][1]]] - a[face[EDGES[edge][0]]]) for a in (x, y))
            if (run > rise if dx else rise > run) or not -1 / 16 < c < 17 / 16:
                continue
            alpha = 0.5 - min(max(c, 0), 1)
            target = owner if alpha > 0 else other
            output[target] += alpha * (colour[other] - colour[owner])
            count += 1
    return output, count


def last_crossing(corners, width, height, owner, other):
    """Where the line through two pixels leaves a face: edge and distance from owner to other."""
    axis = 0 if owner[1] == other[1] else 1  # row or column: that along the line
    side = other[axis] - owner[axis]
    best = None, -np.inf
    for k, (i, j) in enumerate(EDGES):
        ends = in_front(corners[i], corners[j])
        if ends is None:
            continue
        x, y = ((ends[:, a] / ends[:, 3] + 1) / 2 * size for a, size in ((0, width), (1, height)))
        along, across = (y, x) if axis == 0 else (x, y)
        along = side * (along - owner[axis] - 0.5)
        across = across - owner[1 - axis] - 0.5
        if (across[0] < 0) != (across[1] < 0):
            t = across[0] / (across[0] - across[1])
            best = max(best, (k, (1 - t) * along[0] + t * along[1]), key=lambda found: found[1])
    return best


def in_front(p, q, least=1e-4):
    """The part of the segment from p to q (4,) with w >= least: its ends (2, 4), or None."""
    if max(p[3], q[3]) < least:
        return None
    ends = [a if a[3] >= least else a + (b - a) * (least - a[3]) / (b[3] - a[3])
            for a, b in ((p, q), (q, p))]
    return np.array(ends)


def is_silhouette(points, faces, face, k):
    """Of a mesh in which no three faces with different third vertices meet at an edge. The points
    (V, 3) are x, y, w of clip space, where the sign of a determinant tells the side, whatever w.
    """
    a, b = (face[i] for i in EDGES[k])

    def side(p):
        return np.linalg.det(points[[a, b, p]]) < 0

    across = {p for other in faces if len(set(other)) == 3 and {a, b} <= set(other)
              for p in other if p not in face}
    assert len(across) <= 1
    return all(side(p) == side(face[k]) for p in across)


# --- pictures ----------------------------------------------------------------------------------

def manifold(faces):
    """Faces without those that would be the third one at an edge."""
    kept, count = [], {}
    for face in faces:
        pairs = [tuple(sorted((face[i], face[j]))) for i, j in EDGES]
        if len(set(face)) == 3 and all(count.get(pair, 0) < 2 for pair in pairs):
            kept.append(face)
            for pair in pairs:
                count[pair] = count.get(pair, 0) + 1
    return np.array(kept)


def require_one_pair_after_the_other(clip, faces, width, height, rng, atol=1e-9):
    """A picture is that of `antialias_by_hand` -> how many pairs are blended."""
    colour, face_index, depth = drawn(clip, faces, width, height, rng)
    expected, count = antialias_by_hand(colour, face_index, depth, clip, faces)
    opposite = antialiasing.opposite_vertices(faces)
    got = outlines.antialias(colour, face_index, depth, clip, faces, opposite)
    np.testing.assert_allclose(got, expected, rtol=0, atol=atol)
    return count


@pytest.mark.parametrize("seed", range(8))
def test_pictures_are_those_of_one_pair_after_the_other(seed):
    """A pair is lost between the stages, or a face at the camera plane gets a wrong edge."""
    rng = np.random.default_rng(seed)
    clip, faces = soup(rng, behind=seed % 2 == 1)
    assert require_one_pair_after_the_other(clip, manifold(faces), 30, 22, rng) > 15


@pytest.mark.parametrize("vertices, faces", [mesh.cube(12), mesh.torus(150)],
                         ids=["cube", "torus"])
def test_meshes_are_those_of_one_pair_after_the_other(vertices, faces):
    """Edges inside a closed surface, and folds where it hides itself."""
    clip = turned(vertices, 0.8, 4.5)
    rng = np.random.default_rng(3)
    assert require_one_pair_after_the_other(clip, faces, 40, 31, rng) > 30


@pytest.mark.parametrize("width, height", [(1, 9), (9, 1), (1, 1)])
def test_pictures_of_one_row_or_column(width, height):
    """A neighbour in the row is taken for one in the column."""
    rng = np.random.default_rng(1)
    along, across = np.array([-50.0, 5.3, 5.7]), np.array([0.0, -30.0, 30.0])
    clip = on_screen(*((along, across) if width > height else (across, along)), width, height)
    faces = np.array([[0, 1, 2]])
    count = require_one_pair_after_the_other(clip, faces, width, height, rng, atol=1e-12)
    assert count == (width * height > 1)


def test_pictures_without_faces_or_with_hostile_vertices():
    """A crash or NaN where nothing is seen, or from vertices that no seen face has."""
    empty = np.full((4, 5), -1), np.full((4, 5), np.inf), np.zeros((0, 4)), np.zeros((0, 3), int)
    colour, no_faces = np.ones((4, 5, 3)), np.zeros((0, 3), int)
    np.testing.assert_array_equal(outlines.antialias(colour, *empty, no_faces), colour)
    grad_colour, grad_clip = outlines.antialias_backward(colour, colour, *empty, no_faces)
    np.testing.assert_array_equal(grad_colour, colour)
    assert grad_clip.shape == (0, 4)

    rng, faces = np.random.default_rng(0), np.array([[0, 1, 2], [3, 4, 5], [1, 2, 6]])
    clip = np.concatenate([on_screen([1.1, 8.3, 2.2], [1.3, 2.4, 7.1], 9, 8),
                           [[np.nan, 0, 0, 1], [0, np.inf, 0, 1], [0, 0, 0, 0], [0, 0, np.nan, 1]]])
    colour, face_index, depth = drawn(clip, faces, 9, 8, rng)
    arguments = face_index, depth, clip, faces, antialiasing.opposite_vertices(faces)
    with np.errstate(all="raise"):
        grad_colour, grad_clip = outlines.antialias_backward(colour, colour, *arguments)
    assert np.isfinite(grad_colour).all() and np.isfinite(grad_clip).all()
    assert grad_clip[:3, [0, 1, 3]].all() and not grad_clip[3:].any()


@pytest.mark.parametrize("kind", [np.uint8, np.int8, np.uint32, np.uint64])
def test_faces_may_be_integers_of_any_kind(kind):
    """-1 is written into faces that know none, or uint64 beside int64 becomes float64."""
    rng = np.random.default_rng(2)
    clip, faces = soup(rng)
    opposite = antialiasing.opposite_vertices(faces)
    colour, face_index, depth = drawn(clip, faces, 30, 22, rng)
    expected = outlines.antialias_backward(colour, colour, face_index, depth, clip, faces, opposite)
    faces = faces.astype(kind)
    np.testing.assert_array_equal(antialiasing.opposite_vertices(faces), opposite)
    got = outlines.antialias_backward(colour, colour, face_index, depth, clip, faces, opposite)
    for one, same in zip(got, expected, strict=True):
        np.testing.assert_array_equal(one, same)


def test_a_floor_is_blended_however_it_is_cut_into_faces():
    """A face that reaches behind the camera owns no edge, or a mirrored one."""
    view = transforms.look_at(np.array([0.1, 0.4, 0.35]), np.array([0.1, 0.0, -0.6]),
                              np.array([0.0, 1.0, 0.0]))
    clip_from_world = transforms.perspective(1.0, 4 / 3, 0.05, 9.0) @ view
    pictures = []
    for n in 1, 2, 5:
        steps = np.linspace(-1, 1, n + 1)
        x, z = (values.ravel() for values in np.meshgrid(steps, -steps))
        k = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
        faces = np.concatenate([np.stack([k, k + 1, k + n + 2], 1),
                                np.stack([k, k + n + 2, k + n + 1], 1)])
        points = np.stack([x, 0 * x, z, np.ones(len(x))], 1)
        clip = transforms.transform(points, clip_from_world)
        face_index, depth = scanline.rasterize(clip, faces, 40, 30)
        colour = (face_index >= 0)[..., None].astype(float)
        opposite = antialiasing.opposite_vertices(faces)
        pictures.append(outlines.antialias(colour, face_index, depth, clip, faces, opposite))
    assert (clip[:, 3] < 0).any() and np.count_nonzero(pictures[0] % 1) > 30
    for picture in pictures[1:]:  # but for a few pairs whose last edge is one of the cuts
        differs = np.abs(picture - pictures[0]) > 1e-9
        assert np.count_nonzero(differs) <= np.count_nonzero(pictures[0] % 1) / 4


def test_a_seen_vertex_in_the_camera_plane_has_a_gradient():
    """The backward pass divides by another w than the forward pass: infinity and NaN."""
    clip = np.array([[-0.3, -0.8, 0, 1], [0.2, -0.7, 0, 1], [0.4, 0.9, 0, 0]])
    faces = np.arange(3)[None]

    def gradient(w):
        clip[2, 3] = w
        face_index, depth = scanline.rasterize(clip, faces, 16, 12)
        colour = (face_index >= 0)[..., None].astype(float)
        grad_output = np.arange(192.0).reshape(12, 16, 1) % 7
        arguments = face_index, depth, clip, faces, np.full((1, 3), -1)
        return outlines.antialias_backward(grad_output, colour, *arguments)[1]

    np.testing.assert_allclose(gradient(0.0)[:2], gradient(1e-7)[:2], rtol=1e-4)
    assert np.isfinite(gradient(0.0)).all() and gradient(0.0)[2].any()


# --- gradients ---------------------------------------------------------------------------------

def decisions(face_index, depth, clip, faces, opposite):
    """What a picture decides: its faces, pairs, edges, which pixel changes, what is saturated."""
    owner, other, c, ends, *_ = outlines.blended_pairs(face_index, depth, clip, faces, opposite)
    return face_index, owner, other, ends, c > 0.5, (c > 0) & (c < 1)


@pytest.mark.parametrize("seed", range(3))
def test_whole_pictures_have_the_gradients_of_central_differences(seed):
    """One of the stages is left out on the way back, or w gets no gradient."""
    rng = np.random.default_rng(seed)
    clip, faces = soup(rng)
    opposite, shades = antialiasing.opposite_vertices(faces), rng.normal(size=(31, 2))

    def forward(clip):
        face_index, depth = scanline.rasterize(clip, faces, 26, 19)
        return outlines.antialias(shades[face_index], face_index, depth, clip, faces, opposite)

    def backward(grad_output, clip):
        face_index, depth = scanline.rasterize(clip, faces, 26, 19)
        arguments = face_index, depth, clip, faces, opposite
        return outlines.antialias_backward(grad_output, shades[face_index], *arguments)[1]

    def decide(clip):
        return decisions(*scanline.rasterize(clip, faces, 26, 19), clip, faces, opposite)

    report = gradcheck(forward, backward, (clip,), decisions=decide, name="antialias by clip")
    assert report.checked > 50


def test_colours_have_the_gradients_of_central_differences():
    """The gradient of a pixel that is blended away is lost."""
    rng = np.random.default_rng(5)
    clip, faces = soup(rng)
    colour, face_index, depth = drawn(clip, faces, 26, 19, rng)
    rest = face_index, depth, clip, faces, antialiasing.opposite_vertices(faces)
    gradcheck(lambda colour: outlines.antialias(colour, *rest),
              lambda grad, colour: outlines.antialias_backward(grad, colour, *rest)[0],
              (colour,), name="antialias by colour")


# --- the truth ---------------------------------------------------------------------------------

def one_triangle(triangle, width, height):
    """-> its antialiased coverage (height, width), and backward(grad) -> grad_triangle (3, 2)."""
    clip, faces = on_screen(*triangle.T, width, height), np.array([[0, 1, 2]])
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    colour = (face_index >= 0)[..., None].astype(float)
    arguments = face_index, depth, clip, faces, np.full((1, 3), -1)

    def backward(grad):
        grad_clip = outlines.antialias_backward(grad[..., None], colour, *arguments)[1]
        return grad_clip[:, :2] * 2 / [width, height]

    return outlines.antialias(colour, *arguments)[..., 0], backward


def test_coverage_is_exact_along_rows_and_columns():
    """The blend is off where it can be exact: edges along the pixels' sides, corners left out."""
    triangle = np.array([[2.3, -90.0], [2.3, 90.0], [-90.0, 0.0]])  # in the picture: x < 2.3
    for position in np.linspace(1.6, 3.4, 10):
        triangle[:2, 0] = position
        for sides in triangle, triangle[:, ::-1].copy():
            got, _ = one_triangle(sides, 6, 5)
            np.testing.assert_allclose(got, sampling.pixel_coverage(sides, 6, 5), rtol=0, atol=1e-9)


def test_coverage_and_its_gradient_are_near_the_exact_ones():
    """A bias, of colours or of gradients, that central differences of the blend cannot see."""
    rng = np.random.default_rng(4)
    errors, angles, lengths = [], [], []
    y, x = np.indices((60, 70)) / 10
    smooth = np.sin(x) + np.cos(1.3 * y)  # an upstream gradient without noise
    for _ in range(20):
        angle = np.sort(rng.uniform(0, 2 * np.pi) + np.arange(3) * 2.1)
        triangle = [35, 30] + 25 * np.stack([np.cos(angle), np.sin(angle)], 1)
        got, backward = one_triangle(triangle, 70, 60)
        errors.append(np.abs(got - sampling.pixel_coverage(triangle, 70, 60)).max())
        gradient, exact = backward(smooth), sampling.pixel_coverage_backward(smooth, triangle)
        angles.append(np.vdot(gradient, exact) / np.linalg.norm(gradient) / np.linalg.norm(exact))
        lengths.append(np.linalg.norm(gradient) / np.linalg.norm(exact))
    assert max(errors) < 0.5  # at corners
    assert min(angles) > 0.999
    assert 0.95 < min(lengths) and max(lengths) < 1.02
