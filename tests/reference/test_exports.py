"""What lab 16's search writes: GLB, OBJ, and the last good mesh."""
import json

import numpy as np
import pytest
from found_objects import LABS, painted_ball, read_glb, read_obj

from course.experiments.folder import exports, searches
from course.given import image
from reference import multi_view_fit


def test_glb_and_obj_hold_the_mesh_and_its_colours(tmp_path):
    """A file that no viewer opens, or with the colours of other vertices."""
    x = painted_ball()
    place = np.diag([2.0, 2.0, 2.0, 1.0])
    place[:3, 3] = 1.0, 2.0, 3.0
    exports.save(LABS, x, tmp_path / "found.glb", place)
    vertices, faces, _, _, albedo = multi_view_fit.surface(x)
    vertices = 2 * vertices + [1, 2, 3]
    found = read_glb(tmp_path / "found.glb")
    np.testing.assert_allclose(found.vertices, vertices, atol=1e-6)
    np.testing.assert_array_equal(found.faces, faces)
    np.testing.assert_allclose(found.visual.vertex_attributes["color"][:, :3] / 255, albedo,
                               atol=0.003)
    rows, corners = read_obj(tmp_path / "found.obj")
    np.testing.assert_allclose(rows["v"][:, :3], vertices, atol=1e-5)
    np.testing.assert_array_equal(corners[..., 0], faces)
    np.testing.assert_allclose(rows["v"][0, 3:], image.to_srgb(albedo[0]), atol=0.003)


@pytest.mark.parametrize("size", [1e-12, 1e-4, 1e7])
def test_an_obj_keeps_the_digits_of_a_mesh_of_any_size(tmp_path, size):
    """A fixed number of decimals: a mesh of millionths of a unit comes back as a few steps."""
    x = painted_ball()
    exports.save(LABS, x, tmp_path / "found.glb", np.diag([size, size, size, 1.0]))
    surface = multi_view_fit.surface(x)
    exports.save_textured(LABS, surface, np.ones(len(surface.vertices)), tmp_path / "textured.glb",
                          np.diag([size, size, size, 1.0]))
    expected = size * surface.vertices
    found, textured = (read_obj(tmp_path / f"{name}.obj")[0]["v"][:, :3]
                       for name in ("found", "textured"))
    np.testing.assert_allclose(found, expected, 0, 1e-15 * size)
    apart = np.abs(textured[:, None] - expected).max(-1).min(1)
    assert apart.max() <= 1e-15 * size


def test_a_glb_with_a_vertex_without_normal_is_json(tmp_path):
    """0 / 0 is NaN, which the header's JSON does not know: no viewer opens the file."""
    vertices, faces, _, normals, albedo = multi_view_fit.surface(painted_ball())
    normals[3] = 0
    vertices, normals = exports.in_world(vertices, normals, np.eye(4))
    content = exports.glb(vertices, faces, normals, albedo)
    header = content[20:20 + int.from_bytes(content[12:16], "little")]
    json.loads(header, parse_constant=pytest.fail)


def test_after_ctrl_c_the_last_good_mesh_is_on_disk(tmp_path):
    """Minutes of work are lost."""
    def stopped():
        yield painted_ball(), 0.1
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(searches.watched(LABS, stopped(), searches.bar("", 9), tmp_path / "found.glb"))
    assert len(read_obj(tmp_path / "found.obj")[1]) > 50
    assert (tmp_path / "found.glb").read_bytes()[:4] == b"glTF"


def test_a_search_that_came_to_nothing_says_so(tmp_path):
    """An empty mesh, or nan, takes the place of a good one."""
    good = painted_ball()
    empty = good._replace(distance=np.ones(216))
    for x, loss in (good, np.nan), (empty, 0.1):
        with pytest.raises(ValueError, match="came to nothing at step 2: are the cameras right"):
            list(searches.watched(LABS, iter([(good, 0.1), (x, loss)]), searches.bar("", 9),
                                  tmp_path / "found.glb"))
        assert len(read_obj(tmp_path / "found.obj")[1]) > 50
