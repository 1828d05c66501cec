"""The lectures are what the command writes, and the command writes nothing that it should not."""
import base64
import io
import json

import nbformat
import numpy as np
import pytest
from PIL import Image

from labkit import exercises
from labkit.places import ROOT
from labkit.upkeep import notebooks, outcomes, pictures

LECTURES = sorted(notebooks.FOLDER.glob("*.ipynb"))
LINE_LIMIT = 88                                    # letters of a line of code

each_lecture = pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)


@each_lecture
def test_a_lecture_is_stored_as_the_command_writes_it(path):
    """A cell without a number, a picture that nobody is told of, code of a figure that is shown; a
    page that loads for a minute, or has lines that are cut off.
    """
    cells = nbformat.read(path, as_version=4).cells
    assert cells == notebooks.as_saved(notebooks.parsed(path)).cells
    assert [notebooks.objection_to(cell) for cell in cells if "outputs" in cell and
            notebooks.objection_to(cell)] == []
    assert path.stat().st_size <= notebooks.SIZE_LIMIT
    assert max(len(line) for code in exercises.cells(path, "code")
               for line in code.splitlines()) <= LINE_LIMIT


@pytest.mark.weekly
@each_lecture
def test_a_lecture_says_what_its_code_prints_and_draws(path):
    """A lecture that fails, or shows what older code has drawn; numbers that another NumPy or
    another processor changes; a random number without a seed.
    """
    assert notebooks.remade(path, elsewhere=True)[2] == []


# The command, on notebooks of a few cells

def save(path, *sources):
    """A notebook as Jupyter saves one: with random names, times, versions and outputs."""
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    for number, cell in enumerate(cells):
        cell.execution_count = 7 + number
        cell.metadata = {"execution": {"iopub.execute_input": "2001-01-01T00:00:00Z"}}
        cell.outputs = [nbformat.v4.new_output("stream", text="old\n")]
    cells.insert(0, nbformat.v4.new_markdown_cell("# A lecture"))
    notebook = nbformat.v4.new_notebook(cells=cells)
    notebook.metadata = {"kernelspec": {"name": "another", "display_name": "Another"},
                         "language_info": {"name": "python", "version": "2.7"}}
    nbformat.write(notebook, path)
    return path


LECTURE = (
    "from course.given import plot\n"
    "import numpy as np, os\n"
    "import matplotlib.pyplot as plt\n"
    "plot.style()",
    "for word in {'a', 'set', 'has', 'no', 'order'}:\n"
    "    print(word, flush=True)\n"
    "print(os.path.samefile('course/given/plot.py', plot.__file__))",
    "# live\nimport ipywidgets\nipywidgets.IntSlider()",
    "# figure: squares that grow,\n#   faster and faster\n# figure: a diagonal\n"
    "figure, axes = plt.subplots()\n"
    "axes.plot(np.arange(5) ** 2)\n"
    "plt.show()\n"
    "plot.strip([np.eye(8)], ['eye']);",
    "1 + 1",
)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A lecture that the command has written."""
    path = save(tmp_path_factory.mktemp("lecture") / "03_lecture.ipynb", *LECTURE)
    assert notebooks.run([str(path)]) == 0
    return path


@pytest.fixture
def cells(written):
    return json.loads(written.read_text(encoding="utf-8"))["cells"]


def test_a_second_run_writes_nothing(written, monkeypatch, capsys):
    """Times, random names, sets in another order, settings of the shell that change a picture."""
    before = written.read_bytes()
    monkeypatch.setenv("PYTHONHASHSEED", "5")
    monkeypatch.setenv("MPLBACKEND", "svg")
    monkeypatch.chdir(written.parent)
    assert notebooks.run([written.name]) == 0
    assert written.read_bytes() == before and before.endswith(b"}\n") and b"\r" not in before
    assert "03_lecture.ipynb: nothing has changed" in capsys.readouterr().out


def test_names_counts_and_metadata_depend_on_the_order_of_cells_only(written, cells):
    """Jupyter's random cell names, counts of a long session, the author's Python version."""
    assert [cell["id"] for cell in cells] == [f"cell-{index:02}" for index in range(6)]
    assert [cell.get("execution_count") for cell in cells] == [None, 1, 2, None, 3, 4]
    folded = {"jupyter": {"source_hidden": True}, "tags": ["hide-input"]}
    assert [cell["metadata"] for cell in cells] == [{}, {}, {}, {}, folded, {}]
    assert json.loads(written.read_text(encoding="utf-8"))["metadata"] == {
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"}}


def test_text_is_one_output_from_the_courses_folder_and_a_live_cell_has_none(cells):
    """Text in pieces that depend on the kernel's timing; a slider, saved dead."""
    output, = cells[2]["outputs"]
    assert sorted(output["text"]) == ["True\n", "a\n", "has\n", "no\n", "order\n", "set\n"]
    assert cells[3]["outputs"] == [] and cells[3]["source"][0] == "# live\n"


def test_each_figure_is_a_whole_page_and_told(cells):
    """Trimmed margins, which give each figure a width of its own; matplotlib's name in the PNG; a
    figure that says nothing to those who do not see it.
    """
    shown = [output["data"]["image/png"] for output in cells[4]["outputs"]]
    contents = [base64.b64decode(picture) for picture in shown]
    assert [int.from_bytes(content[16:20], "big") for content in contents] == [1920, 1920]
    assert not any(b"matplotlib" in content.lower() for content in contents)
    metadata = [output["metadata"]["image/png"] for output in cells[4]["outputs"]]
    assert [one["width"] for one in metadata] == [960, 960]
    assert [one["alt"] for one in metadata] == ["squares that grow, faster and faster",
                                                "a diagonal"]


def test_what_only_opens_a_lecture_is_kept_beside_it_and_told_when_it_changes(tmp_path, capsys):
    """The picture of the top a second time, in its cell; an opening that older code has drawn."""
    path = save(tmp_path / "04_lecture.ipynb", LECTURE[0],
                "# opening: a diagonal\nplot.strip([np.eye(8)], ['eye']);")
    for said in "cell-02 has 1 outputs", "nothing has changed":
        assert notebooks.run([str(path)]) == 0 and said in capsys.readouterr().out
    opening = path.parent / "openings" / "04_lecture.png"
    waits = save(tmp_path / "05_lecture.ipynb", "# opening: what waits\nprint('for 1.1')")
    assert notebooks.run([str(waits)]) == 0
    Image.open(opening).transpose(Image.Transpose.FLIP_LEFT_RIGHT).save(opening)
    assert notebooks.run([str(path)]) == 0 and "draws another picture" in capsys.readouterr().out


@pytest.mark.parametrize("sources, told", [
    (["1", "2\n1 / 0", "3"], "code cell [2] failed with ZeroDivisionError: division by zero"),
    (["import os; os._exit(1)"], "code cell [1] ended the kernel"),
    (["import time; time.sleep(2.5)", "while True: pass"],
     "code cell [2] was running when the 2 seconds of a notebook ended: let it do less"),
    (["object()"], "code cell [1] prints a memory address"),
    (["print(50_000 * ('x' * 49 + '\\n'))"], "kB, and the limit is 2500 kB: draw fewer or smaller"),
], ids=["fails", "dies", "does not end", "is refused", "is large"])
def test_a_notebook_with_a_defect_is_refused_in_one_sentence(
        tmp_path, monkeypatch, capsys, sources, told):
    """A defect that is saved; an endless loop that holds the whole run; or a machine that is busy
    with other things, so that nothing happens for a while, ends a notebook that does little.
    """
    monkeypatch.setattr(notebooks, "TIME_LIMIT", 2 if "True" in sources[-1] else 100)
    path = save(tmp_path / "defect.ipynb", *sources)
    before = path.read_bytes()
    assert notebooks.run([path]) == 1
    said = capsys.readouterr().out
    assert said.startswith("defect.ipynb") and told in said
    assert path.read_bytes() == before


PICTURE = {"image/png": "iVBO"}


def shown(content, width=900):
    return nbformat.v4.new_output("display_data", content, metadata={
        "image/png": {"width": width, "height": 300}})


@pytest.mark.parametrize("source, outputs, clause", [
    ("", [nbformat.v4.new_output("stream", name="stderr", text="UserWarning: old\n")],
     "warns on stderr (UserWarning: old)"),
    ("", [shown({"text/plain": "\x1b[31mred"})], "prints terminal colours"),
    ("", [shown({"text/html": f"<b>{ROOT}</b>"})], "prints the folder of this copy of the course"),
    ("", [shown({"application/vnd.jupyter.widget-view+json": {}})], "shows application/vnd.jupyt"),
    ("", [shown(PICTURE)], 'shows 1 pictures and tells of 0: write a comment "# figure: ..." for'),
    ("# figure: a\n# figure: b", 2 * [shown(PICTURE)], "shows one picture twice"),
    ("# figure: a", [shown(PICTURE, 300)], "shows a picture of 300 x 300: draw one that is"),
])
def test_what_a_page_must_not_show_is_named(source, outputs, clause):
    """Colours as garbage, the author's path, a dead slider, no words, pictures like stamps."""
    cell = nbformat.v4.new_code_cell(source, outputs=outputs)
    assert notebooks.objection_to(cell).startswith(clause)


def test_what_the_author_saves_meanwhile_is_kept(tmp_path, monkeypatch, capsys):
    """An edit made in Jupyter while the notebook ran, overwritten by the older text."""
    def executed(path):
        notebook = notebooks.parsed(path)
        path.write_text("edited")
        return notebook, []
    monkeypatch.setattr(notebooks, "executed", executed)
    path = save(tmp_path / "open.ipynb", "1")
    assert notebooks.run([path]) == 1
    assert path.read_text() == "edited"
    assert "open.ipynb was saved while it ran: run the command again" in capsys.readouterr().out


@pytest.mark.parametrize("content", ["", "[]", '{"nbformat": 3}', '{"nbformat": 4, "cells": [{}]}'])
def test_a_file_that_is_no_notebook_is_told_in_one_sentence(tmp_path, content, capsys):
    """A traceback for a file that was cut off, or of an old format."""
    path = tmp_path / "broken.ipynb"
    path.write_text(content)
    assert notebooks.run([path]) == 1
    assert f"{path} is not a notebook of format 4" in capsys.readouterr().out


def test_notebooks_are_found_by_number_topic_and_path(tmp_path, monkeypatch):
    """A number that finds every notebook with that digit; one notebook run twice at a time."""
    for name in "00_start", "01_transforms", "01b_more", "10_ten", "12_one":
        (tmp_path / f"{name}.ipynb").touch()
    monkeypatch.setattr(notebooks, "FOLDER", tmp_path)
    monkeypatch.chdir(tmp_path)

    def found(*names):
        return [path.name for path in notebooks.find(names)]

    assert found("1") == found("01") == found("transforms") == ["01_transforms.ipynb"]
    assert found("1b") == found("01b") == found("more") == ["01b_more.ipynb"]
    assert found("one", "0") == ["12_one.ipynb", "00_start.ipynb"]
    assert found("10", "ten", "10_ten", tmp_path / "10_ten.ipynb") == ["10_ten.ipynb"]
    assert len(found()) == 5
    with pytest.raises(ValueError, match="there is no notebook 2: name one by its number"):
        notebooks.find(["2"])


# Which lectures are older than their code

CODE = 'import os\n\ndef f(x):\n    """Twice x."""\n    return 2 * x  # doubled\n'


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course of two lectures that have run."""
    for name, value in (("ROOT", tmp_path), ("FOLDER", tmp_path),
                        ("RECORD", tmp_path / ".made_from.json"),
                        ("executed", lambda path: (notebooks.parsed(path), [f"{path.stem}.py"]))):
        monkeypatch.setattr(notebooks, name, value)
    monkeypatch.setattr(notebooks.errata, "write", lambda: None)
    for name in "01_one", "02_two":
        save(tmp_path / f"{name}.ipynb", "1 + 1")
        (tmp_path / f"{name}.py").write_text(CODE)
    assert notebooks.run([]) == 0 and notebooks.older() == []
    return tmp_path


@pytest.mark.parametrize("name, old, new, is_older", [
    ("01_one.py", "import os", "import os  # why", False),
    ("01_one.py", "x.", "x,\n\n    or so.", False),
    ("01_one.py", "2 *", "3 *", True),
    ("01_one.py", "x", "y", True),
    ("01_one.ipynb", "A lecture", "A talk", True),
    ("01_one.ipynb", "1 + 1", "1 + 2", True),
])
def test_what_has_changed_since_a_lecture_ran_makes_it_older(course, capsys, name, old, new,
                                                             is_older):
    """Lectures that run again for a comma, or for a change of another one; pictures of older code
    of which nobody knows; a lecture that is older for ever, as its run says what is there.
    """
    path = course / name
    path.write_text(path.read_text().replace(old, new))
    before = {path: path.read_bytes() for path in course.glob("*.ipynb")}
    assert [path.stem for path in notebooks.older()] == ["01_one"] * is_older
    capsys.readouterr()
    assert notebooks.run([]) == 0 and notebooks.older() == []
    assert capsys.readouterr().out.startswith(
        f"older than their code: {'01_one' if is_older else 'none'}\n")
    assert {path: path.read_bytes() for path in course.glob("*.ipynb")} == before


# Two runs that say the same

SAME = [("off by 3e-15 at most", "off by  2e-14 at most"), ("0.25 px", "0.26 px"),
        ("-1e-16", "0.0"), ("error 2e-06", "error 1e-06")]
OTHER = [("off by 3e-15", "off by 3e-05"), ("0.25 px", "0.27 px"), ("100 faces", "101 faces"),
         ("0.25 px", "0.25 m"), ("x = 1234.5", "x = -1234.5"), ("1 2", "1 2 3"), ("a b", "a c")]


@pytest.mark.parametrize("old, new", SAME + OTHER)
def test_a_number_may_be_rounded_otherwise_elsewhere(old, new):
    """A lecture that is wrong on every other processor; a stale number that nobody sees."""
    assert (outcomes.text_difference(old, new, True) is None) == ((old, new) in SAME)
    assert outcomes.text_difference(old, new, False).startswith("prints ")


def figure(pixels, alt="a curve"):
    """The outputs of a cell that draws pixels (H, W, 3)."""
    content = io.BytesIO()
    Image.fromarray(pixels).save(content, "PNG")
    picture = nbformat.v4.new_output("display_data", {
        "image/png": base64.b64encode(content.getvalue()).decode()})
    picture.metadata["image/png"] = {"alt": alt}
    return [picture]


def a_square(pixels):
    pixels = pixels.copy()
    pixels[200:264, 300:364] //= 2
    return pixels


@pytest.mark.parametrize("change, here, elsewhere", [
    (lambda pixels: pixels ^ 1, None, None),
    (lambda pixels: pixels[1:, :-2], "draws 1 pictures of", None),
    (a_square, "draws another picture", None),
    (lambda pixels: pixels[::-1], "draws another picture", "draws another picture"),
    (lambda pixels: pixels[:, ::-1], "draws another picture", "draws another picture"),
    (lambda pixels: pixels * 0 + 255, "draws another picture", "draws another picture"),
    (lambda pixels: pixels[:-3], "draws 1 pictures of", "draws 1 pictures of"),
], ids=["rounded", "smaller by two", "a square", "upside down", "mirrored", "empty",
        "smaller by three"])
def test_a_picture_may_differ_a_little_and_show_nothing_else(cells, change, here, elsewhere):
    """A test that fails wherever a font is drawn otherwise; or a limit so wide that another figure
    passes. On the machine that drew it a single pixel of a figure counts.
    """
    content = base64.b64decode(cells[4]["outputs"][0]["data"]["image/png"])
    pixels = np.asarray(pictures.frames(content)[0][0])
    for told, where in ((here, False), (elsewhere, True)):
        said = outcomes.difference(figure(pixels), figure(change(pixels)), where)
        assert said is told or said.startswith(told)


def test_a_cell_that_says_something_else_is_told(cells):
    """Other words beside a picture; a picture less."""
    grey = np.full((40, 40, 3), 99, np.uint8)
    lacks = "outputs, and the file has 1, or other ones"
    assert outcomes.difference(figure(grey), figure(grey, "a line")) == f"has 1 {lacks}"
    assert outcomes.difference(figure(grey), []) == f"has 0 {lacks}"
    text = nbformat.v4.new_output("stream", text="a 1\nb 2\n")
    other = nbformat.v4.new_output("stream", text="a 1\nb 3\n")
    assert outcomes.difference([text], [other]) == "prints 'b 3', and the file says 'b 2'"
