"""Mutants: small mistakes made by machine, which an exercise's own checks must catch.

A mutant is an exercise of the reference with one change in its body: an operator, a number, an
index, a comparison, a call, or a term that is dropped. Each one takes the place of the right
function, and the exercise's checks run until one fails. Then the mutant is caught, also if it
raised an error or did not end. A mutant that lives shows what no check looks at.

A mutant that only checks of the fine print catch is one of the fine print, and is counted there.

A change that changes nothing (or nothing that the question settles) is no mistake. Such mutants
stand with their reason in tests/mistakes/<topic>.txt, and do not count:

    3.12  a < b -> a <= b (#2)
          At a = b both branches give the same point.

"(#2)" is the second place in the exercise where the same change can be made. What the function
calls its own variables does not matter there: p < q -> p <= q is the same change.
"""
import ast
import contextlib
import functools
import io
import itertools
import json
import keyword
import multiprocessing
import os
import re
import sys
import textwrap
import time
import warnings
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import pytest
from _pytest.runner import runtestprotocol

from .. import exercises
from ..checks import retries
from ..checks.loader import LAST_RETURN, PACKAGE
from ..checks.report import Check, is_fine_print
from ..checks.showing import plural
from ..given import places

GOAL_EXERCISE, GOAL_COURSE = 0.95, 0.98  # shares of the mutants that are caught
SLOWER, AT_LEAST = 20, 8.0  # a mutant may take so many times what the right answer takes; seconds
CONTEXT, WIDEST = 8, 30      # tokens shown to each side of a change, and of all of it
TOKEN = re.compile(r""" ?(?:\w*'[^']*'|\w*"[^"]*"|\.?\w+=?|\S)""")  # .name, name=: not a variable

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
TWIN = {name: twin for pair in map(str.split, TWINS)
        for name, twin in (pair, pair[::-1])}


class Mutant(NamedTuple):
    """A change of an exercise: its line in the reference, what it reads, the function with it."""

    line: int
    change: str
    text: str


class Score(NamedTuple):
    """What became of an exercise's mutants, counted: those of its question, and how many of them
    were caught, then those that only its fine print catches. survivors: [Mutant].
    """

    topic: str
    exercise: exercises.Exercise
    mutants: int
    caught: int
    fine_print: int
    survivors: list
    known: int
    stale: list
    seconds: float


# --- the changes ------------------------------------------------------------------------------


def changes(node):
    """Yield what may stand in a node's place: the same with one mistake."""
    match node:
        case ast.BinOp(left, op, right):
            yield from (altered(node, op=other()) for other in SWAPPED.get(type(op), ()))
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
        case ast.IfExp(_, body, other):
            yield from (body, other)
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
        case ast.comprehension(ifs=[_, *_]):
            yield altered(node, ifs=[])
        case ast.If():
            yield from (altered(node, test=ast.Constant(always)) for always in (True, False))
        case ast.AugAssign(_, op):
            yield from (altered(node, op=other()) for other in SWAPPED.get(type(op), ()))
            yield ast.Pass()
        case ast.Assign([ast.Subscript()]) | ast.Expr() | ast.Raise() | ast.Continue():
            yield ast.Pass()


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
    yield from ((node, other, other) for other in changes(node))
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
    found, texts, keys = [], {"\n".join(parts)}, {}
    for k, statement in enumerate(function.body[1:], 1):
        for old, new, changed in variants(statement):
            text = "\n".join(put(parts, k, indented(changed)))
            if text in texts or not is_python(text):
                continue
            texts.add(text)
            change = told(ast.unparse(old), ast.unparse(new))
            key = nameless(change, function)
            keys[key] = keys.get(key, 0) + 1
            change += f" (#{keys[key]})" if keys[key] > 1 else ""
            found.append(Mutant(getattr(old, "lineno", statement.lineno), change, text))
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


def alike(old, new):
    """How many of their first tokens are the same."""
    differ = (k for k, pair in enumerate(zip(old, new, strict=False)) if pair[0] != pair[1])
    return next(differ, min(len(old), len(new)))


def told(old, new):
    """'a + b -> a - b'; of long texts the place where they differ, however long names are."""
    old, new = (TOKEN.findall(" ".join(text.split())) for text in (old, new))
    start = alike(old, new)
    end = alike(old[start:][::-1], new[start:][::-1])
    cut, cut_end = (length - CONTEXT if length > CONTEXT + 1 else 0 for length in (start, end))

    def part(tokens):
        shown = tokens[cut:len(tokens) - cut_end][:WIDEST]
        left, right = "... " * (cut > 0), " ..." * (cut + len(shown) < len(tokens))
        return left + "".join(shown).strip() + right

    return f"{part(old)} -> {part(new)}"


def nameless(change, function):
    """A change with v1, v2, ... for the function's own names: the same however these are called."""
    others, own = foreign_names(function), {}

    def renamed(token):
        name = token.strip()
        is_own = name.isidentifier() and name not in others
        return own.setdefault(name, f"v{len(own) + 1}") if is_own else name

    return " ".join(map(renamed, TOKEN.findall(change)))


@functools.cache
def foreign_names(function):
    """The names in a function and its mutants that mean something outside of it."""
    nodes = list(ast.walk(function))
    names = {node.id for node in nodes if isinstance(node, ast.Name)}
    own = ({node.id for node in nodes if isinstance(node, ast.Name)
            and not isinstance(node.ctx, ast.Load)}
           | {node.arg for node in nodes if isinstance(node, ast.arg)}
           | {node.name for node in nodes if isinstance(node, ast.FunctionDef)})
    others = names - own
    return others | {TWIN[name] for name in others & TWIN.keys()} | {*keyword.kwlist}


# --- those that are no mistakes ---------------------------------------------------------------


def equivalents(topic):
    """{(number, change): reason} from tests/mistakes/<topic>.txt.

    Lines "3.12  change", one below the other, then their reason, indented. ValueError: no reason.
    """
    path = places.ROOT / "tests" / "mistakes" / f"{topic}.txt"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    reasons, waiting = {}, []
    for line in text.splitlines():
        if line[:1].isdigit():
            waiting = [key for key in waiting if key not in reasons]
            waiting.append(tuple(part.strip() for part in line.split(maxsplit=1)))
        elif line.strip() and not line.startswith("#"):
            reasons |= {key: f"{reasons.get(key, '')} {line.strip()}".strip() for key in waiting}
    bare = [key for key in waiting if key not in reasons]
    if bare:
        raise ValueError(f"{places.shown_path(path)}: {' '.join(bare[0])} has no reason below it; "
                         "say why this mutant is no mistake")
    return reasons


# --- in a process of its own ------------------------------------------------------------------


class Trials:
    """A pytest plugin: collects checks once, then runs them on one wrong answer after another.

    trials: [(exercise, text of the function)]. tell(seconds) once for the right answers, then for
    each trial the Checks that caught it: the first one, or all. The checks of the
    fine print come last.
    """

    def __init__(self, topic, trials, only_first, tell):
        self.topic, self.trials, self.only_first, self.tell = topic, trials, only_first, tell
        self.of = {exercise.number: [] for exercise, _ in trials}  # its checks

    def pytest_collection_modifyitems(self, items):
        for item in items:
            mark = item.get_closest_marker("exercise")
            if mark and mark.args[0] in self.of:
                self.of[mark.args[0]].append(item)
        for checks in self.of.values():
            checks.sort(key=in_fine_print)

    def pytest_runtestloop(self, session):
        start = time.perf_counter()
        for number, items in self.of.items():
            if not items or list(failures(items)):
                raise ValueError(f"exercise {number} has no check, or the reference fails")
        self.tell(time.perf_counter() - start)
        module = sys.modules[f"{PACKAGE}.{self.topic}"]
        for exercise, text in self.trials:
            right = getattr(module, exercise.name)
            exec(compile(text, "mutant", "exec"), vars(module))
            failed = failures(self.of[exercise.number])
            self.tell(list(itertools.islice(failed, 1 if self.only_first else None)))
            setattr(module, exercise.name, right)
        return True


def in_fine_print(item):
    return is_fine_print(item.get_closest_marker("exercise"))


def failures(items):
    """Run checks; yield the Check of each that fails."""
    for item in items:
        item.stash[LAST_RETURN] = None
        for report in runtestprotocol(item, log=False, nextitem=item.parent):  # keeps the file's
            if report.failed:
                yield Check(**report.check)
                break


def work(topic, trials, only_first, with_hints, pipe):
    """What a worker does: pytest with Trials. Nothing is printed, no picture is drawn."""
    if not with_hints:
        retries.SECONDS = 0.0
    with contextlib.suppress(ImportError):  # not on Windows
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))  # a mutant may ask for all

    def nowhere(*parts):
        raise OSError("mutants are not drawn")

    places.out = nowhere
    os.environ["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"
    os.environ.pop("PYTEST_ADDOPTS", None)
    options = ["--rootdir", places.ROOT, "-c", places.ROOT / "pyproject.toml", "--impl=reference",
               "-p", "no:cacheprovider", places.ROOT / "tests" / "labs" / f"test_{topic}.py"]
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        pytest.main([*map(str, options)], plugins=[Trials(topic, trials, only_first, pipe.send)])
    pipe.send(said.getvalue())


# --- in the main process ----------------------------------------------------------------------


def caught_by(topic, trials, only_first=True, with_hints=False):
    """Who caught each of the trials (exercise, text): see Trials. [] for one that lives.

    A mutant that does not end is ended with its process. The next process goes on behind it.
    ValueError: the reference itself does not pass.
    """
    verdicts = []
    while len(verdicts) < len(trials):
        here, there = multiprocessing.Pipe()
        process = multiprocessing.get_context("spawn").Process(
            target=work, daemon=True,
            args=(topic, trials[len(verdicts):], only_first, with_hints, there))
        process.start()
        there.close()
        try:
            limit = max(AT_LEAST, SLOWER * received(here, topic))
            while len(verdicts) < len(trials) and here.poll(limit):
                verdicts.append(received(here, topic))
            if len(verdicts) < len(trials):
                verdicts.append([lost(trials[len(verdicts)], f"no end in {limit:.0f} s")])
        except EOFError:
            verdicts.append([lost(trials[len(verdicts)], "it broke off")])
        finally:
            process.kill()
            process.join()
    return verdicts


def lost(trial, why):
    """The Check in the place of all those of a trial whose process was lost."""
    return Check(trial[0].number, why, why, "failed", why, None, 0.0, False)


def received(pipe, topic):
    """What a worker sends. ValueError: it broke off, and sent what pytest said."""
    sent = pipe.recv()
    if isinstance(sent, str):
        raise ValueError(f"the checks of {topic} do not run, or do not pass on the reference: "
                         f"mend them first\n{sent.strip()[-500:]}")
    return sent


def function_of(topic, exercise):
    functions = exercises.top_level_functions(exercises.read(exercises.reference(topic)))
    return next(node for node in functions if node.name == exercise.name)


def listed(exercise, function, reasons):
    """{change without the function's own names: as the list writes it} of an exercise."""
    return {nameless(change, function): change for number, change in reasons
            if number == exercise.number}


def score(topic, exercise, reasons):
    """Let the checks of an exercise judge its mutants -> Score."""
    start, function = time.perf_counter(), function_of(topic, exercise)
    tried, excused = mutants(function), listed(exercise, function, reasons)
    verdicts = caught_by(topic, [(exercise, mutant.text) for mutant in tried])
    alive = [mutant for mutant, verdict in zip(tried, verdicts, strict=True) if not verdict]
    named = {nameless(mutant.change, function): mutant for mutant in alive}
    survivors = [mutant for key, mutant in named.items() if key not in excused]
    stale = [change for key, change in excused.items() if key not in named]
    known = len(alive) - len(survivors)
    fine = sum(bool(verdict) and verdict[0].fine_print for verdict in verdicts)
    counted = len(tried) - known - fine
    return Score(topic, exercise, counted, counted - len(survivors), fine, survivors, known, stale,
                 time.perf_counter() - start)


def run(target=None):
    """Try the mutants of a lab (2 or rasterization), of an exercise (2.3), or of all.

    Prints a table, then every mutant that lives with its line. The same goes to out/mutants/ as
    JSON. -> 0 if 95 % of each exercise's mutants and 98 % of the core's are caught, else 1.
    """
    labs, asked = exercises.asked_for(target)
    wanted = [(topic, exercise, equivalents(topic))
              for topic, exercises in labs.items() for exercise in exercises
              if exercise.number in asked]
    scores = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # each thread waits for a process of its own
        for found in pool.map(lambda one: score(*one), wanted):
            scores.append(found)
            print(row(found.exercise.number, found.exercise.name, found), flush=True)
    core, extra = ([s for s in scores if s.exercise.is_extra == kind] for kind in (False, True))
    path = places.out("mutants", f"{target or 'all'}.json")
    places.write_whole(path, as_json(scores).encode("utf-8"))
    print(*(row(name, plural(len(found), "exercise"), all_together(found))
            for name, found in (("core", core), ("extra", extra)) if found),
          *(text for found in scores for text in remarks(found)),
          places.shown_path(path), sep="\n")
    too_low = any(share(s) < GOAL_EXERCISE for s in scores)
    return int(too_low or share(all_together(core)) < GOAL_COURSE)


def all_together(scores):
    return Score("", None, sum(s.mutants for s in scores), sum(s.caught for s in scores),
                 sum(s.fine_print for s in scores), [], sum(s.known for s in scores), [],
                 sum(s.seconds for s in scores))


def share(found):
    return found.caught / found.mutants if found.mutants else 1.0


def row(number, name, found):
    fine = f", {found.fine_print} more by the fine print" if found.fine_print else ""
    known = f", and {found.known} equivalent" if found.known else ""
    return (f"{number:>5}  {name:30} {found.caught:4} of {found.mutants:4} caught  "
            f"{100 * share(found):5.1f} %{fine}{known}")


def remarks(found):
    """What lives of an exercise, and what is said to be equivalent in vain."""
    number, file = found.exercise.number, f"reference/{found.topic}.py"
    return [*(f"{number}  {mutant.change}\n      lives, {file}:{mutant.line}"
              for mutant in found.survivors),
            *(f"{number}  {change}\n      is listed as equivalent, but is caught, or is no mutant"
              for change in found.stale)]


def as_json(scores):
    """{"mutants", "caught", "exercises": [{number, name, extra, mutants, caught, fine print,
    equivalent, seconds, alive}]}.
    """
    total = all_together(scores)
    exercises = [{"number": s.exercise.number, "name": s.exercise.name,
                  "extra": s.exercise.is_extra, "mutants": s.mutants, "caught": s.caught,
                  "fine print": s.fine_print, "equivalent": s.known, "seconds": round(s.seconds, 1),
                  "alive": [{"line": mutant.line, "change": mutant.change}
                            for mutant in s.survivors]} for s in scores]
    return json.dumps({"mutants": total.mutants, "caught": total.caught, "exercises": exercises},
                      indent=2) + "\n"
