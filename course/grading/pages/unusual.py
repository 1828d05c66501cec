"""What a person should look at in a submission: code that reaches outside, files that are equal.

It is no verdict, and takes no points. A lab that is no Python has no signs.
"""
import ast
import functools
import io
import keyword
import re
import tokenize
from collections import defaultdict
from typing import NamedTuple

from ... import exercises, imports
from ..handing.texts import handed_out

OWN_LINES = 10  # that the hand-out lacks, in files that are named because they are equal
REFERENCE = "the reference"  # stands among the students, none of whom has a space in the name
HARMLESS = {
    "__future__", "abc", "bisect", "cmath", "collections", "contextlib", "copy", "dataclasses",
    "decimal", "doctest", "enum", "fractions", "functools", "heapq", "itertools", "labs", "logging",
    "math", "matplotlib", "numbers", "numpy", "operator", "random", "re", "scipy", "statistics",
    "string", "textwrap", "time", "typing", "warnings"}
HIDDEN = {"builtins", "codecs", "ctypes", "ctypeslib", "gc", "importlib", "inspect", "linecache",
          "marshal", "os", "pickle", "subprocess", "sys", "zlib"}  # also as np.lib.npyio.os
BUILT_IN = {"compile", "delattr", "eval", "exec", "getattr", "globals", "locals", "open", "setattr",
            "vars"}
INNER = re.compile(r"(?!__(all|class|doc|init|main|name|new|version)__)__\w+__"
                   r"|(ag|co|cr|f|gi|tb)_(back|builtins|code|consts|frame|globals|locals|next)")
WORDS = tokenize.NAME, tokenize.NUMBER, tokenize.OP


class Sign(NamedTuple):
    """Something unusual in one file of one student's."""

    name: str    # of the lab, or of a module of the student's own
    line: int
    reason: str


def by_student(texts) -> list[tuple[str, list[Sign]]]:
    """[(student, signs)], who has most of them first.

    texts: as `texts.kept` has them. Of a group, give one member.
    """
    found = equal_files(texts)
    for student, files in texts.items():
        for name, text in files.items():
            found[student] += [Sign(name, line, f"uses {word}")
                               for word, line in words(text).items() if word not in usual(name)]
    return sorted(((student, each) for student, each in found.items() if each),
                  key=lambda pair: (-len(pair[1]), pair[0]))


# --- files that are equal ---------------------------------------------------------------------


def equal_files(texts):
    """{student: signs} of files that several have, or the reference, whatever names stand in them.
    """
    topics = set().union(*texts.values()).intersection(exercises.TOPICS)
    ours = {topic: exercises.read(exercises.reference(topic)) for topic in topics}
    holders, found = defaultdict(list), defaultdict(list)
    for student, files in sorted({**texts, REFERENCE: ours}.items()):
        for name, text in files.items():
            lines = statements(text)
            if len({*lines} - given(name)) >= OWN_LINES:
                holders[numbered(lines)].append((student, name))
    for each in holders.values():
        for student, name in each:
            others = ", ".join(other for other, _ in each if other != student)
            if others and student != REFERENCE:
                found[student].append(Sign(name, 1, f"the same file as that of {others}, but for "
                                                    "names, comments and layout"))
    return found


@functools.cache
def given(name):
    """The statements of a lab as it was handed out."""
    return {*statements(handed_out(name))} if name in exercises.TOPICS else set()


def statements(text):
    """The names, numbers and signs of each statement, without texts, comments and layout."""
    lines = [[]]
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.NEWLINE:
                lines.append([])
            elif token.type in WORDS and token.string not in "(,)":  # layout moves these, too
                lines[-1].append(token.string)
    except (tokenize.TokenError, SyntaxError):
        return []
    return [tuple(line) for line in lines if line]


def numbered(lines):
    """Statements one after the other, with the order of names in the place of names."""
    order = {}
    return tuple(word if keyword.iskeyword(word) or not word.isidentifier() else
                 order.setdefault(word, len(order)) for line in lines for word in line)


# --- words that labs do without ---------------------------------------------------------------


@functools.cache
def usual(name):
    """What the reference itself uses."""
    return words(exercises.read(exercises.reference(name))) if name in exercises.TOPICS else {}


def words(text):
    """{what reaches outside of a lab: the first line of it}"""
    nodes = imports.nodes(text)
    modules = {(alias.asname or alias.name).partition(".")[0] for node in nodes
               for alias in getattr(node, "names", ()) if isinstance(alias, ast.alias)}
    lines = {}
    for node in nodes:
        for word in words_of(node, modules):
            lines[word] = min(node.lineno, lines.get(word, node.lineno))
    return lines


def words_of(node, modules):
    """Yield what a node is or names that is seldom used. modules: names that are imported."""
    if isinstance(node, ast.Name) and (node.id in BUILT_IN or INNER.fullmatch(node.id)):
        yield node.id
    if isinstance(node, ast.Attribute) and (node.attr in HIDDEN or INNER.fullmatch(node.attr)):
        yield f".{node.attr}"
    if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and (
            getattr(node.value, "id", None) in modules):
        yield f"{node.value.id}.{node.attr} ="
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and (
            INNER.fullmatch(node.value)):
        yield repr(node.value)
    if isinstance(node, ast.FunctionDef) and node.name == "__getattr__":
        yield "def __getattr__"
    if isinstance(node, ast.Import | ast.ImportFrom):
        yield from (f"import {name}" for name in imported(node) if not is_harmless(name))


def imported(node):
    """The names of what an import takes, each with its module's."""
    module = f"{'.' * node.level}{node.module or ''}." if isinstance(node, ast.ImportFrom) else ""
    return [f"{module}{alias.name}" for alias in node.names]


def is_harmless(name):
    first, *others = name.split(".")
    return not HIDDEN.intersection(others) and (
        first in HARMLESS or not first or name.startswith("course.given."))
