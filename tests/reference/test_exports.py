"""What lab 16's search writes: GLB, OBJ, and the last good mesh."""
import io

import numpy as np
import pytest
import trimesh

from course.experiments.folder import exports, searches
from course.experiments.scenes import demo
from course.given import image, mesh_files
from reference import multi_view_fit

LABS = demo.Labs("reference")

def painted_ball():
    """A Scene of 5^3 cells, every point of the grid of another colour."""
    x = multi_view_fit.start(5)
    return x._replace(albedo=np.random.default_rng(0).uniform(0.2, 0.8, x.albedo.shape))


def test_glb_and_obj_hold_the_mesh_and_its_colours(tmp_path):
    """A file that no viewer opens, or with the colours of other vertices."""
    x = painted_ball()
    place = np.diag([2.0, 2.0, 2.0, 1.0])
    place[:3, 3] = 1.0, 2.0, 3.0
    exports.save(LABS, x, tmp_path / "found.glb", place)
    vertices, faces, _, _, albedo = multi_view_fit.surface(x)
    vertices = 2 * vertices + [1, 2, 3]
    scene = trimesh.load(io.BytesIO((tmp_path / "found.glb").read_bytes()), file_type="glb",
                         process=False)
    (found,) = scene.geometry.values()
    np.testing.assert_allclose(found.vertices, vertices, atol=1e-6)
    np.testing.assert_array_equal(found.faces, faces)
    np.testing.assert_allclose(found.visual.vertex_attributes["color"][:, :3] / 255, albedo,
                               atol=0.003)
    again = mesh_files.read(tmp_path / "found.obj")
    np.testing.assert_allclose(again[0], vertices, atol=1e-5)
    np.testing.assert_array_equal(again[1], faces)
    first = (tmp_path / "found.obj").read_text().splitlines()[0].split()
    np.testing.assert_allclose(np.array(first[4:], float), image.to_srgb(albedo[0]), atol=0.003)


def test_after_ctrl_c_the_last_good_mesh_is_on_disk(tmp_path):
    """Minutes of work are lost."""
    def stopped():
        yield painted_ball(), 0.1
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(searches.watched(LABS, stopped(), 9, tmp_path / "found.glb"))
    assert len(mesh_files.read(tmp_path / "found.obj")[1]) > 50
    assert (tmp_path / "found.glb").read_bytes()[:4] == b"glTF"


def test_a_search_that_came_to_nothing_says_so(tmp_path):
    """An empty mesh, or nan, takes the place of a good one."""
    good = painted_ball()
    empty = good._replace(distance=np.ones(216))
    for x, loss in (good, np.nan), (empty, 0.1):
        with pytest.raises(ValueError, match="came to nothing at step 2: are the cameras right"):
            list(searches.watched(LABS, iter([(good, 0.1), (x, loss)]), 9,
                                  tmp_path / "found.glb"))
        assert len(mesh_files.read(tmp_path / "found.obj")[1]) > 50
