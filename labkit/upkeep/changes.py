"""Changes: a wrong function, written as what is different from the right one.

    8.2  (wing < 0) == (face < 0) -> (wing < 0) != (face < 0)
          The test is reversed.

    8.2  turned = side[i] * side[j] -> turned = side[i]
    and  face, wing = (area(i, j, p) * turned for p in (own, across))
    ->   face, wing = (area(i, j, p) for p in (own, across))
          Two changes that together make one mistake. A long one goes on below, after the arrow.

    6.3  look_up(texels, index, weight) -> texels[index].sum(1)
          The whole function, with all its parameters, and what it returns instead.

On both sides of the arrow stands an expression, or one or more statements ("a = 1; b = 2").
"pass" on the right takes a statement away, and what stands there twice adds one. Where the left
side is in the function more than once, "(#2)" at the end takes the second place.

All is matched on syntax trees, so that spaces and line ends do not matter.
"""
import ast
import builtins
import copy
import re
import symtable
from typing import NamedTuple

from .. import exercises, places

PLACE = re.compile(r"(.*?)(?: \(#(\d+)\))?")


class Entry(NamedTuple):
    """What a list says: where, of which exercise, the changes, and the words below them."""

    place: str
    number: str
    changes: tuple
    said: str


class Change(NamedTuple):
    """old -> new (#which): lists of statements. which: 0 is the only place."""

    text: str
    old: list
    new: list
    which: int


def entries(path):
    """The Entries of a list, tests/mistakes/<topic>.txt or one like it. [] if there is none.

    Lines before the first entry, and those that begin with #, are not read.
    """
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    found = []
    for count, line in enumerate(text.splitlines(), 1):
        head, _, rest = line.partition(" ")
        if head[:1].isdigit():
            found.append(Entry(f"{places.shown_path(path)}, line {count}", head,
                               (rest.strip(),), ""))
        elif found and line.strip() and not line.startswith("#"):
            found[-1] = with_line(found[-1], head, rest.strip())
    return found


def with_line(entry, head, rest):
    """An Entry with one more line. ValueError: the line is neither a change nor indented words."""
    if head == "and":
        return entry._replace(changes=(*entry.changes, rest))
    if head == "->":
        *before, last = entry.changes
        return entry._replace(changes=(*before, f"{last} -> {rest}"))
    if head:
        raise ValueError(f'{entry.place}: "{head} {rest}" below it is no line of a list; begin it '
                         'with "and" or "->", or indent it if it says what is wrong')
    return entry._replace(said=f"{entry.said} {rest}".strip())


def change(text):
    """The Change that a text writes. ValueError: it is none."""
    try:
        (old, new), which = PLACE.fullmatch(text)[1].split(" -> "), PLACE.fullmatch(text)[2]
        return Change(text, ast.parse(old).body, ast.parse(new).body, int(which or 0))
    except (SyntaxError, ValueError):
        raise ValueError(f'"{text}" is no change; write "old -> new", each of them an expression '
                         "or statements of Python") from None


def found_at(function, wanted):
    """Where a Change's left side stands in a function: [[node, ...]], in the order of the text."""
    old, nodes = wanted.old, list(ast.walk(function))
    if is_whole(old, function):
        return [function.body]
    if is_expression(old) and is_expression(wanted.new):
        groups = [[node] for node in nodes if same(node, old[0].value)]
    else:
        blocks = [value for node in nodes for _, value in ast.iter_fields(node)
                  if isinstance(value, list)]
        windows = [block[k:k + len(old)] for block in blocks for k in range(len(block))]
        groups = [window for window in windows if same(window, old)]
    return sorted(groups, key=lambda group: (group[0].lineno, group[0].col_offset))


def is_whole(old, function):
    """Is this the function itself, with its parameters? Its body is changed then."""
    parameters = ", ".join(parameter.arg for parameter in function.args.args)
    return same(old, ast.parse(f"{function.name}({parameters})").body)


def is_expression(statements):
    return len(statements) == 1 and isinstance(statements[0], ast.Expr)


def same(one, other):
    """Are these the same code? Nodes, or lists of them, or what stands in them."""
    if type(one) is not type(other):
        return False
    if isinstance(one, list):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, ast.AST):
        return all(same(getattr(one, field), getattr(other, field))
                   for field in one._fields if field != "ctx")
    return one == other


class Changed(ast.NodeTransformer):
    """Puts others[node] in the place of a node."""

    def __init__(self, others):
        self.others = others

    def visit(self, node):
        return self.others.pop(node) if node in self.others else self.generic_visit(node)


def changed(function, wanted):
    """The text of a function's node, without its docstring, with Changes made.

    ValueError: the left side of one stands nowhere, or in several places.
    """
    tree, others = copy.deepcopy(function), {}
    tree.body = tree.body[1:]
    for one in wanted:
        nodes, new = the_place(tree, one), one.new
        if nodes is tree.body and is_expression(new):
            new = [ast.Return(new[0].value)]
        elif isinstance(nodes[0], ast.expr):
            new = new[0].value
        others |= {nodes[0]: new} | dict.fromkeys(nodes[1:])
    changer = Changed(others)
    text = ast.unparse(changer.visit(tree))
    if changer.others:
        raise ValueError(f'"{wanted[-1].text}" lies in what another change takes away; '
                         "make them one")
    return text


def the_place(function, wanted):
    """The nodes that a Change means. ValueError: there are none, or too many."""
    found = found_at(function, wanted)
    sought = f'"{ast.unparse(ast.Module(wanted.old, []))}" stands'
    if len(found) < max(1, wanted.which):
        place = f"in less than {wanted.which} places" if wanted.which > 1 else "nowhere"
        raise ValueError(f"{sought} {place} in {function.name}; write what is there")
    if len(found) > 1 and not wanted.which:
        raise ValueError(f"{sought} in {len(found)} places in {function.name}; end the line with "
                         "(#1) for the first, or write more of it")
    return found[max(0, wanted.which - 1)]


def unknown_names(text, module):
    """The names in the text of a function that neither it, its module's text nor Python has."""
    found, tables = set(), [symtable.symtable(text, "a change", "exec")]
    for table in tables:
        tables += table.get_children()
        found |= {*table.get_globals()} if table.get_type() == "function" else set()
    there = symtable.symtable(module, "a module", "exec").get_identifiers()
    return sorted(found - {*there, *dir(builtins)})


# --- all of an exercise -----------------------------------------------------------------------


def function_of(topic, exercise):
    """The node of an exercise in the reference."""
    functions = exercises.top_level_functions(exercises.read(exercises.reference(topic)))
    return next(node for node in functions if node.name == exercise.name)


def wrong_functions(topic, exercise, listed):
    """[the text of the wrong function] of an exercise's Entries. ValueError: one matches nowhere.
    """
    function, texts = function_of(topic, exercise), []
    for entry in listed:
        try:
            texts.append(changed(function, read(entry)))
            if unknown := unknown_names(texts[-1], exercises.read(exercises.reference(topic))):
                raise ValueError(f"{exercise.name} has no variable {unknown[0]}; write its name")
        except ValueError as error:
            raise ValueError(f"{entry.place}: {error}") from None
    return texts


def again(text, entry):
    """[the text of a wrong function with an Entry's changes, too]; [] if they have no place there.
    """
    function = ast.parse(text).body[0]
    function.body.insert(0, None)  # in the place of the docstring
    try:
        return [changed(function, read(entry))]
    except ValueError:
        return []


def read(entry):
    """The Changes of an Entry. ValueError: one of its texts is none."""
    return [change(text) for text in entry.changes]
