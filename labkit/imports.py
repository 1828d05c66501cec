"""What a lab imports: what is there where labs are graded, and what is handed in with it.

Students may put modules of their own beside the labs. Those that labs import, and that these import
in turn, are handed in and graded with them. Each is one file, with a name that no lab has.
"""
import ast
import contextlib
import functools
import re
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

from . import places
from .exercises import TOPICS, WITHOUT_EFFECT
from .table import GIVEN

PACKAGE = "labs"
GIVEN_PACKAGES = {".".join(name.split(".")[:depth])  # those of what is given: course, course.given
            for name in GIVEN for depth in range(1, name.count(".") + 1)}
MOST = 16  # modules of one student's own
MOST_OWN = 1 << 15  # bytes of each: these are sent together
NAME = re.compile(r"(?!__)[a-zA-Z_]\w{0,59}", re.ASCII)
LONGEST_PATH = 100


class Need(NamedTuple):
    """What a module needs. what: "scipy.ndimage", ".norms", which lies beside it, or a file."""

    line: int
    what: str
    at_the_top: bool  # nothing works without it
    is_file: bool = False

    @property
    def shown(self):
        return f"{PACKAGE}{self.what}" if self.what[0] == "." and not self.is_file else self.what


def nodes(text):
    """The nodes of a module's syntax tree, itself the first. [] where the text is not Python."""
    try:
        return list(ast.walk(ast.parse(text)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


@functools.lru_cache(256)
def imports(text: str) -> tuple[Need, ...]:
    """What a module imports."""
    every = nodes(text)
    return tuple(dict.fromkeys(Need(node.lineno, name, node in every[0].body)
                               for node in every for name in imported(node)))


@functools.lru_cache(256)
def pasted(topic: str, text: str) -> tuple[str, ...]:
    """A sentence, or none, on a lab that was pasted below itself: the last functions count."""
    written = [(node.name, len(node.body) > 2 or not isinstance(node.body[-1], ast.Raise))
               for node in nodes(text) if isinstance(node, ast.FunctionDef)]
    names = [name for name, is_it in written if is_it and not dict(written)[name]]
    more = f" and {len(names) - 1} more" * (len(names) > 1)
    return tuple(f"labs/{topic}.py has {name}{more} twice, and the last one counts, which is not "
                 "written: take out what was pasted below" for name in names[:1])


def imported(node):
    """The modules that a node of a syntax tree imports."""
    if isinstance(node, ast.Import):
        names = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom):
        whole = "." * node.level + (node.module or "")
        names = [f"{whole.rstrip('.')}.{alias.name}" for alias in node.names] if whole in (
            ".", PACKAGE, "scipy", *GIVEN_PACKAGES) else [whole]
    else:
        names = []
    return [re.sub(rf"^{PACKAGE}\.", ".", name) for name in names if not name.endswith("*")]


def own_modules(texts: Iterable[str], read: Callable) -> dict[str, str]:
    """{name: text} of the student's modules that these texts import, and that these import in turn.

    read(name) -> the text, or None: there is none. No more than MOST are read.
    """
    found, ends = {}, list(texts)
    while ends:
        beside = {one.what[1:] for one in imports(ends.pop()) if one.what[0] == "."}
        for name in sorted(beside - found.keys() - {*TOPICS}):
            if NAME.fullmatch(name) and len(found) < MOST:
                found[name] = read(name)
                ends.append(found[name] or "")
    return {name: text for name, text in found.items() if text is not None}


def text_in(folder: Path, name: str) -> str | None:
    """The text of a module in a folder, whatever its bytes are. None: there is none."""
    with contextlib.suppress(OSError):
        return (folder / f"{name}.py").read_bytes().decode("utf-8", "replace")


def text_taken(folder: Path, name: str) -> str | None:
    """The text of a student's module. None: there is none, or it cannot be handed in."""
    with contextlib.suppress(OSError, UnicodeDecodeError):
        content = (folder / f"{name}.py").read_bytes()
        return content.decode("utf-8") if len(content) <= MOST_OWN else None


def not_there(topic: str, folder: Path) -> list[tuple[Path, Need]]:
    """What a lab and the student's modules that it imports need, and do not have in grading."""
    lab = text_in(folder, topic) or ""
    texts = {topic: lab} | own_modules([lab], functools.partial(text_taken, folder))
    return [(folder / f"{name}.py", need) for name, text in texts.items()
            for need in (*imports(text), *files(text, folder))
            if need.is_file or not is_there(need.what, topic, texts)]


def is_there(module, topic, own):
    """Is a module there that a lab imports? own: the names of the student's."""
    if module[0] == ".":
        return module[1:] in own or module[1:] in TOPICS[:TOPICS.index(topic)]
    packages = {PACKAGE, "numpy", "scipy", *WITHOUT_EFFECT, *sys.stdlib_module_names}
    return module.partition(".")[0] in packages or module in {*GIVEN_PACKAGES, *GIVEN}


def files(text, folder):
    """Yield the Need of each file that a module names, and that lies beside it or in the course.
    """
    for node in nodes(text):
        name = node.value if isinstance(node, ast.Constant) else None
        if isinstance(name, str) and len(name) < LONGEST_PATH and any(
                (start / name).is_file() for start in (folder, places.ROOT, places.ROOT / PACKAGE)):
            yield Need(node.lineno, name, at_the_top=False, is_file=True)
