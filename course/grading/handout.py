"""What students get: the labs, their checks and lectures, and no solution but those released."""
import ast
import json
import re
from pathlib import Path

from .. import exercises
from ..given import places
from ..upkeep.skeleton import skeleton
from .grade import topics_of

WHOLE = ("course/**/*.py", "course/**/*.md", "course/given/data/*.ply", "course/checks/hints.json",
         "course/grading/files/*", "tests/conftest.py", "tests/labs/[!t]*.py",  # what checks share
         "tests/golden/*", "LICENSE", "requirements.txt", "pyproject.toml", ".gitattributes",
         ".gitignore")
IMPORT = re.compile(r"^from reference import ([\w, ]+?)(  #.*)?$")
README = """\
# Differentiable rasterization in plain NumPy: the labs

Begin with `notebooks/00_start_here.ipynb`, then open `labs/{first}.py`. An exercise is a
function whose docstring is the question; write its body, then see what is right and what is next:

    python3 -m course check                  all labs
    python3 -m course check {first}       one lab
    python3 -m course check {number}              one exercise

Nothing needs to be installed first but Python 3.11 or newer (on Windows, write `py` for `python3`);
the first start sets up what the course needs. When you are done,

    python3 -m course pack

makes labs.zip, checks what is in it, and prints its hash: hand in that file. Labs are graded with
NumPy, SciPy, Python's own library, and what a lab imports already: import nothing else in them.
{released}"""


def run(folder, labs=None, solutions=None):
    """Write the hand-out to a folder that is new or empty -> 0. ValueError: it is not."""
    folder = Path(folder)
    if folder.exists() and any(folder.iterdir()):
        raise ValueError(f"{folder} is not empty: name a new folder for the hand-out")
    asked = topics_of(labs)
    topics = with_siblings(asked)
    released = topics_of(solutions) if solutions else []
    for name, content in [*files(topics, released)]:  # all of them are there, or none is written
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        places.write_whole(path, content)
    print(f"{folder}: {', '.join(topics)}; solutions of {', '.join(released) or 'none'}")
    if more := [topic for topic in topics if topic not in asked]:
        print(f"{', '.join(more)} was added: the labs asked for import it")
    return 0


def with_siblings(topics):
    """The topics, and those that their modules import."""
    needed, ends = set(topics), list(topics)
    while ends:
        text = exercises.read(exercises.reference(ends.pop()))
        found = {node.module or alias.name for node in ast.walk(ast.parse(text))
                 if isinstance(node, ast.ImportFrom) and node.level == 1 for alias in node.names}
        ends += found - needed
        needed |= found
    return [topic for topic in exercises.topics() if topic in needed]


def files(topics, released):
    """Yield (name, bytes) of all that is handed out."""
    for pattern in WHOLE:
        for path in sorted(places.ROOT.glob(pattern)):
            yield path.relative_to(places.ROOT).as_posix(), path.read_bytes()
    for topic in topics:
        text = exercises.read(exercises.reference(topic))
        yield f"labs/{topic}.py", skeleton(text).encode("utf-8")
        if topic in exercises.asking_topics():
            check = f"tests/labs/test_{topic}.py"
            yield check, (places.ROOT / check).read_bytes()
        if topic in released:
            yield f"reference/{topic}.py", text.encode("utf-8")
    for path in sorted(places.ROOT.glob("notebooks/*.ipynb")):
        topic = path.stem.partition("_")[2]
        if topic in topics or topic == "start_here":
            yield f"notebooks/{path.name}", switched(path.read_text("utf-8"), released).encode()
    first = exercises.topic_exercises(topics[0])[0]
    told = f"\nSolutions: {', '.join(f'`reference/{topic}.py`' for topic in released)}.\n"
    yield "README.md", README.format(first=topics[0], number=first.number,
                                     released=told if released else "").encode()


def switched(text, released):
    """A notebook that imports its modules from labs, those released from reference."""
    notebook = json.loads(text)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["source"] = [line for old in cell["source"]
                              for line in switched_line(old, released)]
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def switched_line(line, released):
    match = IMPORT.match(line.rstrip("\n"))
    if not match:
        return [line]
    names = [name.strip() for name in match[1].split(",")]
    end = "\n" * line.endswith("\n")
    lines = [f"from {package} import {', '.join(found)}" for package, found in (
        ("labs", [name for name in names if name not in released]),
        ("reference", [name for name in names if name in released])) if found]
    return [f"{line}\n" for line in lines[:-1]] + [lines[-1] + end]
