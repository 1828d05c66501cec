"""What a person should look at in a submission: code that reaches outside, files that are equal.

It is no verdict, and takes no points. A lab that is no Python has no signs.
"""
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
HARMLESS = set(
    "__future__ abc bisect cmath collections contextlib copy dataclasses decimal doctest enum "
    "fractions functools heapq itertools labs logging math matplotlib numbers numpy operator "
    "random re scipy statistics string textwrap time typing warnings".split())
REACHES_OUT = set(  # modules also as in np.lib.npyio.os
    "builtins ctypes ctypeslib eval exec gc globals importlib inspect open os subprocess sys"
    .split())
INNER = re.compile(r"__(builtins|code|dict|globals|import|loader|mro|self|spec|subclasses)__"
                   r"|(ag|co|cr|f|gi|tb)_(back|builtins|code|consts|frame|globals|locals|next)")


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
                               for word, line in words(text).items()]
    return sorted(((student, each) for student, each in found.items() if each),
                  key=lambda pair: (-len(pair[1]), pair[0]))


def words(text):
    """{what reaches outside of a lab: the first line of it}"""
    found = {f"import {need.what}": need.line for need in reversed(imports.imports(text))
             if not is_harmless(need.what)}
    for token in tokens(text):
        word = token.string.strip("'\"")
        if INNER.fullmatch(word) or (token.type == tokenize.NAME and word in REACHES_OUT):
            found.setdefault(word, token.start[0])
    return found


def is_harmless(module):
    return module.partition(".")[0] in ("", *HARMLESS) or module.startswith("course.given.")


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
    for token in tokens(text):
        if token.type == tokenize.NEWLINE:
            lines.append([])
        elif token.type in (tokenize.NAME, tokenize.NUMBER, tokenize.OP):
            if token.string not in "(,)":  # an editor moves these, too
                lines[-1].append(token.string)
    return [tuple(line) for line in lines if line]


def numbered(lines):
    """Statements one after the other, with the order of names in the place of names."""
    order = {}
    return tuple(word if keyword.iskeyword(word) or not word.isidentifier() else
                 order.setdefault(word, len(order)) for line in lines for word in line)


def tokens(text):
    """The tokens of a text, up to where it is no Python any more."""
    try:
        yield from tokenize.generate_tokens(io.StringIO(text).readline)
    except (tokenize.TokenError, SyntaxError):
        return
