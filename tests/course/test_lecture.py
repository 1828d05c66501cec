"""The beginning of a lecture: what a real kernel prints where labs are not finished."""
import base64
import io
import os
import re

import matplotlib.pyplot as plt
import nbformat
import numpy as np
import pytest
from jupyter_client import AsyncKernelManager
from made_up import exercise_text
from nbclient import NotebookClient
from PIL import Image, ImageSequence

from course.given import lecture
from labkit.upkeep.notebooks import KERNEL_ENVIRONMENT, ThisInterpreter

OUTLINES = exercise_text("8.4", "width", "How wide is it?", "return x / 2", points=2)
RASTERIZATION = exercise_text("2.1", "edge", "On which side is it?",
                              'raise NotImplementedError("exercise 2.1: edge")', points=2)
ANTIALIASING = "".join((
    "from .outlines import width\nfrom .rasterization import edge\n",
    exercise_text("8.1", "area", "How large is it?", 'raise ValueError(f"no area for {x}")',
                  points=2),
    exercise_text("8.7", "crossing", "Where does it cross?",
                  'raise NotImplementedError("exercise 8.7: crossing")', points=3),
    exercise_text("8.8", "blend", 'Raise NotImplementedError("exercise 8.7: crossing")?',
                  'raise NotImplementedError("exercise 8.8: blend")', points=3),
    exercise_text("8.9", "misspelt", "A name that waits in the lecture is a mistake here.",
                  "return picture"),
    """

def not_handled(x):
    raise NotImplementedError("x must be positive")


def rendered(x):
    return [crossing(width(x)) for _ in range(3)]
"""))
CELLS = {  # each runs after those before it, in one kernel
    "all done": 'import sys; sys.path.append("..")  # finds the course from notebooks/\n'
                "from labs import outlines\nfrom course.given import lecture, plot\n\n"
                "lecture.begin()",
    "not all done": "from labs import antialiasing\nimport matplotlib.pyplot as plt\n"
                    "lecture.begin()",
    "made at first": "picture = 7\nfor k in range(3): pass\ntotal = k",
    "waits": "from fractions import Fraction\n"
             "import labs\n"
             "plt.subplots()\n"
             "print('so far')\n"
             "def halved(x): return Fraction(x, 2)\n"
             "sizes = [k for k in range(3)]\n"
             "with plt.rc_context():\n"
             "    picture, (_, *rest) = labs.antialiasing.rendered(4)\n"
             "def doubled(x): return 2 * x",
    "waits, too": "plt.subplots()\nprint(picture)",
    "waits for a function": "double = doubled(3)",
    "waits for one that waits, too": "triple = double + 1",
    "goes on": "print(halved(3), k, total, outlines.width(3))",
    "waits for another": "picture = antialiasing.blend(3)",
    "waits for the other": "import numpy as np; np.array([picture])",
    "figures": "plt.figure(figsize=(1, 1));"}
WRONG = {  # its source, the error, the line that is shown
    "typo": ("pictures = 1\npictrue", "NameError", "pictrue"),
    "typo in a function": ("def shown():\n    return picture\n    picture = 1\nshown()",
                           "UnboundLocalError", "return picture"),
    "mistake in an exercise": ("antialiasing.area(3)", "ValueError",
                               'raise ValueError(f"no area for {x}")'),
    "name in an exercise": ("antialiasing.misspelt(3)", "NameError", "return picture"),
    "not handled": ("antialiasing.not_handled(3)", "NotImplementedError",
                    'raise NotImplementedError("x must be positive")')}


@pytest.fixture(scope="module")
def outputs(house):
    """Name -> outputs of a cell. CellExecutionError: one of CELLS stops Jupyter from going on."""
    root = house({"labs/__init__.py": "", "labs/outlines.py": OUTLINES,
                  "labs/rasterization.py": RASTERIZATION, "labs/antialiasing.py": ANTIALIASING})
    (root / "notebooks").mkdir()
    cells = {name: nbformat.v4.new_code_cell(source) for name, source in CELLS.items()}
    for name, (source, *_) in WRONG.items():
        expected = {"tags": ["raises-exception"]}
        cells[name] = nbformat.v4.new_code_cell(source, metadata=expected)
    run(nbformat.v4.new_notebook(cells=[*cells.values()]), root)
    return {name: cell.outputs for name, cell in cells.items()}


def run(notebook, root):
    """As Jupyter does: from the folder notebooks/, each cell cleared before it runs."""
    manager = AsyncKernelManager(kernel_spec_manager=ThisInterpreter())
    environment = {**os.environ, **KERNEL_ENVIRONMENT, "IPYTHONDIR": str(root / "settings")}
    client = NotebookClient(notebook, km=manager, timeout=60, coalesce_streams=True)
    client.execute(cwd=str(root / "notebooks"), env=environment, cleanup_kc=True)


def printed(outputs):
    """The text on stdout, which is all that there is."""
    assert all(output.get("name") == "stdout" for output in outputs), outputs
    return "".join(output.text for output in outputs)


WAITS = "This cell waits for exercise {}, in labs/antialiasing.py: write it, restart the kernel " \
        "and run all cells.\n"
WAITS_TOO = "This cell waits, too, for exercise {}: it uses `{}`, which is made above.\n"


@pytest.mark.parametrize(("cell", "text"), [
    ("all done", ""), ("goes on", "3/2 2 2 1.5\n"),
    ("not all done", "Still to be written: 8.7, 8.8 in labs/antialiasing.py.\n"
                     "A cell that needs what is missing waits and says so.\n"),
    ("waits", "so far\n" + WAITS.format("8.7, crossing")),
    ("waits, too", WAITS_TOO.format("8.7", "picture")),
    ("waits for a function", WAITS_TOO.format("8.7", "doubled")),
    ("waits for one that waits, too", WAITS_TOO.format("8.7", "double")),
    ("waits for another", WAITS.format("8.8, blend")),
    ("waits for the other", WAITS_TOO.format("8.8", "picture"))])
def test_a_cell_says_which_unwritten_exercise_it_waits_for(outputs, cell, text):
    """A page of the finished course that speaks to students; an exercise that is written, or one of
    another module, or the one that calls it, or the first that a name has waited for, for ever; a
    NameError that sends a student to look for a typo; a picture of the value before; the empty axes
    of half a figure. Imports and functions of a cell that waits are lost.
    """
    assert printed(outputs[cell]) == text


def test_figures_of_cells_that_waited_do_not_come_later(outputs):
    """Figures that are hidden, and shown below the next cell that draws."""
    assert [output.output_type for output in outputs["figures"]] == ["display_data"]


@pytest.mark.parametrize("cell", WRONG)
def test_a_mistake_keeps_its_traceback(outputs, cell):
    """A student's mistake that looks like something to wait for."""
    _, error, line = WRONG[cell]
    shown, = outputs[cell]
    assert shown.output_type == "error" and shown.ename == error
    text = "\n".join(shown.traceback)
    assert line in re.sub(r"\x1b\[[\d;]*m", "", text)


# The pictures that a lecture came with

FRAMES = np.random.default_rng(1).integers(0, 256, (3, 8, 8, 3), np.uint8)


def shown(*frames, palette=True, **words):
    """An output with a picture, or with a film."""
    sheet = Image.fromarray(np.concatenate(frames))
    sheet = sheet.quantize() if palette else sheet
    first, *more = (sheet.crop((0, 8 * k, 8, 8 * k + 8)) for k in range(len(frames)))
    content = io.BytesIO()
    first.save(content, "PNG", save_all=bool(more), append_images=more)
    data = {"image/png": base64.b64encode(content.getvalue()).decode()}
    return nbformat.v4.new_output("display_data", data, metadata={"image/png": words})


def frames_of(output):
    content = io.BytesIO(base64.b64decode(output.data["image/png"]))
    frames = ImageSequence.Iterator(Image.open(content))
    return np.array([frame.convert("RGB") for frame in frames], float)


@pytest.fixture(scope="module")
def shown_again(house):
    """The outputs of a lecture as it came, run, run without out/, and run when it was emptied."""
    root = house({"labs/__init__.py": "", "labs/rasterization.py": RASTERIZATION})
    path = root / "notebooks" / "02_rasterization.ipynb"
    path.parent.mkdir()
    sources = [CELLS["all done"].replace("outlines", "rasterization"), "p = rasterization.edge(1)",
               "print(p)", "p + 1"]
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    cells[1].outputs = [shown(FRAMES[0], alt="a picture"), shown(*FRAMES, alt="a film", width=8)]
    cells[2].outputs = [shown(FRAMES[1], palette=False, alt="many colours")]
    cells[3].outputs = [shown(FRAMES[2])]  # a student's, as Jupyter draws it
    notebook = nbformat.v4.new_notebook(cells=cells)
    states = []
    for is_emptied in (False, False, True):
        states.append([list(cell.outputs) for cell in cells])
        if len(states) == 2:
            (root / "out" / "pictures.json").unlink()
        if is_emptied:
            for cell in cells:
                cell.outputs = []
        nbformat.write(notebook, path)
        run(notebook, root)
    return [*states, [list(cell.outputs) for cell in cells]]


def test_a_waiting_cell_shows_the_picture_it_came_with_pale(shown_again):
    """A lecture without pictures, saved by Jupyter; a film that is one frame; the words for those
    who do not see it lost; a student's own picture that is called the reference's.
    """
    came, once, *_ = ([output for outputs in state[1:] for output in outputs
                       if "data" in output] for state in shown_again)
    assert [output.metadata["image/png"] for output in once] == [
        {"alt": "a picture"}, {"alt": "a film", "width": 8}, {"alt": "many colours"}]
    for new, old in zip(once, came, strict=False):
        assert np.allclose(255 - frames_of(new), (255 - frames_of(old)) * 6 / 17, atol=1)
    assert len(frames_of(once[1])) == 3
    assert printed(shown_again[1][1][:1]).endswith(
        "The pale picture was drawn with the reference. Yours comes after 2.1.\n")
    assert "reference" not in printed(shown_again[1][3])


def test_a_pale_picture_stays_as_it_is(shown_again):
    """Paler with each run, where out/ has been deleted; gone for good after an error, for which
    Jupyter empties the cells below.
    """
    _, once, twice, after_an_error = shown_again
    assert once == twice == after_an_error


def test_outside_of_jupyter_only_the_style_is_set(capsys):
    """A lecture that is run as a script fails at its first cell, or speaks of labs."""
    with plt.rc_context({"figure.figsize": (1, 1)}):
        lecture.begin()
        assert plt.rcParams["figure.figsize"] != [1, 1]
    assert capsys.readouterr() == ("", "")
