"""What students get: the labs, their checks and lectures, and no solution but those released.

What a lab needs from labs that are not handed out comes with it, complete: it is given code there.
"""
import ast
import functools
import itertools
import json
import re
import textwrap
from pathlib import Path

from ... import exercises, lab_text, places
from ...table import COMPLETE, HANDED_OUT, README, USED, WITH_LABS
from . import archives

WHOLE = ("labs.toml", "labs/__init__.py", "labkit/*.py", "labkit/checks/*.py", "labkit/upkeep/*.py",
         *(f"labkit/grading/{name}.py" for name in (  # what packs
             "__init__", "handing/__init__", "handing/archives", "handing/contents",
             "handing/pack")),
         "conftest.py", "tests/labs/[!t]*.*",  # what checks share
         "pyproject.toml", *USED, *HANDED_OUT)
TEACHERS = {f"labkit/upkeep/{name}.py" for name in (
    "changes", "mistakes", "mutants", "mutations", "trials")}


def run(folder, labs=None, solutions=None, extra=False, after=None) -> int:
    """Write the hand-out to a folder that is new or empty -> 0. extra: with the extras open.
    after: only what these labs add to a hand-out of those, see `new`.

    ValueError: the folder is not empty, solutions are of a lab that is not handed out, or a lab is
    in the earlier hand-out.
    """
    folder = Path(folder)
    if folder.exists() and any(folder.iterdir()):
        raise ValueError(f"{folder} is not empty: name a new folder for the hand-out")
    asked = exercises.topics_of(labs)
    released = exercises.topics_of(solutions) if solutions else []
    if other := [topic for topic in released if topic not in asked]:
        raise ValueError(f"{other[0]} is not handed out, so its solution cannot be released: name "
                         "in --solutions only labs that are named in --labs")
    content = (new(asked, after, released, extra) if after else dict(files(asked, released, extra)))
    for name, part in content.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        places.write_whole(path, part)
    tell(folder, asked, released, after, content)
    return 0


def tell(folder, asked, released, after, content):
    """Say what was handed out."""
    print(f"{folder}: {', '.join(asked)}; solutions of {', '.join(released) or 'none'}")
    if given := [topic for topic in came_along(asked) if f"labs/{topic}.py" in content]:
        print(f"{', '.join(given)} came along, complete: the labs asked for, or their lectures, "
              "use them")
    if after:
        print(f"students unpack it in their folder of labs {after}: it adds {len(content)} files "
              "there, and replaces none")


def came_along(asked):
    """The topics that these need, and that are not among them: they are handed out complete."""
    return [topic for topic in needed(asked) if topic not in asked]


def new(asked, after, released, extra):
    """{name: bytes} of what topics add to a hand-out of the labs after. None of it is there yet.

    ValueError: a topic is there yet, perhaps complete.
    """
    earlier = exercises.topics_of(after)
    there = dict(files(earlier, [], extra))
    if again := [topic for topic in asked if f"labs/{topic}.py" in there]:
        complete = "" if again[0] in earlier else ", complete, as its labs use it"
        raise ValueError(f"a hand-out of labs {after} has labs/{again[0]}.py already{complete}: "
                         "name in --labs only labs that it does not have")
    return {name: part for name, part in files([*earlier, *asked], released, extra)
            if name not in there}


def release(labs, path) -> int:
    """Write a zip that adds the solutions of labs to a hand-out in whose folder it is unpacked."""
    topics = exercises.topics_of(labs)
    folder = places.ROOT / "reference"
    places.write_whole(path, archives.zipped(
        (f"reference/{name}.py", (folder / f"{name}.py").read_bytes())
        for name in ("__init__", *topics)))
    print(f"{path}: unpack it in the hand-out's folder; it adds the solutions of "
          f"{', '.join(topics)} to reference/")
    return 0


def files(asked, released, extra):
    """Yield (name, bytes) of all that is handed out."""
    patterns = [*WHOLE, *(pattern for topic, pattern in WITH_LABS.items() if topic in asked)]
    patterns += ["reference/__init__.py"] if released else []
    for path in (path for pattern in patterns for path in sorted(places.ROOT.glob(pattern))):
        name = path.relative_to(places.ROOT).as_posix()
        if name not in TEACHERS:
            text = unlinked(exercises.read(path), asked) if path.match("notebooks/*.*") else ""
            yield name, text.encode() or path.read_bytes()
    yield from labs_of(asked, released, extra)
    for topic in came_along(asked):
        path = exercises.reference(topic)
        name = f"labs/{topic}.py" if path.parent.name == "reference" else places.shown_path(path)
        yield name, without_marks(exercises.read(path)).encode("utf-8")
    for path in lectures(asked):
        text = exercises.read(path)
        if not released or not set(needed([], path)) <= set(released):
            text = switched(text)
        yield f"notebooks/{path.name}", unlinked(text, asked).encode()
        for name in re.findall(r'<img src=\\"((?:openings|stills)/[^"\\]+)', text):
            yield from ((f"notebooks/{name}", file.read_bytes()) for file in path.parent.glob(name))
    yield "README.md", readme(asked, released).encode()


def labs_of(asked, released, extra):
    """Yield (name, bytes) of what belongs to each topic that is asked for."""
    for topic in asked:
        text = exercises.read(exercises.reference(topic))
        lab = lab_text.skeleton(text, extra).encode("utf-8")
        yield f"labs/{topic}.py", lab
        yield exercises.handed_out(topic).relative_to(places.ROOT).as_posix(), lab
        if exercises.topic_exercises(topic):
            check = f"tests/labs/test_{topic}.py"
            yield check, (places.ROOT / check).read_bytes()
        if topic in released:
            yield f"reference/{topic}.py", text.encode("utf-8")


def readme(asked, released):
    first = next(exercise for topic in asked for exercise in exercises.topic_exercises(topic)
                 if not exercise.is_extra)

    def listed(topics):
        return ", ".join(f"`{topic}`" for topic in topics)

    labs = itertools.groupby(asked, exercises.lab_number)
    files = [f"    lab {lab:<4}{', '.join(f'{topic}.py' for topic in its)}" for lab, its in labs]
    about = "\n".join(["    the files in labs/", *files])
    if given := came_along(asked):
        about += f"\n\nThey use {listed(given)}, which came along complete and ask nothing."
    now = f"these are {listed(released)}" if released else "there are none"
    text = exercises.read(README).format(
        first=asked[0], lab=str(exercises.lab_number(asked[0])), number=first.number, labs=about,
        released=now)
    return "\n\n".join(part if part.startswith((" ", "#")) else textwrap.fill(
        part, 100, break_on_hyphens=False) for part in text.split("\n\n")) + "\n"


def lectures(topics):
    """The notebooks of the labs of these topics, as far as they are there."""
    return list(dict.fromkeys(page for topic in topics for page in exercises.pages(topic)))


def needed(topics, *more) -> list[str]:
    """The topics that these topics, their lectures and more files need, in the course's order.

    They need all of their labs that has nothing to write: a scene may use it.
    """
    labs = {exercises.lab_number(topic) for topic in topics}
    ends = [*map(exercises.reference, topics), *lectures(topics), *more,
            *(exercises.complete(topic) for topic in exercises.topics()
              if exercises.lab_number(topic) in labs and exercises.complete(topic).exists())]
    seen = exercises.closure(ends, uses)
    return [topic for topic in exercises.topics() if exercises.reference(topic) in seen]


@functools.cache
def uses(path):
    """The files of a topic, or of those that labs and checks use, that a module or a notebook uses.
    """
    topics = places.ROOT / "reference", places.ROOT / COMPLETE
    rooms = *topics, *((places.ROOT / pattern).parent for pattern in USED)
    found = set()
    for node in ast.walk(ast.parse(code_of(path))):
        if isinstance(node, ast.Attribute) and getattr(node.value, "id", None) == "labs":
            found.add(exercises.reference(node.attr))  # labs.pipeline in a scene
        if isinstance(node, ast.ImportFrom):
            folder = path.parents[node.level - 1] if node.level else places.ROOT
            module = folder.joinpath(*(node.module or "").split("."))
            found |= {module.with_suffix(".py"), *(module / f"{name.name}.py"
                                                   for name in node.names)}
    found = {exercises.reference(file.stem) if file.parent in topics else file for file in found}
    return {file for file in found if file.parent in rooms and file.exists()
            and file.stem not in ("demo", "still_life")}  # they take labs when they run


def code_of(path):
    """The text of a module, or of a notebook's code cells without Jupyter's own commands."""
    if path.suffix != ".ipynb":
        return exercises.read(path)
    return re.sub(r"^\s*%.*", "", "\n".join(exercises.cells(path, "code")), flags=re.M)


def without_marks(text):
    """A module whose exercises are given code."""
    lines = exercises.text_lines(text)
    for line, *_ in exercises.marks(text):
        lines[line - 1] = re.sub(r"\s*#[^#\r\n]*(?=[\r\n]*$)", "", lines[line - 1])
    return "".join(lines)


def unlinked(text, asked):
    """A lecture, or a page beside it, whose links to what is not handed out are words alone."""
    there = {path.name for path in [*lectures(asked), *places.ROOT.glob("notebooks/00*")]}
    text = re.sub(r'<a href=\\"\.\./site/[^>]*>(<img [^>]*>)</a>', r"\1", text)
    return re.sub(r"\[([^][]*)\]\((\d\d\w+\.ipynb|\.\./site/README\.md)[^)]*\)",
                  lambda link: link[0] if link[2] in there else link[1], text)


def switched(text):
    """A notebook that imports from labs, and links to labs, where it does so to reference."""
    notebook = json.loads(text)
    for cell in notebook["cells"]:
        pattern, lab = ((r"^from reference import (.*?)(  #.*)?$", r"from labs import \1")
                        if cell["cell_type"] == "code" else (r"\]\(\.\./reference/", "](../labs/"))
        cell["source"] = [re.sub(pattern, lab, line) for line in cell["source"]]
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"
