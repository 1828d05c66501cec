"""The texture of the mesh that was found, and the file that holds it."""
import json

import numpy as np
import pytest
import scipy.ndimage
import trimesh

from apps.reconstruct import exports, textures
from course.given import image
from course.given.whose import Labs
from reference import multi_view_fit

LABS = Labs("reference")


def painted_ball():
    """A Surface of 5^3 cells, every point of the grid of another colour."""
    x = multi_view_fit.start(5)
    albedo = np.random.default_rng(0).uniform(0.2, 0.8, x.albedo.shape)
    return multi_view_fit.surface(x._replace(albedo=albedo))


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """The painted ball on disk, twice as large, turned a quarter and moved: the GLB's path."""
    path = tmp_path_factory.mktemp("saved") / "ball.glb"
    place = np.array([[0.0, -2, 0, 1], [2, 0, 0, 2], [0, 0, 2, 3], [0, 0, 0, 1]])
    ball = painted_ball()
    ball.normals[3] = 0  # 0 / 0 is no number that JSON has
    exports.save(LABS, ball, path, place)
    return path


def parts(path):
    """A GLB file's JSON and its binary part."""
    content = path.read_bytes()
    length = int.from_bytes(content[12:16], "little")
    return (json.loads(content[20:20 + length], parse_constant=pytest.fail),
            content[28 + length:])


def originals(vertices):
    """Which vertex of the ball each vertex of a file is."""
    ball = painted_ball()
    placed = 2 * ball.vertices[:, [1, 0, 2]] * [-1, 1, 1] + [1, 2, 3]
    gaps = np.linalg.norm(vertices[:, None] - placed, axis=2)
    assert gaps.min(1).max() < 1e-5
    return ball, gaps.argmin(1)


def looked_up(texture, uv):
    """A texture's colours at uv, bilinear, v up."""
    height, width, _ = texture.shape
    places = uv[:, 1] * height - 0.5, uv[:, 0] * width - 0.5
    return np.stack([scipy.ndimage.map_coordinates(channel, places, order=1, mode="nearest")
                     for channel in np.moveaxis(texture, 2, 0)], 1)


def test_the_glb_has_the_shape_and_the_normals(saved):
    """Vertices stay in the grid's space, normals are not turned with them, or a cut loses faces."""
    (found,) = trimesh.load(saved, process=False).geometry.values()
    ball, origin = originals(found.vertices)
    turned = ball.normals[:, [1, 0, 2]] * [-1, 1, 1]
    known = origin != 3
    np.testing.assert_allclose(found.vertex_normals[known], turned[origin][known], atol=1e-5)
    np.testing.assert_array_equal(np.sort(origin[found.faces], axis=0), np.sort(ball.faces, axis=0))
    assert found.is_winding_consistent


def test_the_material_is_dull_and_of_one_side(saved):
    """It glitters, or its inside is seen."""
    gltf, _ = parts(saved)
    (material,) = gltf["materials"]
    assert not material.get("doubleSided", False)
    assert material["pbrMetallicRoughness"]["metallicFactor"] == 0
    assert material["pbrMetallicRoughness"]["roughnessFactor"] == 1
    assert set(gltf["meshes"][0]["primitives"][0]["attributes"]) == {
        "POSITION", "NORMAL", "TEXCOORD_0"}


def test_the_glb_s_texture_has_the_albedo_at_the_vertices(saved):
    """v points down in glTF: a texture that is turned over shows other colours. So do colours that
    are not in sRGB.
    """
    gltf, binary = parts(saved)

    def viewed(view):
        start = gltf["bufferViews"][view].get("byteOffset", 0)
        return binary[start:start + gltf["bufferViews"][view]["byteLength"]]

    def accessed(name):
        accessor = gltf["accessors"][gltf["meshes"][0]["primitives"][0]["attributes"][name]]
        assert accessor.get("byteOffset", 0) == 0 and accessor["componentType"] == 5126
        return np.frombuffer(viewed(accessor["bufferView"]), np.float32).reshape(
            accessor["count"], -1)

    uv, texture = accessed("TEXCOORD_0"), viewed(gltf["images"][0]["bufferView"])
    assert (uv >= 0).all() and (uv <= 1).all()
    (saved.parent / "texture.png").write_bytes(texture)
    downwards = image.read(saved.parent / "texture.png")[::-1]
    ball, origin = originals(accessed("POSITION"))
    off = looked_up(downwards, uv.astype(float)) - image.to_srgb(ball.albedo[origin])
    assert np.abs(off).max() < 2 / 255


@pytest.fixture(scope="module")
def charts():
    """The painted ball, and how it is cut into charts."""
    ball = painted_ball()
    return ball, textures.unwrap(ball.vertices, ball.faces)


def test_no_two_triangles_overlap_in_the_texture(charts):
    """Two parts of the surface share texels, and show each other's colours."""
    ball, (uv, faces, origin) = charts
    np.testing.assert_array_equal(origin[faces], ball.faces)
    size = 256
    times = np.zeros((size, size), int)
    y, x = (np.mgrid[:size, :size] + 0.5) / size
    for a, b, c in uv[faces]:
        sides = [(q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
                 for p, q in ((a, b), (b, c), (c, a))]
        times += (np.min(sides, 0) > 1e-9) | (np.max(sides, 0) < -1e-9)
    assert times.max() == 1 and times.mean() > 0.4


def test_texels_between_charts_have_the_colour_of_the_nearest(charts):
    """Black seams: a filter at a chart's border mixes in what was never painted."""
    ball, (uv, faces, origin) = charts
    texture = textures.bake(LABS, uv, faces, ball.albedo[origin], 128)
    assert texture.min() >= ball.albedo.min() and texture.max() <= ball.albedo.max()
    even = textures.bake(LABS, uv, faces, np.full((len(uv), 3), 0.3), 128)
    np.testing.assert_allclose(even, 0.3, atol=1e-12)
