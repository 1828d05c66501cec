"""Backward passes that try functions out, where the course's own answer is derived.

The forward pass of halve_backward is halve. An answer that calls it in a loop, in a function inside
itself or twice, or that hands it or any other function on as a value, may take differences in the
place of a derivative. So may a helper that does this, and what leads to the forward pass is taken
for it: helpers, aliases, tables, classes. What the reference does as well is no sign.

Not found: a single call with all steps in an array or in complex numbers, a helper in another lab,
and in a loop, a forward pass that is written out again.
"""
import ast
import collections
import functools
import re
from typing import NamedTuple

from ... import exercises
from .similarity import bound

BACKWARD = re.compile(r"_(backward|jacobian|slope)(?=_|$)")
FUNCTION = ast.FunctionDef, ast.AsyncFunctionDef
WHOLE = *FUNCTION, ast.ClassDef
IMPORT = ast.Import, ast.ImportFrom
AGAIN = (*WHOLE, ast.Lambda, ast.For, ast.AsyncFor, ast.While, ast.ListComp, ast.SetComp,
         ast.DictComp, ast.GeneratorExp)


class Module(NamedTuple):
    """A module's statements, by their numbers, and the names that lead from one to another."""

    statements: list
    binds: list      # of each statement, the names that it binds
    uses: list       # and those that it uses
    binders: dict    # {name: the statements that bind it}
    users: dict      # {name: the statements that use it}
    functions: set   # the names of functions, wherever they stand


def backward_passes(tree, topic, asked):
    """Yield (line, exercise) of those that try functions out, in a module's tree."""
    module, seen = module_of(tree), set()
    for exercise in asked:
        stem = BACKWARD.sub("", exercise.name)
        if stem != exercise.name:
            forward = frozenset({stem, stem.removesuffix("_loop"), stem.removesuffix("s")})
            found = trials(module, forward, reached(module, exercise.name))
            lines = {line for number, line in found
                     if not module.binds[number] & usual(topic, forward)} - seen
            seen |= lines
            if lines:
                yield min(lines), exercise


@functools.cache
def usual(topic, forward):
    """The names of what tries functions out in the reference itself."""
    module = module_of(ast.parse(exercises.read(exercises.reference(topic))))
    found = trials(module, forward, range(len(module.statements)))
    return set().union(*(module.binds[number] for number, _ in found))


# --- what leads where -------------------------------------------------------------------------


def module_of(tree):
    assigned = set().union(*(bound(statement) for statement in tree.body
                             if not isinstance(statement, (*WHOLE, *IMPORT))))
    binds = [names_bound(statement, assigned) for statement in tree.body]
    uses = [names_used(statement) for statement in tree.body]
    return Module(tree.body, binds, uses, holders(binds), holders(uses), functions_in(tree))


def holders(sets):
    """{name: the numbers of the sets that have it}."""
    found = collections.defaultdict(list)
    for number, names in enumerate(sets):
        for name in names:
            found[name].append(number)
    return found


def names_bound(statement, assigned):
    """The names to which a statement may give something: all its names that are assigned."""
    if isinstance(statement, WHOLE):
        return {statement.name}
    if isinstance(statement, IMPORT):
        return {(alias.asname or alias.name).partition(".")[0] for alias in statement.names}
    return assigned & {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}


def functions_in(tree):
    """The names that a tree gives to functions."""
    return {node.name for node in ast.walk(tree) if isinstance(node, FUNCTION)} | {
        name for node in ast.walk(tree) if isinstance(node, ast.Assign)
        and isinstance(node.value, ast.Lambda) for target in node.targets for name in bound(target)}


def names_used(statement):
    """The names of a module, or of another one, that a statement uses."""
    local = local_names(statement)
    return {name_of(node, local) for node in ast.walk(statement)} - {None}


def local_names(statement):
    """The names that mean something of a function's own in it; in a default, none does."""
    if not isinstance(statement, FUNCTION):
        return set()
    defaults = [*statement.args.defaults, *filter(None, statement.args.kw_defaults)]
    return bound(statement) - {statement.name} - {
        node.id for default in defaults for node in ast.walk(default) if isinstance(node, ast.Name)}


def name_of(node, local):
    """The name of a module, or of another one, that a node is. None: it is none."""
    if isinstance(node, ast.Name):
        return node.id if node.id not in local else None
    if isinstance(node, ast.Attribute):
        whole = node.value.value if isinstance(node.value, ast.Attribute) else node.value
        return node.attr if isinstance(whole, ast.Name) and whole.id not in local else None
    return node.name if isinstance(node, ast.alias) else None


def reached(module, name):
    """The statements to which a name leads."""
    return follow({name}, module.binders, module.uses)[0]


def leading(module, forward):
    """The names that lead to a forward pass, its own included."""
    return follow(forward, module.users, module.binds)[1]


def follow(names, statements, further):
    """From names to their statements, to further names, and so on -> (statements, names)."""
    seen, found, ends = set(), set(names), [*names]
    while ends:
        for number in set(statements.get(ends.pop(), ())) - seen:
            seen.add(number)
            ends += further[number] - found
            found |= further[number]
    return seen, found


# --- what tries functions out -----------------------------------------------------------------


def trials(module, forward, numbers):
    """Yield (number, line) where these statements try functions out."""
    leads = leading(module, forward)
    for number in numbers:
        if not isinstance(module.statements[number], IMPORT):
            for line in tried(module.statements[number], leads, module.functions,
                              calls_itself(module, number)):
                yield number, line


def calls_itself(module, number):
    """Whether a statement uses what it binds, or what uses that."""
    own = module.binds[number]
    return any(own & ({name} | module.uses[other]) for name in module.uses[number]
               for other in module.binders.get(name, ()))


def tried(statement, leads, functions, again):
    """Yield the lines where a statement calls what leads to a forward pass again, or hands it on.

    again: whether all of the statement may run again and again.
    """
    local = local_names(statement) - functions_in(statement)
    ends, calls = [(part, again) for part in ast.iter_child_nodes(statement)], 0
    while ends:
        node, again = ends.pop()
        called = name_of(node.func, local) if isinstance(node, ast.Call) else None
        calls += called in leads
        tries = called in leads and (again or calls > 1)
        is_given = is_value(node) and name_of(node, local) in leads | functions
        if tries or is_given or hands_lambda(node):
            yield node.lineno
        ends += parts(node, again, called in leads | functions)


def is_value(node):
    """Whether a node is a name that is read or, in an import, changed."""
    return (isinstance(getattr(node, "ctx", None), ast.Load)
            or (isinstance(node, ast.alias) and node.asname is not None))


def hands_lambda(node):
    """Whether a node is a call that is given a lambda, but for a key to sort by."""
    return isinstance(node, ast.Call) and any(isinstance(part, ast.Lambda) for part in (
        *node.args, *(one.value for one in node.keywords if one.arg != "key")))


def parts(node, again, is_known):
    """Yield (part, whether it may run again) of a node, without the name of a known function."""
    once = getattr(node, "generators", [getattr(node, "iter", None)])[0]
    for part in ast.iter_child_nodes(node):
        if not (is_known and part is node.func):
            yield part, again or (isinstance(node, AGAIN) and part is not once)
