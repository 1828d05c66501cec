"""Backward passes that try functions out, where the course's own answer is derived.

The forward pass of halve_backward is halve, and what calls it in the reference stands for it. An
answer that calls it in a loop, in a function inside itself or twice, or that hands it or any other
function on, may take differences in the place of a derivative. So may one with a helper, an alias,
a table or a class of the student's own in which the forward pass is named.

Not found: a single call with all steps in an array or in complex numbers, a helper in another lab,
and in a loop, a forward pass that is written out again.
"""
import ast
import collections
import functools
import re

from ... import exercises
from .similarity import bound

BACKWARD = re.compile(r"_(backward|jacobian|slope)(?=_|$)")
WHOLE = ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef
IMPORT = ast.Import, ast.ImportFrom
REPEATED = (*WHOLE, ast.Lambda, ast.For, ast.While, ast.ListComp, ast.SetComp, ast.DictComp,
            ast.GeneratorExp)


def backward_passes(tree, topic, asked):
    """Yield (line, exercise) of those that try functions out, in a module's tree."""
    statements, functions = statements_of(tree), functions_in(tree)
    for exercise in asked:
        if forward := forward_passes(topic, exercise.name):
            lines = [line for name, statement in reached(statements, exercise.name) for line in (
                tried(statement, forward, functions) if name == exercise.name else
                named(statement, forward) if name not in forward else ())]
            if lines:
                yield min(lines), exercise


@functools.cache
def forward_passes(topic, name):
    """The functions that stand for the forward pass of an exercise. None: nothing is to be found.

    It is not to be found where the exercise is no backward pass, or the reference tries out, too.
    """
    tree = ast.parse(exercises.read(exercises.reference(topic)))
    stem, statements = BACKWARD.sub("", name), statements_of(tree)
    found, new = set(), {stem, stem.removesuffix("_loop"), stem.removesuffix("s")}
    while new:
        found |= new
        new = {other for other, each in statements.items()
               if any(names_used(statement) & found for statement in each)} - found
    is_usual = any(tried(one, found, functions_in(tree)) for one in statements[name])
    return found if stem != name and not is_usual else set()


def statements_of(tree):
    """{name: the statements of a module that give something to it}."""
    assigned = set().union(*(bound(statement) for statement in tree.body
                             if not isinstance(statement, (*WHOLE, *IMPORT))))
    statements = collections.defaultdict(list)
    for statement in tree.body:
        names = (
            {statement.name} if isinstance(statement, WHOLE) else
            {alias.asname for alias in statement.names if alias.asname}
            if isinstance(statement, IMPORT) else
            assigned & {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)})
        for name in names:
            statements[name].append(statement)
    return statements


def functions_in(tree):
    """The names that a tree gives to functions."""
    return {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)} | {
        name for node in ast.walk(tree) if isinstance(node, ast.Assign)
        and isinstance(node.value, ast.Lambda) for target in node.targets for name in bound(target)}


def reached(statements, name):
    """The statements to which a name leads, its own included, each as (name, statement)."""
    found, ends = {}, {name}
    while ends:
        name = ends.pop()
        for statement in statements.get(name, ()):
            if statement not in found:
                found[statement] = name
                ends |= names_used(statement)
    return [(name, statement) for statement, name in found.items()]


def names_used(statement):
    """The names of a module, or of another one, that a statement uses."""
    local = local_names(statement)
    return {name_of(node, local) for node in ast.walk(statement)} - {None}


def named(statement, forward):
    """The lines where a statement names a forward pass."""
    local = local_names(statement)
    return [node.lineno for node in ast.walk(statement) if name_of(node, local) in forward]


def local_names(statement):
    """The names that mean something of a function's own in it; in a default, none does."""
    if not isinstance(statement, ast.FunctionDef):
        return set()
    defaults = [*statement.args.defaults, *filter(None, statement.args.kw_defaults)]
    return bound(statement) - {statement.name} - {
        node.id for default in defaults for node in ast.walk(default) if isinstance(node, ast.Name)}


def name_of(node, local):
    """The name of a module, or of another one, that a node is. None: it is none."""
    if isinstance(node, ast.Name):
        return node.id if isinstance(node.ctx, ast.Load) and node.id not in local else None
    if isinstance(node, ast.Attribute):
        whole = node.value.value if isinstance(node.value, ast.Attribute) else node.value
        return node.attr if isinstance(whole, ast.Name) and whole.id not in local else None
    return node.name if isinstance(node, ast.alias) else None


def tried(statement, forward, functions):
    """The lines where an exercise calls a forward pass again and again, or hands a function on."""
    local, known = local_names(statement) - functions_in(statement), forward | functions
    lines, calls = [], 0
    ends = [(part, False) for part in ast.iter_child_nodes(statement)]
    while ends:
        node, again = ends.pop()
        called = name_of(node.func, local) if isinstance(node, ast.Call) else None
        calls += called in forward
        if (name_of(node, local) in known or hands_lambda(node)
                or (called in forward and (again or calls > 1))):
            lines.append(node.lineno)
        once = getattr(node, "generators", [getattr(node, "iter", None)])[0]
        ends += [(part, again or (isinstance(node, REPEATED) and part is not once))
                 for part in ast.iter_child_nodes(node)
                 if not (called in known and part is node.func)]
    return lines


def hands_lambda(node):
    """Whether a node is a call that is given a lambda, but for a key to sort by."""
    return isinstance(node, ast.Call) and any(isinstance(part, ast.Lambda) for part in (
        *node.args, *(one.value for one in node.keywords if one.arg != "key")))
