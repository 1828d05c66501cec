"""The cage and its limit surface: Loop's rule, and what a pull does."""
import numpy as np
from hands import drag
from reading import opened, point_of, settled

from course.given import mesh
from reference import loop_subdivision


def test_a_step_and_the_limits_are_those_of_the_reference(call):
    """An edge's two opposite corners are mixed up, or the limit has the weights of a step."""
    tetrahedron = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    meshes = [mesh.torus(64), (np.eye(4), tetrahedron)]
    for vertices, faces in meshes:
        vertices = vertices + np.random.default_rng(11).normal(size=vertices.shape)
        found, = call("limit_surface", "loopSurface", [(vertices, faces, 2)])
        wanted, fine = loop_subdivision.loop_surface(vertices, faces, 2)
        ours = np.array(found["vertices"])[np.array(found["faces"])].mean(1)
        theirs = wanted[fine].mean(1)
        assert ours.shape == theirs.shape
        np.testing.assert_allclose(ours[np.lexsort(ours.round(7).T)],
                                   theirs[np.lexsort(theirs.round(7).T)], atol=1e-9)


def test_the_cage_is_closed_and_its_faces_look_outward(call):
    """A face of the cage is turned, and the surface has a dark patch."""
    cage, = call("limit_surface", "icosahedron", [()])
    corners = np.array(cage["vertices"])[np.array(cage["faces"])]
    assert corners.shape == (20, 3, 3)
    np.testing.assert_allclose(np.linalg.norm(cage["vertices"], axis=1), 1, atol=1e-9)
    volumes = np.linalg.det(corners) / 6
    assert volumes.min() > 0 and np.isclose(volumes.sum(), 2.53615, atol=1e-5)


def test_the_surface_goes_along_with_the_vertex(page, address):
    """The cage moves, and the surface stays."""
    opened(page, address, "limit_surface")
    before = page.locator("canvas").screenshot()
    vertex = page.get_by_role("slider")
    drag(page, vertex, 130, -20)
    assert point_of(vertex)[0] > 1
    assert settled(page).locator("canvas").screenshot() != before
