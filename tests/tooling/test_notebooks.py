"""The lectures are what the command writes, and the command writes nothing that it should not."""
import base64
import contextlib
import io
import json

import nbformat
import numpy as np
import pytest
from PIL import Image

from course.given.places import ROOT
from course.upkeep import comparing, notebooks, origins, pictures

LECTURES = sorted(notebooks.FOLDER.glob("*.ipynb"))


@pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)
def test_a_lecture_was_made_from_this_code(path):
    """Figures and numbers of an older version of the code; an edit that was not executed."""
    assert origins.stale(path) is None


# The first one runs always: it shows the board, which starts in a process of its own.
@pytest.mark.parametrize("path", [LECTURES[0], *[
    pytest.param(path, marks=pytest.mark.weekly) for path in LECTURES[1:]
]], ids=lambda path: path.stem)
def test_a_lecture_is_what_its_code_draws_and_prints(path):
    """Numbers that another NumPy or another processor changes; a random number without a seed."""
    assert comparing.compare(path) == []


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
    "# figure: squares that grow,\n#   faster and faster\n# figure: a diagonal\n# opening\n"
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


def test_a_second_run_writes_the_same_bytes(written, monkeypatch, capsys):
    """Times, random names, sets in another order, settings of the shell that change a picture."""
    before = written.read_bytes()
    monkeypatch.setenv("PYTHONHASHSEED", "5")
    monkeypatch.setenv("MPLBACKEND", "svg")
    monkeypatch.chdir(written.parent)
    assert notebooks.run([written.name]) == 0
    assert written.read_bytes() == before
    assert "unchanged" in capsys.readouterr().out


def test_names_counts_and_metadata_depend_on_the_order_of_cells_only(written, cells):
    """Jupyter's random cell names, counts of a long session, the author's Python version."""
    assert [cell["id"] for cell in cells] == [f"cell-{index:02}" for index in range(6)]
    assert [cell.get("execution_count") for cell in cells] == [None, 1, 2, None, 3, 4]
    folded = {"jupyter": {"source_hidden": True}, "tags": ["hide-input"]}
    assert [cell["metadata"] for cell in cells] == [{}, {}, {}, {}, folded, {}]
    metadata = json.loads(written.read_text(encoding="utf-8"))["metadata"]
    assert metadata.pop("written_with")["numpy"] == np.__version__
    assert "course/given/plot.py" in metadata.pop("made_from")
    assert metadata == {
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"}}


def test_the_file_ends_with_one_line_feed_and_has_no_carriage_return(written):
    """The line ends of the system that wrote it."""
    content = written.read_bytes()
    assert content.endswith(b"}\n") and b"\r" not in content


def test_printed_text_is_one_output_from_the_courses_folder(cells):
    """Text in pieces that depend on the kernel's timing; a run from the caller's folder."""
    output, = cells[2]["outputs"]
    assert sorted(output["text"]) == ["True\n", "a\n", "has\n", "no\n", "order\n", "set\n"]


def test_a_live_cell_is_left_to_the_reader(cells):
    """A slider, which a page cannot show, saved dead."""
    assert cells[3]["outputs"] == [] and cells[3]["source"][0] == "# live\n"


def test_figures_are_whole_pages_and_tell_no_version(cells):
    """Trimmed margins, which give each figure a width of its own; matplotlib's name in the PNG."""
    contents = [base64.b64decode(output["data"]["image/png"]) for output in cells[4]["outputs"]]
    assert len(contents) == 2
    for content, output in zip(contents, cells[4]["outputs"], strict=True):
        assert int.from_bytes(content[16:20], "big") == 1920
        assert output["metadata"]["image/png"]["width"] == 960
        assert b"matplotlib" not in content.lower()


def test_what_is_told_of_a_figure_stands_beside_it(cells):
    """A figure that says nothing to those who do not see it; the text of another one."""
    told = [output["metadata"]["image/png"]["alt"] for output in cells[4]["outputs"]]
    assert told == ["squares that grow, faster and faster", "a diagonal"]


def test_a_lecture_opens_with_the_last_picture_of_the_cell_that_says_so(written, cells):
    """An opening that is not written, or shows another picture."""
    opening, = written.parent.glob("openings/*.png")
    assert opening.stem == written.stem
    assert opening.read_bytes() == base64.b64decode(cells[4]["outputs"][-1]["data"]["image/png"])


# Pictures

def content_of(picture, *more):
    content = io.BytesIO()
    picture.save(content, "PNG", save_all=bool(more), append_images=more, duration=70)
    return content.getvalue()


def pixels_of(content):
    return np.asarray(Image.open(io.BytesIO(content)).convert("RGB")).astype(int)


def drawing():
    """White paper, a grey and a coloured ramp: more than 256 colours, few of them often."""
    pixels = np.full((300, 400, 3), 255, np.uint8)
    pixels[20:60] = np.linspace(0, 255, 400).astype(np.uint8)[None, :, None]
    pixels[100:140, :, 0] = np.linspace(90, 255, 400)
    pixels[100:140, :, 1:] = 60
    return Image.fromarray(pixels)


def test_a_drawing_gets_a_palette_and_stays_the_same_to_the_eye():
    """A posterised picture; white paper that turns bluish; a file three times as large."""
    before = content_of(drawing())
    after, _ = pictures.packed(before)
    assert Image.open(io.BytesIO(after)).mode == "P"
    off = np.abs(pixels_of(after) - pixels_of(before)[8:152]).max(axis=-1)
    assert np.percentile(off, 99.9) <= 3
    assert (pixels_of(after)[60:90] == 255).all()


def test_white_rows_above_and_below_are_cut():
    """A band of empty page above each figure; a picture that is all white, and vanishes."""
    content, size = pictures.packed(content_of(drawing()))
    assert size == (400, 144) and (pixels_of(content)[[0, -1]] == 255).all()
    assert pictures.packed(content_of(Image.new("RGB", (40, 30), "white")))[1] == (40, 30)


@pytest.mark.parametrize("turned", [0, 90])
def test_smooth_light_gets_no_bands(turned):
    """A lit ball of 45 greys: the distance to the original does not see bands."""
    ramp = np.linspace(0, 1, 600)[None, :, None] ** [[[1.0]], [[2.2]], [[0.4]]]
    colours = np.array([[1, 1, 1], [1, 0.5, 0.2], [0.2, 0.6, 1]])[:, None]
    bars = np.rint(255 * ramp * colours).astype(np.uint8)
    before = content_of(Image.fromarray(bars.repeat(120, 0)).rotate(turned, expand=True))
    after = Image.fromarray(pixels_of(pictures.packed(before)[0]).astype(np.uint8)).rotate(-turned,
                                                                                      expand=True)
    for row in (60, 180, 300):
        assert len(np.unique(np.asarray(after)[row], axis=0)) >= 200


def test_a_film_keeps_its_frames_its_times_and_one_palette():
    """Frames that are lost, or flicker because each has colours of its own."""
    frames = [drawing(), drawing().rotate(180), drawing().rotate(90)]
    film, stay = pictures._frames_and_stay(pictures.packed(content_of(frames[0], *frames[1:]))[0])
    assert len(film) == 3 and stay == [70] * 3
    for frame, original in zip(film, frames, strict=True):
        off = np.abs(np.asarray(frame).astype(int) - np.asarray(original))
        assert np.percentile(off, 99.5) <= 12


REFUSED = {
    "fails": (["1", "2\n1 / 0", "3"], "code cell [2] failed with ZeroDivisionError: division by"),
    "warns": (["import warnings; warnings.warn('old name')"], "UserWarning: old name): mend"),
    "address": (["object()"], "code cell [1] prints a memory address"),
    "twice": (["import matplotlib.pyplot as plt\nfigure, _ = plt.subplots()\nfigure"],
              "code cell [1] shows one picture twice: end its last line with a semicolon"),
    "large": (["0", f"print('x' * {notebooks.SIZE_LIMIT})"],
              "would be 2501 kB, and 2500 kB is the limit: draw fewer or smaller pictures, first "
              "in code cell [2], whose outputs are 2500 kB"),
    "wide": (["0", "'" + 87 * "x" + "'"], "code cell [2] has a line of more than 88 letters: 'xxx"),
    "untold": (["from course.given import plot; plot.style(); plot.panels([(8, 8)]);"],
               "code cell [1] shows 1 pictures and tells of 0: write a comment \"# figure: ...\""),
    "small": (["# figure: x\nimport matplotlib.pyplot as plt\nfrom course.given import plot",
               "# figure: x\nplot.style(); plt.subplots(figsize=(3, 3));"],
              "code cell [2] shows a picture of 300 x 300: draw 320 x 200 to 960 x 1600 displayed"),
    "dies": (["import os; os._exit(1)"], "code cell [1] ended the kernel"),
}


@pytest.fixture(scope="module")
def refusals(tmp_path_factory):
    """Name -> the refused notebook's bytes before and after, and the sentence that was printed."""
    folder = tmp_path_factory.mktemp("refused")
    paths = [save(folder / f"{name}.ipynb", *sources) for name, (sources, _) in REFUSED.items()]
    before = {path.stem: path.read_bytes() for path in paths}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        assert notebooks.run(paths) == 1
    said = {line.split(".ipynb")[0]: line for line in printed.getvalue().splitlines()}
    return {path.stem: (before[path.stem], path.read_bytes(), said[path.stem]) for path in paths}


@pytest.mark.parametrize("name", REFUSED)
def test_a_notebook_with_a_defect_is_refused_in_one_sentence(refusals, name):
    """A defect that is saved; a file that a failed run has changed; a sentence without the cell."""
    before, after, sentence = refusals[name]
    assert after == before
    assert sentence.startswith(f"{name}.ipynb") and REFUSED[name][1] in sentence


@pytest.mark.parametrize("kind, content, clause", [
    ("text/plain", "\x1b[31mred", "prints terminal colours"),
    ("text/plain", "10 %\r20 %", "draws a progress bar"),
    ("text/html", f"<b>{ROOT}</b>", "prints the folder of this copy of the course"),
    ("application/vnd.jupyter.widget-view+json", {}, "shows application/vnd.jupyter.widget"),
    ("image/png", "iVBO", "shows 1 pictures and tells of 0"),
])
def test_what_a_page_must_not_show_is_named(kind, content, clause):
    """Colours as garbage, a bar for each step, the author's path, a dead slider, no words."""
    output = nbformat.v4.new_output("display_data", {kind: content})
    objection = notebooks._objection(nbformat.v4.new_code_cell(outputs=[output]))
    assert objection.startswith(clause)


def test_a_notebook_that_does_not_end_is_ended(tmp_path, monkeypatch):
    """An endless loop that holds the whole run. Or a machine that is busy with other things, so
    that nothing happens for a while, ends a notebook that does little."""
    path = save(tmp_path / "endless.ipynb", "import time; time.sleep(2.5)", "while True: pass")
    monkeypatch.setattr(notebooks, "TIME_LIMIT", 2)
    assert comparing.compare(path) == [
        "endless.ipynb, code cell [2] was running when the 2 seconds of a notebook ended: "
        "let it do less"]


def test_a_notebook_that_waits_for_ever_is_ended(tmp_path, monkeypatch):
    """It takes no processor's time, and holds the whole run."""
    path = save(tmp_path / "waits.ipynb", "import time; time.sleep(1000)")
    monkeypatch.setattr(notebooks, "CLOCK", 0.01)
    assert comparing.compare(path) == [
        "waits.ipynb, code cell [1] was running when the 1.8 seconds of a notebook ended: "
        "let it do less, or let nothing else run"]


def test_what_the_author_saves_meanwhile_is_kept(tmp_path, monkeypatch, capsys):
    """An edit made in Jupyter while the notebook ran, overwritten by the older text."""
    async def execute(path):
        path.write_text("edited")
        return b"executed"
    monkeypatch.setattr(notebooks, "execute", execute)
    path = save(tmp_path / "open.ipynb", "1")
    assert notebooks.run([path]) == 1
    assert path.read_text() == "edited"
    assert "open.ipynb was saved while it ran: run the command again" in capsys.readouterr().out


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"nbformat": 3, "worksheets": []}',
                                     '{"nbformat": 4, "cells": [{}]}'])
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


def test_without_a_name_only_what_is_stale_runs(monkeypatch):
    """Minutes for seventeen lectures after a change of one; or one that cannot be made to run."""
    ran = []

    async def run_one(path, free):
        ran.append(path)

    monkeypatch.setattr(notebooks, "_run_one", run_one)
    monkeypatch.setattr(origins, "stale", LECTURES[2:4].__contains__)
    monkeypatch.setattr(notebooks.errata, "write", lambda: None)
    assert notebooks.run([]) == 0 and ran == LECTURES[2:4]
    assert notebooks.run([], everything=True) == 0 and ran[2:] == LECTURES


# The comparison, without a kernel: what a run gives is the written file

def edited(written, tmp_path, monkeypatch, edit):
    """What `compare` says of the written lecture after `edit(notebook)`."""
    async def execute(path):
        return written.read_bytes()
    monkeypatch.setattr(notebooks, "execute", execute)
    notebook = nbformat.read(written, as_version=4)
    edit(notebook)
    path = tmp_path / "copy.ipynb"
    path.write_text(notebooks._text(notebook), encoding="utf-8")
    return comparing.compare(path)


def set_picture(notebook, picture=lambda pixels: pixels):
    """Draw the lecture's curve again, its pixels (H, W, 3) changed by `picture`."""
    data = notebook.cells[4].outputs[0].data
    pixels = np.asarray(pictures.frames(data["image/png"])[0])
    content = io.BytesIO()
    Image.fromarray(picture(pixels)).save(content, "PNG")
    data["image/png"] = base64.b64encode(content.getvalue()).decode()


@pytest.mark.parametrize("edit, difference", [
    (lambda notebook: notebook.cells[1].update(execution_count=9),
     "cell-01 has a name, count, source or metadata that the command does not write"),
    (lambda notebook: notebook.cells[0].update(id="welcome"),
     "cell-00 has a name, count, source or metadata that the command does not write"),
    (lambda notebook: notebook.cells[5].outputs[0].data.update({"text/plain": "3"}),
     "cell-05 prints '2', and the file says '3'"),
    (lambda notebook: notebook.cells[4].outputs.pop(),
     "cell-04 has 2 outputs, and in the file 1 or other ones"),
    (set_picture, "cell-04 draws a picture with other bytes, with the same versions: find what is "
                  "not seeded"),
])
def test_an_edit_by_hand_is_one_difference(written, tmp_path, monkeypatch, edit, difference):
    """A comparison that looks at the text only, or at the pictures only."""
    assert edited(written, tmp_path, monkeypatch, edit) == [f"copy.ipynb: {difference}"]


@pytest.mark.parametrize("edit, changed", [
    (lambda text: text, None),
    (lambda text: text.replace("\n", "\r\n"), None),  # as a checkout on Windows has it
    (lambda text: text[:-1], "this notebook"),
    (lambda text: text.replace("A lecture", "A talk"), "this notebook"),
    (lambda text: text.replace('"written_with"', '"authors"'), "this notebook"),
    (lambda text: text.replace('"made_from"', '"found"'), "this notebook"),
    (lambda text: text.replace('given/data": "', 'given/data": "0'), "course/given/data"),
    (lambda text: text.replace('given/plot.py": "', 'given/plot.py": "0'), "course/given/plot.py"),
    (lambda text: text.replace('given/plot.py": ', 'given/gone.py": '), "course/given/gone.py"),
])
def test_what_changed_since_a_lecture_ran_is_named(written, tmp_path, edit, changed):
    """A lecture that shows the pictures of older code; one that runs again for nothing."""
    path = tmp_path / "07_copy.ipynb"
    path.write_bytes(edit(written.read_text(encoding="utf-8")).encode())
    said = f"{path} was made before a change ({changed}): run python3 -m course notebooks 07"
    assert origins.stale(path) == (said if changed else None)


CODE = 'import os\n\ndef f(x):\n    """Twice x."""\n    return 2 * x  # doubled\n'


@pytest.mark.parametrize("text, same", [
    ("import os  # why\ndef f(x):\n    return 2 * x\n", True),
    (CODE.replace("x.", "x,\n\n    or so."), True),
    (CODE.replace("2 *", "3 *"), False),
    (CODE.replace("f(x)", "f(x=None)"), False),
    (CODE.replace("import os\n", ""), False),
])
def test_comments_and_docstrings_make_no_lecture_stale(text, same):
    """Seventeen lectures run again for a comma; or none for a number."""
    assert (origins._digest_of_module(text) == origins._digest_of_module(CODE)) == same


SAME = [("off by 3e-15 at most", "off by  2e-14 at most"), ("0.25 px", "0.26 px"),
        ("-1e-16", "0.0"), ("100 faces", "101 faces"), ("x = 1234.5", "x = 1245.5")]
OTHER = [("off by 3e-15", "off by 3e-05"), ("0.25 px", "0.27 px"), ("100 faces", "102 faces"),
         ("0.25 px", "0.25 m"), ("x = 1234.5", "x = -1234.5"), ("1 2", "1 2 3"), ("a b", "a c")]


@pytest.mark.parametrize("old, new", SAME + OTHER)
def test_a_number_written_elsewhere_may_be_rounded_otherwise(old, new):
    """A lecture that is wrong on every other processor; a stale number that nobody sees."""
    same = (old, new) in SAME
    assert (comparing.text_difference(old, new, here=False) is None) == same
    assert comparing.text_difference(old, new, here=True) is not None


def from_elsewhere(picture):
    def edit(notebook):
        notebook.metadata.written_with.matplotlib = "3.0"
        set_picture(notebook, picture)
    return edit


@pytest.mark.parametrize("picture, difference", [
    (lambda pixels: pixels, ""),
    (lambda pixels: np.roll(pixels, 1, axis=1), ""),
    (lambda pixels: pixels[1:, :-2], ""),
    (lambda pixels: pixels ^ 1, ""),
    (lambda pixels: pixels[::-1], "differs from the file's by"),
    (lambda pixels: pixels[:, ::-1], "differs from the file's by"),
    (lambda pixels: pixels * 0 + 255, "differs from the file's by"),
    (lambda pixels: pixels[:-3], "draws 1 pictures of"),
], ids=["other bytes", "a pixel aside", "smaller by two", "rounded", "upside down", "mirrored",
        "empty", "smaller by three"])
def test_a_picture_written_elsewhere_may_differ_a_little_and_show_nothing_else(
        written, tmp_path, monkeypatch, picture, difference):
    """A test that fails wherever a font is drawn otherwise; or a limit so wide that another figure
    passes.
    """
    found = edited(written, tmp_path, monkeypatch, from_elsewhere(picture))
    assert [difference in one for one in found] == [True] * bool(difference)


def test_the_commands_own_folder_is_the_courses():
    """A command that writes beside the notebooks that are read."""
    assert notebooks.FOLDER == ROOT / "notebooks"
