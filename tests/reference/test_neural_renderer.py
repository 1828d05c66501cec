"""The reference's whole pictures of lab 10: passes, cubes, light, the sweep and SoftRas."""
import numpy as np
import pytest

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import interpolation, neural_renderer, rasterization, scanline, transforms

WIDTH, HEIGHT = 23, 17
BACKGROUND = np.array([0.1, 0.2])


def some_corners(rng, count=12):
    """Faces of either winding, some behind the camera, some cut by the picture's border."""
    corners = rng.uniform(-1.3, 1.3, (count, 3, 3))
    corners[..., 2] = rng.uniform(1, 3, (count, 3))
    corners[::5, 1, 2] *= -1
    return corners


def camera(eye=(0.6, 1.2, 2.2)):
    view = transforms.look_at(np.array(eye), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    return transforms.perspective(0.8, 1.0, 0.1, 10.0) @ view


def teapot_clip():
    vertices, faces = mesh.teapot()
    points = transforms.to_homogeneous(mesh.normalize(vertices))
    return transforms.transform(points, camera()), faces


# --- passes 1 and 2 ----------------------------------------------------------------------------

def test_the_loop_and_whole_meshes_agree_to_the_bit(rng):
    """A fragment that one of the two finds, or other rounding; ties of equal depth."""
    for _ in range(3):
        corners = some_corners(rng)
        corners[7] = corners[6]
        loop = neural_renderer.rasterize_loop(corners, WIDTH, HEIGHT)
        maps = neural_renderer.rasterize(corners, WIDTH, HEIGHT)
        for got, expected in zip(maps, loop, strict=True):
            np.testing.assert_array_equal(got, expected)


def test_they_agree_on_a_mesh_and_on_grids_of_centres():
    """Centres exactly on shared edges and vertices."""
    teapot = neural_renderer.corners_of(*teapot_clip())
    points, faces = mesh.grid(32)
    flat = np.concatenate([(points[:, :2] + 0.5) / 4 - 1, np.ones((len(points), 1))], 1)[faces]
    for corners in (teapot, flat):
        loop = neural_renderer.rasterize_loop(corners, 24, 8)
        for got, expected in zip(neural_renderer.rasterize(corners, 24, 8), loop, strict=True):
            np.testing.assert_array_equal(got, expected)


def test_the_picture_is_that_of_lab_2():
    """Half a pixel off, rows upside down, or z of clip space for the distance."""
    clip, faces = teapot_clip()
    face_index, weight, depth = neural_renderer.rasterize(
        neural_renderer.corners_of(clip, faces), 64, 48)
    x, y, w = rasterization.screen_points(clip, 64, 48)
    front = rasterization.cull_back_faces(x, y, w, faces)
    expected, _ = scanline.rasterize(clip, front, 64, 48)
    seen = expected >= 0
    np.testing.assert_array_equal(face_index >= 0, seen)
    same = (faces[face_index[seen]] == front[expected[seen]]).all(1)
    assert same.mean() > 0.999  # two faces at equal depth
    b = rasterization.barycentrics(expected, clip, front)[seen][same]
    w_there = (b * clip[front[expected[seen][same]], 3]).sum(1)
    np.testing.assert_allclose(depth[seen][same], w_there, rtol=1e-9)
    right = weight[seen][same] * depth[seen][same][:, None]
    np.testing.assert_allclose(right / clip[front[expected[seen][same]], 3], b, atol=1e-9)


def test_its_inverse_is_the_edge_functions_over_twice_the_area(rng):
    """The identity that ties labs 2, 7 and 10 together."""
    triangle, p = np.array([[1.0, 2.0], [7.0, 1.0], [3.0, 6.0]]), rng.uniform(0, 7, (9, 2))
    c = np.column_stack([p, np.ones(9)]) @ neural_renderer.face_inverse(triangle).T
    e = np.stack([rasterization.edge_function(p, triangle[i], triangle[j])
                  for i, j in neural_renderer.EDGES], 1)
    np.testing.assert_allclose(c, e / (2 * rasterization.signed_area(triangle)), atol=1e-12)


def fixed_faces(corners, *_):
    return neural_renderer.rasterize(corners, WIDTH, HEIGHT)[0]


def test_gradients_of_weights_and_depth_are_central_differences(rng):
    """A factor between ndc and pixels, width for height, or a face's pixels not summed up."""
    corners = some_corners(rng)

    def maps(corners):
        face_index, weight, depth = neural_renderer.rasterize(corners, WIDTH, HEIGHT)
        return weight, np.where(face_index >= 0, depth, 0)

    gradcheck(maps, lambda grad_weight, grad_depth, corners: (neural_renderer.rasterize_backward(
        grad_weight, grad_depth, fixed_faces(corners), corners),),
        (corners,), decisions=fixed_faces, name="maps")


# --- pass 3: cubes -----------------------------------------------------------------------------

def test_a_linear_picture_comes_back_in_perspective():
    """A cube read without z / z_k bends the picture; texels beside the face hold other values."""
    clip = np.array([[-1.0, -1.0, 0, 1.0], [4.0, -3.5, 0, 5.0], [2.0, 2.4, 0, 2.5],
                     [-1.2, 2.0, 0, 3.0]])
    faces, uv = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0.0, 0.0], [1, 0], [1, 1], [0, 1]])
    corners = neural_renderer.corners_of(clip, faces)
    for size in 2, 3, 5:
        textures = neural_renderer.texel_weights(size).reshape(-1, 3) @ uv[faces]
        textures = textures.reshape(2, size, size, size, 2)
        got, face_index, *_ = neural_renderer.shade_cubes(corners, textures, np.ones((2, 2)),
                                                          32, 24, np.zeros(2))
        barycentric = rasterization.barycentrics(face_index, clip, faces)
        expected = interpolation.interpolate(uv, faces, face_index, barycentric)
        assert (face_index >= 0).sum() > 200
        np.testing.assert_allclose(got, expected, atol=1e-9)


def test_a_photograph_is_baked_where_uv_say(rng):
    """Image axes swapped, or texels at corners that are not those of uv."""
    image, uv = rng.random((8, 16, 3)), np.array([[0.1, 0.2], [0.8, 0.3], [0.4, 0.9]])
    cube = neural_renderer.bake(image, uv, np.array([[0, 1, 2]]), 4)[0]
    assert cube.shape == (4, 4, 4, 3)
    for corner, texel in zip(uv, (cube[3, 0, 0], cube[0, 3, 0], cube[0, 0, 3]), strict=True):
        x, y = corner * [16, 8] - 0.5
        column, row = int(np.floor(x)), int(np.floor(y))
        a, b = x - column, y - row
        expected = ((1 - a) * (1 - b) * image[row, column] + a * (1 - b) * image[row, column + 1]
                    + (1 - a) * b * image[row + 1, column] + a * b * image[row + 1, column + 1])
        np.testing.assert_allclose(texel, expected, atol=1e-12)


def test_from_behind_a_face_looks_mirrored(rng):
    """Reversed corners with the cube's axes left in their order."""
    faces, textures = np.array([[0, 1, 2]]), rng.random((1, 3, 3, 3, 2))
    clip = np.array([[-0.9, -0.8, 0, 1.0], [0.9, -0.6, 0, 2.0], [0.3, 0.9, 0, 1.5]])
    both, cubes = neural_renderer.both_sides(faces, textures)
    light = np.ones((2, 2))

    def picture(clip):
        corners = neural_renderer.corners_of(clip, both)
        return neural_renderer.shade_cubes(corners, cubes, light, 24, 16, BACKGROUND)[:2]

    front, front_index = picture(clip)
    back, back_index = picture(clip * [-1, 1, 1, 1])
    assert front_index.max() == 0 and back_index.max() == 1
    np.testing.assert_allclose(back[:, ::-1], front, atol=1e-12)


@pytest.mark.parametrize("size, reached", [(2, 8), (3, 20), (4, 37), (8, 155)])
def test_most_texels_of_a_large_cube_are_never_read(rng, size, reached):
    """The face is the plane i + j + k = T - 1 of its cube, and reads the cells that this cuts."""
    weight = rng.dirichlet(np.ones(3), 20_000)
    index, tap = neural_renderer.cube_taps(weight, np.ones(len(weight)), np.ones((len(weight), 3)),
                                           size)
    cell = np.indices((size - 1,) * 3).reshape(3, -1).T
    cell = cell[(cell.sum(1) < size - 1) & (cell.sum(1) + 3 > size - 1)]
    corners = (cell[:, None] + np.indices((2, 2, 2)).reshape(3, -1).T).reshape(-1, 3)
    expected = np.unique(np.ravel_multi_index(corners.T, (size,) * 3))
    np.testing.assert_array_equal(np.unique(index[tap > 0]), expected)
    assert len(expected) == reached


def test_gradients_inside_of_faces_are_central_differences(rng):
    """A way from the colour back to corners, texels or light that is lost."""
    corners, textures, light = some_corners(rng), rng.random((12, 3, 3, 3, 2)), rng.random((12, 2))

    def shade(*scene):
        return neural_renderer.shade_cubes(*scene, WIDTH, HEIGHT, BACKGROUND)

    def decisions(corners, textures, light):
        _, face_index, weight, depth = shade(corners, textures, light)
        seen = face_index >= 0
        return face_index, neural_renderer.cube_taps(weight[seen], depth[seen],
                                                     corners[face_index[seen], :, 2], 3)[0]

    def backward(grad, *scene):
        return neural_renderer.shade_cubes_backward(grad, *scene, *shade(*scene)[1:])

    gradcheck(lambda *scene: shade(*scene)[0], backward,
              (corners, textures, light), decisions=decisions, name="cubes")


# --- the sweep ---------------------------------------------------------------------------------

OUTSIDE = [[0.8, 0.8, 1.0], [0.0, -0.5, 1.0], [0.2, -0.4, 1.0]]
INSIDE = [[0.8, 0.8, 1.0], [-0.5, -0.8, 1.0], [0.8, -0.8, 1.0]]


def sweep_of_one_pixel(sweep, corners, row_from_top, column, gradient):
    """A white triangle on black, 64 x 64; the loss asks one pixel alone."""
    corners, grad_colour = np.array([corners]), np.zeros((64, 64, 3))
    face_index, *_ = neural_renderer.rasterize(corners, 64, 64)
    colour = np.repeat((face_index >= 0)[..., None] * 1.0, 3, -1)
    grad_colour[63 - row_from_top, column] = gradient / 3
    return sweep(grad_colour, colour, face_index, corners)[0]


SWEEPS = pytest.mark.parametrize("sweep", [neural_renderer.sweep_backward_loop,
                                           neural_renderer.sweep_backward])


@SWEEPS
def test_a_pixel_outside_by_hand_and_as_in_the_original(sweep):
    """Row 25 from the top, column 35; the original's test allows 1e-2 of its own figures."""
    got = sweep_of_one_pixel(sweep, OUTSIDE, 25, 35, -1.0)
    # On screen (57.6, 57.6), (32, 16), (38.4, 19.2); the pixel's centre is (35.5, 38.5).
    # By x: on row y = 38.5 edge 0-1 is at u = 22.5 / 41.6 of its height. By y: on column x = 35.5
    # at v = 3.5 / 25.6 of its width, and no other edge has the pixel on its outer side.
    u, v = 22.5 / 41.6, 3.5 / 25.6
    x, y = (32 + 25.6 * u - 35.5) / 32, (38.5 - 16 - 41.6 * v) / 32
    expected = [[1 / (x / u + 1e-4), -1 / (y / v + 1e-4), 0],
                [1 / (x / (1 - u) + 1e-4), -1 / (y / (1 - v) + 1e-4), 0], [0, 0, 0]]
    np.testing.assert_allclose(got, expected, rtol=1e-9)
    original = [[1.6725862, -0.26021874, 0], [1.41986704, -1.64284933, 0], [0, 0, 0]]
    np.testing.assert_allclose(got, original, rtol=1e-4)


@SWEEPS
def test_a_pixel_inside_by_hand_and_as_in_the_original(sweep):
    """Row 40 from the top, column 50; all three edges could leave it behind."""
    got = sweep_of_one_pixel(sweep, INSIDE, 40, 50, 1.0)
    # On screen (57.6, 57.6), (16, 6.4), (57.6, 6.4); the pixel's centre is (50.5, 23.5).
    # By x: edge 0-1 at u of its height, and the upright edge 2-0. By y: edge 0-1 at v of its width,
    # and the flat edge 1-2.
    u, v = 17.1 / 51.2, 34.5 / 41.6
    left, right = (50.5 - 16 - 41.6 * u) / 32, 7.1 / 32
    above, below = (6.4 + 51.2 * v - 23.5) / 32, 17.1 / 32
    expected = [[1 / (right / u + 1e-4) - 1 / (left / u + 1e-4), 1 / (above / v + 1e-4), 0],
                [-1 / (left / (1 - u) + 1e-4),
                 1 / (above / (1 - v) + 1e-4) - 1 / (below / (1 - v) + 1e-4), 0],
                [1 / (right / (1 - u) + 1e-4), -1 / (below / v + 1e-4), 0]]
    np.testing.assert_allclose(got, expected, rtol=1e-9)
    original = [[0.98646867, 1.04628897, 0], [-1.03415668, -0.10403691, 0],
                [3.00094461, -1.55173182, 0]]
    np.testing.assert_allclose(got, original, rtol=1e-4)


@pytest.mark.parametrize("eps", [0.0, 1e-4, 0.1])
def test_the_sweep_of_whole_meshes_is_that_of_the_loop(rng, eps):
    """A line, an end or a chunk that is lost; the sign of columns; width for height."""
    corners = some_corners(rng)
    face_index, *_ = neural_renderer.rasterize(corners, WIDTH, HEIGHT)
    colour, grad_colour = rng.random((HEIGHT, WIDTH, 2)), rng.normal(size=(HEIGHT, WIDTH, 2))
    scene = grad_colour, colour, face_index, corners, eps
    got = neural_renderer.sweep_backward(*scene)
    expected = neural_renderer.sweep_backward_loop(*scene)
    np.testing.assert_allclose(got, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_the_sweep_of_many_chunks_is_that_of_the_loop(rng, monkeypatch):
    """A chunk of lines that begins anew."""
    monkeypatch.setattr(rasterization, "CHUNK", 64)
    test_the_sweep_of_whole_meshes_is_that_of_the_loop(rng, 1e-4)
    test_the_loop_and_whole_meshes_agree_to_the_bit(rng)


# --- SoftRas -----------------------------------------------------------------------------------

def soft_by_search(screen, width, height, sigma, steps=2000):
    """The distance to many points of each border, and a winding number for inside."""
    outside = np.ones((height, width))
    along = np.linspace(0, 1, steps)[:, None]
    for face in screen:
        border = np.concatenate([a + along * (b - a) for a, b in
                                 zip(face, np.roll(face, -1, 0), strict=True)])
        for i, j in np.ndindex(height, width):
            p = np.array([j + 0.5, i + 0.5])
            distance = ((border - p)**2).sum(1).min()
            turn = np.arctan2(*(face - p).T)
            turn = (np.diff(turn, append=turn[0]) + np.pi) % (2 * np.pi) - np.pi
            s = distance / sigma * (1 if abs(turn.sum()) > 1 else -1)
            outside[i, j] *= 1 - 1 / (1 + np.exp(-s))
    return 1 - outside


def test_soft_silhouettes_are_those_of_a_search(rng):
    """A distance to an edge's line beyond its ends, or the sign of a clockwise face."""
    screen = rng.uniform(0, 9, (3, 3, 2))
    got = neural_renderer.soft_silhouette(screen, 9, 7, 1.5)
    np.testing.assert_allclose(got, soft_by_search(screen, 9, 7, 1.5), atol=1e-4)


def test_a_small_sigma_leaves_the_hard_silhouette(rng):
    """The probability of outside, or half a pixel."""
    corners = some_corners(rng, 4)
    corners[..., 2] = 1
    screen = neural_renderer.on_screen(corners, WIDTH, HEIGHT)
    both = np.concatenate([corners, corners[:, ::-1]])
    hard = neural_renderer.rasterize(both, WIDTH, HEIGHT)[0] >= 0
    np.testing.assert_allclose(neural_renderer.soft_silhouette(screen, WIDTH, HEIGHT, 1e-9), hard,
                               atol=1e-6)


@pytest.mark.parametrize("sigma", [0.1, 3.0])
def test_gradients_of_soft_silhouettes_are_central_differences(sigma):
    """The nearest point of an edge is given to one end alone, or the product of the others."""
    screen = np.random.default_rng(1).uniform(0, 15, (5, 3, 2))  # few decisions are near a change
    gradcheck(lambda screen: neural_renderer.soft_silhouette(screen, 15, 11, sigma),
              lambda grad, screen: (neural_renderer.soft_silhouette_backward(grad, screen, sigma),),
              (screen,), decisions=lambda screen: neural_renderer.soft_fragments(
                  screen, 15, 11, sigma)[:3], name="soft")


# --- the renderer ------------------------------------------------------------------------------

LIGHTS = np.array([0.3, 0.2]), np.array([0.6, 0.9]), np.array([0.4, 0.7, 0.5])


def scene(rng):
    vertices, faces = mesh.icosphere(20)
    return vertices, faces, rng.random((len(faces), 2, 2, 2, 2)), camera()


def test_a_pixel_is_the_mean_of_four(rng):
    """The sum, or one of the four."""
    things = scene(rng)
    fine, _ = neural_renderer.render(*things, LIGHTS, 24, 16, BACKGROUND, samples=1)
    got, _ = neural_renderer.render(*things, LIGHTS, 12, 8, BACKGROUND)
    np.testing.assert_allclose(got, fine.reshape(8, 2, 12, 2, 2).mean((1, 3)), atol=1e-12)


def test_gradients_of_texels_and_lights_are_central_differences(rng):
    """Supersampling without its quarter, a light that is applied to the background."""
    vertices, faces, textures, clip_from_world = scene(rng)

    def picture(textures, *lights):
        return neural_renderer.render(vertices, faces, textures, clip_from_world, lights, 12, 8,
                                      BACKGROUND)

    def backward(grad_picture, textures, *lights):
        _, buffers = picture(textures, *lights)
        _, grad_textures, grad_lights = neural_renderer.render_backward(
            grad_picture, buffers, vertices, faces, textures, clip_from_world, lights)
        return grad_textures, *grad_lights

    gradcheck(lambda *inputs: picture(*inputs)[0], backward, (textures, *LIGHTS), name="render")


def test_where_no_edge_is_in_sight_gradients_of_vertices_are_central_differences(rng):
    """A missing term of the divide, of the light's normals or of z."""
    vertices = np.array([[-30.0, -20.0, -2.0], [40.0, -25.0, 1.0], [0.5, 45.0, -6.0]])
    faces, textures = np.array([[0, 1, 2]]), rng.random((1, 2, 2, 2, 2))
    clip_from_world = camera((0.0, 0.3, 9.0))

    def picture(vertices):
        return neural_renderer.render(vertices, faces, textures, clip_from_world, LIGHTS, 9, 7,
                                      BACKGROUND)

    def backward(grad_picture, vertices):
        _, buffers = picture(vertices)
        return neural_renderer.render_backward(grad_picture, buffers, vertices, faces, textures,
                                               clip_from_world, LIGHTS)[:1]

    assert (picture(vertices)[1][4] == 0).all()
    gradcheck(lambda vertices: picture(vertices)[0], backward, (vertices,), name="vertices")


def test_an_empty_picture_has_no_gradient(rng):
    """Division by no pixels at all."""
    vertices, faces, textures, clip_from_world = scene(rng)
    away = vertices + [0.0, 0.0, 50.0]
    picture, buffers = neural_renderer.render(away, faces, textures, clip_from_world, LIGHTS, 6, 4,
                                              BACKGROUND)
    np.testing.assert_allclose(picture, np.tile(BACKGROUND, (4, 6, 1)))
    grad_vertices, grad_textures, _ = neural_renderer.render_backward(
        rng.normal(size=picture.shape), buffers, away, faces, textures, clip_from_world, LIGHTS)
    assert not grad_vertices.any() and not grad_textures.any()


@pytest.mark.parametrize("wrong", [
    {"textures": np.ones((19, 2, 2, 2, 2))}, {"textures": np.ones((20, 1, 1, 1, 2))},
    {"samples": 0}, {"background": np.zeros(3)}, {"lights": LIGHTS[:2]}])
def test_what_does_not_fit_is_told_in_one_sentence(rng, wrong):
    """19 cubes for 20 faces drew a picture."""
    names = "vertices", "faces", "textures", "clip_from_world"
    things = dict(zip(names, scene(rng), strict=True), lights=LIGHTS, width=6, height=4,
                  background=BACKGROUND)
    with pytest.raises(ValueError, match="render expects"):
        neural_renderer.render(**{**things, **wrong})
