"""What a lecture was made from: must it run again, or would it write what is there already?

A written notebook lists the files of the course that its kernel had loaded, each with a digest, and
beside them digests of the course's data and of the notebook itself. While all of these stay the
same, a run loads the same files and does the same, so it need not be repeated.

A module's digest leaves out comments, docstrings and blank lines. It is made from the text and not
from the syntax tree, which differs between versions of Python. Versions of NumPy and others do not
count either: they differ from machine to machine, and `python3 -m course test --all` runs every
lecture with those that are there.
"""
import ast
import functools
import hashlib
import io
import json
import re
import tokenize

from course.given import places
from course.upkeep import pictures

ITSELF, DATA, ROOMS = "this notebook", "course/given/data", ("course/", "labs/", "reference/")
LIST = re.compile(r'"made_from": (\{[^}]*\})')


def made_from(text, loaded):
    """{name: digest} for a notebook's text and those of the loaded files that are the course's."""
    files = {places.shown_path(file) for file in [pictures.__file__, *loaded]}
    names = {ITSELF, DATA, *(file for file in files if file.startswith(ROOMS))}
    return {name: _digest(name, text) for name in sorted(names)}


def stale(path):
    """Why a lecture must run again, in a sentence. None: it is what this code would write."""
    text = path.read_text(encoding="utf-8")
    found = LIST.search(text)
    known = json.loads(found[1]) if found else {ITSELF: None}
    if changed := [name for name in known if _digest(name, text) != known[name]]:
        named = ", ".join([*changed[:3], *["..."] * (len(changed) > 3)])
        return (f"{places.shown_path(path)} was made before a change ({named}): "
                f"run python3 -m course notebooks {path.stem.partition('_')[0]}")


def _digest(name, text):
    """Eight letters for the notebook's own text, the data or a module. None: it is not there."""
    path = places.ROOT / name
    if name == ITSELF:
        return _short(LIST.sub("", text).encode())
    if name == DATA:
        return _digest_of_folder(path)
    return _digest_of_module(path.read_text(encoding="utf-8")) if path.exists() else None


@functools.cache
def _digest_of_folder(folder):
    files = sorted(path for path in folder.rglob("[!.]*") if path.is_file())
    return _short(b"".join(path.read_bytes() for path in files))


@functools.cache
def _digest_of_module(text):
    lines = text.splitlines()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):  # a docstring
            lines[node.lineno - 1:node.end_lineno] = [""] * (node.end_lineno - node.lineno + 1)
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            row, column = token.start
            lines[row - 1] = lines[row - 1][:column]
    return _short("\n".join(filter(None, map(str.rstrip, lines))).encode())


def _short(content):
    return hashlib.sha256(content).hexdigest()[:8]
