"""course.given.inputs: what functions of the labs refuse, in one sentence."""
import re

import numpy as np
import pytest

from course.given import inputs

KINDS = [np.int8, np.int64, np.uint8, np.uint16, np.uint64, np.dtype(">i4")]


@pytest.mark.parametrize("kind", KINDS)
def test_faces_may_be_of_any_integers(kind):
    """Unsigned ones refused, or compared with a number that they cannot hold."""
    for vertex_count in (3, 127, 1000, 2**40):
        inputs.require_faces(np.array([[0, 1, 2], [2, 2, 0]], kind), vertex_count)
    for vertex_count in (0, 3):
        inputs.require_faces(np.zeros((0, 3), kind), vertex_count)


@pytest.mark.parametrize("kind", KINDS)
def test_a_face_beyond_the_vertices_is_named(kind):
    """The first vertex too many, which is the count; -1, which is the last one to NumPy."""
    faces = np.array([[0, 1, 2], [1, 0, 2]], kind)
    with pytest.raises(ValueError, match="face 0 names vertex 2, but there are 2 vertices, counted "
                                         "from 0; mend that face"):
        inputs.require_faces(faces, 2)
    faces[1, 1] = np.array(-1).astype(kind)
    last = faces[1, 1]
    with pytest.raises(ValueError, match=rf"from 0 to 2.*face 1 names vertex {last}, but there"):
        inputs.require_faces(faces, 3)


@pytest.mark.parametrize(("faces", "came"), [
    ([[0, 1, 2]], "a list: give an array"), (None, "a NoneType: give an array"),
    *((np.zeros(shape, kind), f"{shape} of {kind}: give three integers for each triangle")
      for shape, kind in (((1, 3), "float64"), ((1, 3), "bool"), ((1, 3), "object"),
                          ((3,), "int64"), ((1, 4), "int64"), ((0, 4), "int64"), ((), "int64")))])
def test_what_is_no_array_of_faces_is_told(faces, came):
    """Quads taken for triangles, floats for indices."""
    sentence = f"faces (F, 3) must be integers from 0 to 3, rows of the vertices; got {came}"
    with pytest.raises(ValueError, match=re.escape(sentence)) as error:
        inputs.require_faces(faces, 4)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("kind", KINDS)
def test_uv_faces_may_be_of_any_integers(kind):
    """The same of the corners' uv, and of the vertices opposite to edges, where -1 is none."""
    faces = np.array([[0, 1, 2]], kind)
    inputs.require_texture(faces, np.zeros((3, 2)), faces, np.zeros((2, 2, 1)), np.zeros(1))
    inputs.require_geometry(np.eye(3), faces, np.eye(4), 4, 3, np.full((1, 3), -1))
    with pytest.raises(ValueError, match=r"uv_faces.*from 0 to 1, rows of uv; got 0 to 2"):
        inputs.require_texture(faces, np.zeros((2, 2)), faces, np.zeros((2, 2, 1)), np.zeros(1))
