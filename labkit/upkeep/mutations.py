"""Mutations: the small changes of a function that a machine can make, and what they are called.

An operator, a number, an index, a comparison, a call is another one, or a term is dropped. A change
is called by what is read, "a < b -> a <= b", and by its number, "(#2)", where the function has the
same one before.
"""
import ast
import collections
import textwrap
import warnings
from typing import NamedTuple

SWAPPED = {ast.Add: (ast.Sub,), ast.Sub: (ast.Add,), ast.Mult: (ast.Div,), ast.Div: (ast.Mult,),
           ast.FloorDiv: (ast.Div,), ast.Mod: (ast.FloorDiv,), ast.Pow: (ast.Mult,),
           ast.BitAnd: (ast.BitOr,), ast.BitOr: (ast.BitAnd,), ast.BitXor: (ast.BitOr,),
           ast.And: (ast.Or,), ast.Or: (ast.And,),
           ast.Lt: (ast.LtE, ast.Gt), ast.LtE: (ast.Lt, ast.GtE), ast.Gt: (ast.GtE, ast.Lt),
           ast.GtE: (ast.Gt, ast.LtE), ast.Eq: (ast.NotEq,), ast.NotEq: (ast.Eq,),
           ast.In: (ast.NotIn,), ast.NotIn: (ast.In,), ast.Is: (ast.IsNot,), ast.IsNot: (ast.Is,)}
TWINS = ("sin cos", "floor ceil", "sum mean", "any all", "min max", "minimum maximum",
         "argmin argmax", "zeros ones", "less less_equal", "greater greater_equal",
         "zeros_like ones_like", "logical_and logical_or", "rows columns", "width height")
SYMMETRIC = ("min", "max", "minimum", "maximum", "hypot", "clip")  # clip: min(max(a, b), c)
MAKERS = ("array", "asarray", "stack")  # without them a list is left, which checks take as well
TWIN = {name: twin for pair in map(str.split, TWINS) for name, twin in (pair, pair[::-1])}


class Mutant(NamedTuple):
    """A change of an exercise: its line in the reference, what it reads, the function with it."""

    line: int
    change: str
    text: str


def alternatives(node):
    """Yield what may stand in a node's place: the same with one mistake."""
    yield from of_operators(node)
    yield from of_statements(node)
    match node:
        case ast.Constant(value):
            yield from map(ast.Constant, other_numbers(value))
        case ast.Call(function, arguments, keywords):
            yield from changed_calls(node, function, arguments, keywords)
        case ast.Attribute(value, "T"):
            yield value
        case ast.Attribute(_, name) if name in TWIN:
            yield altered(node, attr=TWIN[name])
        case ast.Name(name) if name in TWIN:
            yield altered(node, id=TWIN[name])
        case ast.Tuple([first, second, *rest]):
            yield altered(node, elts=[second, first, *rest])
        case ast.Slice():
            yield from (altered(node, **{end: None}) for end in ("lower", "upper", "step")
                        if getattr(node, end))


def of_operators(node):
    match node:
        case ast.BinOp(left, op, right):
            yield from swapped(node)
            yield left
            yield ast.UnaryOp(ast.USub(), right) if isinstance(op, ast.Sub) else right
            if isinstance(op, ast.MatMult):
                yield altered(node, left=right, right=left)
        case ast.UnaryOp(_, operand):
            yield operand
            if is_negative(node):  # and not -2 for -1, as reshape takes any negative number
                yield altered(node, operand=ast.Constant(operand.value - 1))
        case ast.BoolOp(op, values):
            yield altered(node, op=SWAPPED[type(op)][0]())
            yield from values
        case ast.Compare(_, ops, _):
            for k, op in enumerate(ops):
                yield from (altered(node, ops=put(ops, k, other())) for other in SWAPPED[type(op)])


def of_statements(node):
    match node:
        case ast.IfExp(_, body, other):
            yield from (body, other)
        case ast.comprehension(ifs=[_, *_]):
            yield altered(node, ifs=[])
        case ast.If():
            yield from (altered(node, test=ast.Constant(always)) for always in (True, False))
        case ast.AugAssign():
            yield from swapped(node)
            yield ast.Pass()
        case ast.Assign([ast.Subscript()]) | ast.Expr() | ast.Raise() | ast.Continue():
            yield ast.Pass()


def swapped(node):
    """A node with another operator."""
    return (altered(node, op=other()) for other in SWAPPED.get(type(node.op), ()))


def changed_calls(node, function, arguments, keywords):
    name = getattr(function, "attr", getattr(function, "id", ""))
    if len(arguments) > 1 and name not in SYMMETRIC:
        yield altered(node, args=[arguments[1], arguments[0], *arguments[2:]])
    if len(arguments) == 1 and name not in MAKERS:
        yield arguments[0]
    if isinstance(function, ast.Attribute) and not isinstance(function.value, ast.Name):
        yield function.value
    for k in range(len(keywords) if name != "zip" else 0):
        yield altered(node, keywords=keywords[:k] + keywords[k + 1:])


def other_numbers(value):
    """The opposite of a truth value, the neighbours of an integer, 10 % more than a float."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1]
    return [float(f"{1.1 * value:.12g}") or 0.1] if isinstance(value, float) else []


def altered(node, **fields):
    return ast.copy_location(type(node)(**{**dict(ast.iter_fields(node)), **fields}), node)


def put(items, k, item):
    return [*items[:k], item, *items[k + 1:]]


def is_negative(node):
    """Whether this is a number like -1."""
    match node:
        case ast.UnaryOp(ast.USub(), ast.Constant(int())):
            return True
    return False


def variants(node):
    """Yield (the part that is changed, what it becomes, the whole node with it), top left first."""
    yield from ((node, other, other) for other in alternatives(node))
    if isinstance(node, ast.Raise) or getattr(node, "arg", "") == "strict" or is_negative(node):
        return  # what an error says is not judged; strict=True is there for the author
    for field, value in ast.iter_fields(node):
        if isinstance(value, ast.AST):
            for old, new, child in variants(value):
                yield old, new, altered(node, **{field: child})
        for k, item in enumerate(value if isinstance(value, list) else ()):
            if isinstance(item, ast.AST):
                for old, new, child in variants(item):
                    yield old, new, altered(node, **{field: put(value, k, child)})


def mutants(function):
    """The Mutants of a function's node, without its docstring, all different, always in one order.
    """
    parts = [ast.unparse(altered(function, body=[])), *map(indented, function.body[1:])]
    found, texts, times = [], {"\n".join(parts)}, collections.Counter()
    for k, statement in enumerate(function.body[1:], 1):
        for old, new, changed in variants(statement):
            text = "\n".join(put(parts, k, indented(changed)))
            if text in texts or not is_python(text):
                continue
            texts.add(text)
            change = told(old, new)
            times[change] += 1
            found.append(Mutant(getattr(old, "lineno", statement.lineno), change + (
                f" (#{times[change]})" if times[change] > 1 else ""), text))
    return found


def indented(statement):
    return textwrap.indent(ast.unparse(statement), "    ")


def is_python(text):
    try:
        with warnings.catch_warnings(action="ignore"):  # such as indices that are no numbers
            compile(text, "mutant", "exec")
    except SyntaxError:
        return False
    return True


def told(old, new):
    return " -> ".join(" ".join(ast.unparse(node).split()) for node in (old, new))
