"""course.given.mesh_files: OBJ and PLY, read and written."""
import re
import struct
import time

import numpy as np
import pytest
import trimesh

from course.given import inputs, mesh, mesh_files

TRIANGLE = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 7 7 7\n"
TWO = [[0, 1, 2], [0, 2, 3]]
SHAPES = ("cube", "icosphere", "torus", "plane", "grid")
ZOO = {"bunny": mesh.bunny()} | {name: getattr(mesh, name)(100) for name in SHAPES}
PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
       "property float z\nelement face {}\nproperty list uchar int vertex_indices\n{}end_header\n"
       "0 0 0\n1 0 0\n1 1 0\n0 1 0\n")


def read_text(tmp_path, name, text):
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return mesh_files.read(path)


# Files


LEANING = np.array([[0.1, -0.0, 1], [1, 0.3, 0], [-1, 1, 0.7]])
WRITTEN = ZOO | {
    str(size): (LEANING * size, TRIANGLE[1]) for size in (5e-324, 1e-20, 1 / 3, 4e38, 1.7e308)
} | {
    kind: (np.arange(256 * 3.0).reshape(256, 3), np.array([[0, 1, last]], kind))
    for kind, last in (("uint8", 255), ("uint64", 255), ("int16", 2))
} | {
    "repeated and unused vertices": (np.array([[9.0, 9, 9], *np.eye(3), *np.eye(3), [8, 8, 8]]),
                                     np.array([[1, 2, 6], [2, 3, 4], [2, 2, 4]]))}


@pytest.mark.parametrize("ending", ["obj", "ply", "PLY"])
@pytest.mark.parametrize("case", WRITTEN)
def test_a_mesh_comes_back_from_a_file_to_the_bit(case, ending, tmp_path):
    """Vertices merged, reordered, rounded or tidied away, which would shift every index; faces
    turned. Infinity beyond float32, nothing but zeros below the last decimal, the sign of -0.
    A vertex index that wraps around where it is counted from 1.
    """
    vertices, faces = WRITTEN[case]
    mesh_files.write(tmp_path / f"mesh.{ending}", vertices, faces)
    again, faces_again = mesh_files.read(tmp_path / f"mesh.{ending}")
    assert again.dtype == np.float64 and faces_again.dtype == np.int64
    assert type(again) is np.ndarray and type(faces_again) is np.ndarray
    np.testing.assert_array_equal(faces_again, faces)
    assert again.tobytes() == vertices.tobytes()


def test_writing_twice_gives_the_same_bytes_and_no_other_file(tmp_path):
    """A date in the file, a neighbour left behind."""
    for ending in ("obj", "ply"):
        mesh_files.write(tmp_path / f"a.{ending}", *mesh.cube(12))
        mesh_files.write(tmp_path / f"b.{ending}", *mesh.cube(12))
        assert (tmp_path / f"a.{ending}").read_bytes() == (tmp_path / f"b.{ending}").read_bytes()
    assert len(list(tmp_path.iterdir())) == 4


@pytest.mark.parametrize(("lines", "expected"), [
    ("f 1 2 3\nf 1 3 4\n", TWO),
    ("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/4 3/2 4/1\n", TWO),
    ("vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//2\nf 1//2 3//1 4//2\n", TWO),
    ("vt 0 0\nvn 0 0 1\nvn 0 1 0\nf 1/1/1 2/1/1 3/1/2\nf 1/1/2 3/1/1 4/1/2\n", TWO),
    ("mtllib a\no left\nusemtl red\nf 1 2 3\no right\ng side\nusemtl blue\ns 1\nf 1 3 4\n", TWO),
    ("# two faces, one/two\nf 1 2 \\\n 3 # corner\n\tf\t1  3 4 \n", TWO),
    ("f 1 2 \\\r\n3\r\nf 1 3 4", TWO),
    ("f 1 2 3 4\n", TWO),
    ("f -5 -4 -3\nv 1 1 1\nf -6 -1 2", [[0, 1, 2], [0, 5, 1]]),
    ("f 1 2 3\nf 1 2 3 4\nf 3 2 1", [[0, 1, 2], *TWO, [2, 1, 0]]),
    ("f 1 2 3 4\nf 5 4 3 2", [*TWO, [4, 3, 2], [4, 2, 1]]),
    ("f 2 3 4 5 1", [[1, 2, 3], [1, 3, 4], [1, 4, 0]]),
    ("f 6 2 3\nv 9 9 9 1 0 0", [[5, 1, 2]]),
    ("\n\n \nf 1 2 3\n\n\t\n", [[0, 1, 2]]),
    ("f 1//-1 2//-1 3//-1\nvn 0 0 1", [[0, 1, 2]]),
])
def test_an_obj_gives_its_vertices_and_its_faces_in_order_whatever_else_it_holds(
        lines, expected, tmp_path):
    """Vertices split at seams of uv or normals, faces reordered by material or quads sorted behind,
    one object lost. -1 taken for the file's last vertex, not the last one so far.
    """
    vertices, faces = read_text(tmp_path, "square.obj", SQUARE + lines)
    assert faces.tolist() == expected
    np.testing.assert_array_equal(vertices[:5, 0], [0, 1, 1, 0, 7])
    assert len(vertices) == 5 + lines.count("v 1 1 1") + lines.count("v 9 9 9")


@pytest.mark.parametrize("words", ["1 2 3", "1 2 3 1.0", "1 2 3 .5 .25 1", "+1. .2e1 3E0"])
def test_an_obj_with_colours_or_weights_gives_its_positions(words, tmp_path):
    """A colour for the next vertex's position."""
    vertices, _ = read_text(tmp_path, "a.obj", f"v {words}\nv 4 5 6\nv 7 8 0.1\nf 1 2 3")
    assert vertices.tolist() == [[1, 2, 3], [4, 5, 6], [7, 8, 0.1]]


UV = "property list uchar float texcoord"


@pytest.mark.parametrize(("face", "rows", "expected"), [
    ("", "3 0 1 2\n4 0 1 2 3\n3 2 1 0\n", [[0, 1, 2], *TWO, [2, 1, 0]]),
    ("", "4 0 1 2 3\n4 3 2 1 0\n", [*TWO, [3, 2, 1], [3, 1, 0]]),
    ("", "5 3 2 1 0 2\n", [[3, 2, 1], [3, 1, 0], [3, 0, 2]]),
    ("", "3 0 1 2\n\n \n3 0 2 3\n\n\n", TWO),
    (f"{UV}\n", "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 1 0 1 1 0 1\n", TWO),
    (f"{UV}\n", "4 0 1 2 3 0\n", TWO),
    ("property uchar red\nproperty uchar green\nproperty uchar blue\n", "3 0 1 2 9 9 9\n", TWO[:1]),
    ("element edge 1\nproperty int vertex1\nproperty int vertex2\n", "3 0 1 2\n0 1\n", TWO[:1]),
    ("comment the line\ncomment end_header comes\nobj_info end_header\n", "3 0 1 2\n", TWO[:1]),
])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_an_ascii_ply_keeps_its_faces_in_order(newline, face, rows, expected, tmp_path):
    """Vertices split at seams of uv, quads dropped or sorted behind, a header cut in a comment."""
    count = sum(bool(row) and len(row) > 3 for row in map(str.strip, rows.split("\n")))
    text = (PLY.format(count, face) + rows).replace("\n", newline)
    vertices, faces = read_text(tmp_path, "a.ply", text)
    assert vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert faces.tolist() == expected


@pytest.mark.parametrize("vertex", ["0 0 0 255 0 0", "0 0 0 0.5 0.25 300"])
def test_a_plys_other_properties_are_passed_over(vertex, tmp_path):
    """Columns shifted, vertices split by uv, a face beyond them that raises an IndexError."""
    for names in ("red green blue", "nx ny nz", "s t material", "u v w"):
        header = PLY[:PLY.index("element face")].replace("vertex 4", "vertex 3")
        header += "".join(f"property float {name}\n" for name in names.split())
        header += "element face 1\nproperty list uchar int vertex_index\nend_header\n"
        rows = f"{vertex}\n1 0 0 1 1 1\n0 1 0.1 2 2 2\n3 {{}}\n"
        vertices, faces = read_text(tmp_path, "a.ply", header + rows.format("2 0 1"))
        np.testing.assert_array_equal(vertices, np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0.1]]))
        assert faces.tolist() == [[2, 0, 1]]
        with pytest.raises(ValueError, match="face 0 names vertex 3, but there are 3 vertices"):
            read_text(tmp_path, "a.ply", header + rows.format("2 0 3"))


def binary_ply(order, polygons, vertices, extra=""):
    """A PLY with a byte and a short before each face's corners, if extra is "before"."""
    before = "property uchar a\nproperty short b\n" if extra == "before" else ""
    after = "property list ushort double c\n" if extra == "after" else ""
    header = (f"ply\nformat binary_{'big' if order == '>' else 'little'}_endian 1.0\n"
              f"element material 2\nproperty short id\nelement vertex {len(vertices)}\n"
              "property uchar red\nproperty double x\nproperty double y\nproperty double z\n"
              f"element face {len(polygons)}\n{before}property list uchar uint vertex_indices\n"
              f"{after}end_header\n")
    rows = struct.pack(f"{order}2h", 1, 2)
    rows += b"".join(struct.pack(f"{order}B3d", 7, *vertex) for vertex in vertices)
    for k, corners in enumerate(polygons):
        rows += struct.pack(f"{order}Bh", 1, 2) if before else b""
        rows += struct.pack(f"{order}B{len(corners)}I", len(corners), *corners)
        rows += struct.pack(f"{order}H{k % 3}d", k % 3, *range(k % 3)) if after else b""
    return header.encode() + rows


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize("extra", ["", "before", "after"])
@pytest.mark.parametrize(("polygons", "expected"), [
    ([[0, 1, 2], [3, 2, 1]], [[0, 1, 2], [3, 2, 1]]),
    ([[0, 1, 2], [3, 2, 1, 0], [1, 2, 3]], [[0, 1, 2], [3, 2, 1], [3, 1, 0], [1, 2, 3]]),
    ([[0, 1, 2, 3], [3, 2, 1, 0]], [[0, 1, 2], [0, 2, 3], [3, 2, 1], [3, 1, 0]]),
    ([[0, 1, 2, 3, 0]], [[0, 1, 2], [0, 2, 3], [0, 3, 0]]),
])
def test_a_binary_ply_may_mix_its_faces(order, extra, polygons, expected, tmp_path):
    """The first row's length taken for that of all."""
    vertices = np.random.default_rng(3).normal(size=(4, 3))
    content = binary_ply(order, polygons, vertices, extra)
    again, faces = read_text(tmp_path, "a.ply", content)
    np.testing.assert_array_equal(again, vertices)
    assert faces.tolist() == expected
    for wrong in (content[:-1], content + b"\1", content[:-30]):
        with pytest.raises(ValueError, match="export the file again"):
            read_text(tmp_path, "a.ply", wrong)


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_what_trimesh_writes_is_read_as_trimesh_reads_it(encoding, tmp_path):
    """A type or a byte order misread, the same way by writer and reader."""
    for vertices, faces in ZOO.values():
        theirs = trimesh.Trimesh(vertices, faces, process=False, vertex_colors=vertices + 9)
        content = theirs.export(file_type="ply", encoding=encoding, vertex_normal=True)
        again, faces_again = read_text(tmp_path, "a.ply", content)
        np.testing.assert_allclose(again, vertices.astype(np.float32), rtol=0, atol=1e-7)
        np.testing.assert_array_equal(faces_again, faces)


@pytest.mark.parametrize("count", [10**6, 10**12, 10**17])
def test_a_header_that_announces_too_much_is_refused_at_once(count, tmp_path):
    """Memory for rows that are not there, a loop over them."""
    start = time.perf_counter()
    for form in ("ascii", "binary_little_endian"):
        for old in ("vertex 4", "face 1"):
            text = PLY.format(1, "").replace("ascii", form) + "3 0 1 2\n"
            text = text.replace(old, f"{old.split()[0]} {count}")
            with pytest.raises(ValueError, match="export the file again"):
                read_text(tmp_path, "a.ply", text)
    assert time.perf_counter() - start < 1


NOT_ANNOUNCED = "does not have the numbers that the header and the lengths of lists announce"


NO_FACE = "a mesh needs at least one face, got none"
NO_MESH = "its header must name one format"
ONE_FACE = PLY.format(1, "") + "3 0 1 2\n"
BROKEN = [("a.obj", SQUARE + lines, sentence) for lines, sentence in (
    ("", NO_FACE),
    ("f 1 2 9\n", "a face names vertex 9, but the file has 5"),
    ("f 1 2 -6\n", "a face names vertex -6, but only 5 stand before it"),
    ("f 1 2 123456789012345678\n", "a face names vertex 123456789012345678"),
    ("f 0 1 2\n", "the line 'f 0 1 2' is neither v and three coordinates"),
    ("f 1 2 3\nf 1 2", "the line 'f 1 2' is neither"),
    ("f 1 2 3.5", "the line 'f 1 2 3.5' is neither"),
    ("f 1 2 3\nv 1 2", "the line 'v 1 2' is neither"),
    ("v 1 2 nan\nf 1 2 3\n", "finite, vertex 5 is [1.0, 2.0, nan]"),
    ("v 1 2 1e999\nf 1 2 3\n", "finite, vertex 5 is [1.0, 2.0, inf]"),
    ("v 1 2 x\nf 1 2 3\n", "the line 'v 1 2 x' is neither"),
    ("v 1 2 1_0\nf 1 2 3\n", "the line 'v 1 2 1_0' is neither"),
)] + [("a.ply", ONE_FACE.replace(old, new), sentence) for old, new, sentence in (
    ("element face 1\nproperty list uchar int vertex_indices\n", "", NO_MESH),
    ("end_header", "property float a\nproperty float a\nend_header", "and no property twice"),
    ("end_header", "element empty 9\nend_header", NO_MESH),
    ("end_header", "element vertex 9\nend_header", "the line 'element vertex 9' does not belong"),
    ("end_header", "property string a\nend_header", "the line 'property string a' does not belong"),
    ("face 1", "face -1", "the line 'element face -1' does not belong"),
    ("float x", "list uchar float x", "of single numbers"),
    ("uchar int", "uchar float", "vertex_indices of integers"),
    ("vertex 4", "vertex 3", "announces 4 rows, but 5 follow"),
    ("face 1", "face 9", "its header announces 13 rows, but 5 follow"),
    ("1 0 0", "1 0", f"'1 0' {NOT_ANNOUNCED}"),
    ("1 0 0", "1 0 1e39", "must be finite"),
    ("3 0 1 2", "3 0 1 2\n3 0 2 3", "announces 5 rows, but 6 follow"),
    ("3 0 1 2", "3 0 1 4", "face 0 names vertex 4, but there are 4 vertices"),
    ("3 0 1 2", "3 0 1 -1", "face 0 names vertex -1, but there are 4 vertices"),
    ("3 0 1 2", "3 0 1 4294967296", "face 0 names vertex 4294967296"),
    ("3 0 1 2", f"3 0 1 {10**40}", "faces (F, 3) must be integers"),
    ("3 0 1 2", "2 0 1", "expected faces of three or more corners, got 2"),
    *(("3 0 1 2", row, f"the row '{row}' {NOT_ANNOUNCED}")
      for row in ("3 0 1 2 3", "-1 0 1 2", "3 0 1 2.5", "3 0 1 x")),
)] + [
    ("a.obj", "", NO_FACE),
    ("a.obj", bytes(range(256)) * 9, NO_FACE),
    ("a.obj", ONE_FACE, NO_FACE),
    ("a.ply", "", "expected a PLY, which begins with the line ply"),
    ("a.ply", bytes(range(256)) * 9, "expected a PLY"),
    ("a.ply", SQUARE + "f 1 2 3\n", "expected a PLY"),
    ("a.ply", "ply\nformat ascii 1.0\nend_header\n", NO_MESH),
    ("a.ply", PLY.format(0, ""), NO_FACE),
    ("a.ply", PLY[:PLY.index("0 0 0")].replace("vertex 4", "vertex 0").format(0, ""), NO_FACE),
    ("a.ply", PLY.format(2, "").replace("vertex 4", "vertex 3") + "3 0 1 2\n",
     f"the row '0 1 0' {NOT_ANNOUNCED}"),
    ("a.ply", PLY.format(2, "") + "3 0 1 2\n4 0 1 2", f"the row '4 0 1 2' {NOT_ANNOUNCED}"),
]


@pytest.mark.parametrize(("name", "text", "sentence"), BROKEN)
def test_a_broken_file_gets_one_sentence_with_its_name(name, text, sentence, tmp_path):
    """A traceback out of the library, or a mesh that is not in the file."""
    with pytest.raises(ValueError, match=re.escape(sentence)) as error:
        read_text(tmp_path, name, text)
    assert str(error.value).startswith(f"cannot read {tmp_path / name} as a mesh: ")
    assert "\n" not in str(error.value) and error.value.__cause__ is None


@pytest.mark.parametrize("seed", range(4))
def test_a_file_with_wrong_bytes_is_read_or_refused_in_a_sentence(seed, tmp_path):
    """An IndexError, a UnicodeDecodeError or a MemoryError out of the library."""
    rng, mixed = np.random.default_rng(seed), [[0, 1, 2], [3, 2, 1, 0], [1, 2, 3]]
    contents = [("a.obj", (SQUARE + "f 1/1 2/2 3/3\nf -1 -2 -3 -4\n").encode()),
                ("a.ply", (PLY.format(2, "") + "3 0 1 2\n4 0 1 2 3\n").encode()),
                ("a.ply", binary_ply("<", mixed, np.eye(4, 3), "after")),
                ("a.ply", binary_ply(">", mixed[:1], np.eye(4, 3)))]
    for name, content in contents * 25:
        wrong = np.frombuffer(content, np.uint8).copy()
        wrong[rng.integers(len(wrong), size=3)] = rng.integers(256, size=3)
        try:
            vertices, faces = read_text(tmp_path, name, wrong.tobytes())
        except ValueError as error:
            assert str(error).startswith("cannot read ") and "\n" not in str(error)
        else:
            inputs.require_mesh(vertices, faces)


@pytest.mark.parametrize("ending", ["obj", "ply"])
def test_a_file_cut_anywhere_is_refused(ending, tmp_path):
    """A truncated download that is read as a mesh with a piece missing, or ends in a traceback."""
    mesh_files.write(tmp_path / f"whole.{ending}", *mesh.cube(12))
    content = (tmp_path / f"whole.{ending}").read_bytes()
    for length in range(0, len(content) - 1, 7):
        try:
            vertices, _ = read_text(tmp_path, f"cut.{ending}", content[:length])
        except ValueError:
            continue
        # An OBJ does not say how many faces follow: cut behind a corner it is a whole file.
        assert ending == "obj" and len(vertices) == 8


def test_a_file_that_cannot_be_opened_gets_one_sentence(tmp_path):
    """A bare FileNotFoundError, or the loader's complaint about a type."""
    with pytest.raises(FileNotFoundError, match=r"^there is no file .*no\.obj: check its name"):
        mesh_files.read(tmp_path / "no.obj")
    (tmp_path / "folder.ply").mkdir()
    with pytest.raises(OSError, match=r"^cannot read .*folder\.ply .*: give the name of a file"):
        mesh_files.read(tmp_path / "folder.ply")
    with pytest.raises(ValueError, match=r"^meshes are read and written as \.obj or \.ply, got 'a"):
        mesh_files.read("a.stl")
    with pytest.raises(ValueError, match=r"^meshes are read and written as \.obj or \.ply, got 'a"):
        mesh_files.write("a.stl", *TRIANGLE)
    with pytest.raises(OSError, match=r"^cannot write .*a\.obj .*: name a file in a folder that"):
        mesh_files.write(tmp_path / "nowhere" / "a.obj", *TRIANGLE)


def test_a_broken_mesh_leaves_the_old_file(tmp_path):
    """A file opened for writing before the mesh was looked at."""
    path = tmp_path / "a.ply"
    mesh_files.write(path, *TRIANGLE)
    before = path.read_bytes()
    with pytest.raises(ValueError, match="face 0 names vertex 3"):
        mesh_files.write(path, TRIANGLE[0], TRIANGLE[1] + 1)
    assert path.read_bytes() == before
