"""One's own mesh or photo in a scene's place, and ten lines that draw it."""
import io
import shutil
import subprocess
import sys

import numpy as np
import pytest
import trimesh
from PIL import Image

from course.given import image, mesh, mesh_files
from course.given.whose import Labs, Lacking
from course.scenes import demo, levels, own
from labkit import exercises, places
from labkit.checks import assert_close

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 2 0\n"


@pytest.fixture
def file(tmp_path):
    """file("a.obj", text) -> its path."""
    def write(name, text):
        path = tmp_path / name
        path.write_text(text)
        return path

    return write


@pytest.mark.parametrize("kind", mesh_files.KINDS)
def test_a_mesh_is_read_from_each_kind_of_file(kind, tmp_path):
    """An STL's corners stay apart, so no face has a neighbour; or parts of a file are lost."""
    vertices, faces = mesh.icosphere(20)
    both = trimesh.Trimesh(np.concatenate([vertices, vertices + 5]),
                           np.concatenate([faces, faces + len(vertices)]), process=False)
    both.export(tmp_path / f"two{kind}")
    found, found_faces = mesh_files.read(tmp_path / f"two{kind}")
    assert found.shape == (24, 3) and found_faces.shape == (40, 3)
    assert (mesh.edge_faces(found_faces) >= 0).all()
    area = np.linalg.norm(mesh.area_vectors(found, found_faces), axis=1).sum()
    assert area == pytest.approx(np.linalg.norm(mesh.area_vectors(
        both.vertices, both.faces), axis=1).sum(), rel=1e-5)


def test_polygons_are_cut_and_what_adds_nothing_is_left_out(file):
    """A quad becomes one triangle; a face that is there twice, or has two corners in one place,
    stops a lab; or materials cut the surface apart.
    """
    path = file("a.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 2 0\nv 9 9 9\n"
                "v 0 0 -0\nusemtl red\nf 1/1 2/2 3/3 4/4\nusemtl blue\nf 3 5 4\nf 4 3 5\nf 1 7 2\n")
    vertices, faces = mesh_files.read(path)
    assert vertices.shape == (5, 3) and faces.shape == (3, 3)
    assert mesh.area_vectors(vertices, faces).sum(0) / 2 == pytest.approx([0, 0, 1.5])
    assert len(mesh.boundary_edges(faces)) == 5


@pytest.mark.parametrize(("scene", "name", "text", "sentence"), [
    ("bunny", "a.fbx", "x", "expected a file with the ending .obj, .ply, .stl, .off"),
    ("bunny", "a.obj", TRIANGLE, "a mesh needs at least one face, got none"),
    ("bunny", "a.obj", TRIANGLE + "f 1 2 9", "broken, cut short or something else"),
    ("bunny", "a.obj", TRIANGLE + "f 1 2 2", "no face has three different corners"),
    ("bunny", "a.obj", "v 0 0 nan\n" + TRIANGLE + "f 1 2 3", "vertices must be finite"),
    ("bunny", "a.ply", "ply\nformat ascii 1.0\nelement vertex 9\n", "broken, cut short"),
    ("rounded", "a.obj", TRIANGLE + "v 0 0 1\nv 0 0 -1\nf 1 2 3\nf 1 2 4\nf 2 1 5",
     "has 3 faces at the edge from [0.0, 0.0, 0.0] to [1.0, 0.0, 0.0], and this scene takes two"),
    ("aliasing", "a.png", "x", "as a picture: it is broken")])
def test_what_no_scene_can_take_is_told_in_one_sentence(file, scene, name, text, sentence):
    """A traceback of a parser, or a picture of nothing."""
    path = file(name, text)
    with pytest.raises(ValueError, match=r"^[^\n]*$") as told:
        demo.run([scene, str(path)])
    assert sentence in str(told.value) and str(path) in str(told.value)


def test_a_mesh_of_any_size_and_place_fills_the_picture(file):
    """It is out of the camera's sight, or its squares overflow; or a scene computes for hours."""
    for scale, place in (1e200, 0.0), (1e-200, 0.0), (1.0, 1e6):
        path = file("a.obj", "".join(f"v {x * scale + place!r} {y * scale!r} 0\n"
                                     for x, y in ((0, 0), (0, 4), (3, 0))) + "f 1 2 3")
        vertices, _ = own.shape(path, most=1)
        np.testing.assert_allclose(
            vertices, [[-0.6, -0.8, 0], [-0.6, 0.8, 0], [0.6, -0.8, 0]], atol=1e-9)
    with pytest.raises(ValueError, match="has 1 faces, and this scene takes 0 at most"):
        own.shape(path, most=0)


def test_many_faces_are_rounded_as_few_are(monkeypatch):
    """The matrix has the other weights of Loop, or another order of faces."""
    labs, ball = Labs("reference"), mesh.icosphere(20)
    by_points = levels.loop_step(labs, *ball)
    monkeypatch.setattr(levels, "MOST_BY_POINTS", 0)
    assert_close(levels.loop_step(labs, *ball), by_points, atol=1e-12)


@pytest.mark.parametrize(("mode", "seen"), [("L", 90), ("RGB", 90), ("LA", 196), ("P", 90)])
def test_a_photo_is_light_whatever_its_kind(tmp_path, mode, seen):
    """What is transparent is black, or colours are mixed as encoded: 173 in place of 196."""
    picture = Image.new("L", (40, 50), 90)
    if mode == "LA":
        picture.putalpha(127)
    picture.convert(mode).save(tmp_path / "a.png")
    light = own.photo(tmp_path / "a.png")
    assert light.shape == (50, 40, 3)
    np.testing.assert_allclose(255 * image.to_srgb(light), seen, atol=0.5)


def test_of_a_large_photo_the_middle_is_taken_and_a_tiny_one_refused(tmp_path):
    """A spectrum that takes all memory; or one of a single pixel."""
    columns = np.broadcast_to(np.arange(2000) / 2000, (40, 2000))
    image.write(tmp_path / "a.png", columns)
    light = own.photo(tmp_path / "a.png")
    assert light.shape == (40, own.MOST, 3)
    np.testing.assert_allclose(image.to_srgb(light)[0, [0, -1], 0], [0.116, 0.884], atol=0.003)
    image.write(tmp_path / "a.png", np.zeros((1, 1)))
    with pytest.raises(ValueError, match="has 1 x 1 pixels, and this scene needs 32 x 32"):
        own.photo(tmp_path / "a.png")


def test_each_scene_draws_ones_own_beside_the_course_s_pictures(tmp_path, monkeypatch, capsys):
    """A scene takes the file and draws the bunny, writes over its pictures, or stops at a mesh with
    a hole, two parts that touch in a point, and one face.
    """
    monkeypatch.setattr(places, "ROOT", tmp_path)
    (tmp_path / "bow.obj").write_text(TRIANGLE + "v -1 0 0\nv 0 -1 .3\nf 1 2 3\nf 1 4 5\n")
    image.write(tmp_path / "photo.png", np.eye(40))
    scenes = [name for name in demo.TAKES if name != "aliasing"]
    wanted = [word for name in scenes for word in (name, str(tmp_path / "bow.obj"))]
    assert demo.run([*wanted, "aliasing", str(tmp_path / "photo.png")], "reference") == 0
    made = {path.relative_to(tmp_path).parent.as_posix()
            for path in (tmp_path / "out").rglob("*.png")}
    assert made == {"out/demo/aliasing/photo", *(f"out/demo/{name}/bow" for name in scenes)}
    printed = capsys.readouterr().out
    assert "read 5 vertices, 2 faces" in printed and "40 x 40 pixels" in printed
    assert (image.read(tmp_path / "out/demo/aliasing/photo/whole.png")[..., 0] == np.eye(40)).all()


@pytest.mark.parametrize(("names", "sentence"), [
    (["shadow", "cow.obj"], "cow.obj does not follow a scene that takes a file: write it after"),
    (["cow.obj"], "cow.obj does not follow a scene"),
    (["bunny", "cow.obj", "calf.obj"], "calf.obj does not follow a scene"),
    (["bunny", "teapto"], "there is no scene teapto: choose from bunny, ties")])
def test_a_file_stands_after_a_scene_that_takes_one(names, sentence):
    """It is silently ignored, and the bunny comes out; or a misspelt scene is taken for a file."""
    with pytest.raises(ValueError, match=sentence):
        demo.run(names)


def test_a_demo_tells_each_step_as_it_comes(monkeypatch):
    """Into a file or a pipe it prints nothing until the end, or cuts the names of pictures."""
    pipe, name = io.BytesIO(), f"{120 * 'a'}.png"

    def scene(labs):
        """A scene."""
        assert b"scene: A scene." in pipe.getvalue()
        yield "a step", places.out("demo", name)
        assert name in pipe.getvalue().decode()

    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(pipe))
    monkeypatch.setattr(demo, "SCENES", ("scene",))
    monkeypatch.setattr(demo, "scene", lambda _: scene)
    assert demo.run(["scene"], "reference") == 0 and name in pipe.getvalue().decode()


@pytest.mark.parametrize(("text", "said"), [
    ("x = 1\ndef (:\n", "/transforms.py, line 2: this is not Python"),
    ("\0", "imports, cannot be imported: source code string cannot contain null bytes"),
    ("import tinycudann", "imports, cannot be imported: No module named 'tinycudann'"),
    ("from . import nothing", "cannot import name 'nothing'"),
    ("from .nothing import x", "/nothing.py is not in this copy of the course")])
def test_a_lab_that_cannot_be_imported_is_named(text, said, tmp_path, monkeypatch):
    """The student looks for the mistake in the file that imports it; or all ends in a traceback."""
    shutil.copytree(places.ROOT / "reference", tmp_path, dirs_exist_ok=True)
    (tmp_path / "transforms.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path.parent)
    with pytest.raises(Lacking) as told:
        demo.run(["bunny"], tmp_path.name)
    assert said in str(told.value)


def test_the_ten_lines_draw_a_mesh_where_they_stand():
    """Somebody copies them from lecture 00 into a file, and they fail, or draw nothing."""
    cells = exercises.cells(places.ROOT / "notebooks" / "00_start_here.ipynb", "code")
    (lines,) = (cell for cell in cells if "mesh_files.read" in cell)
    assert sum(line.startswith("    ") for line in lines.splitlines()) == 10
    path = places.out("teapot.png")
    path.unlink(missing_ok=True)
    subprocess.run([sys.executable, "-c", lines], cwd=places.ROOT, check=True)
    drawn = (image.read(path) != 1).any(-1)
    assert drawn.shape == (450, 900) and 0.15 < drawn.mean() < 0.5
