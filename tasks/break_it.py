"""Break it: cases that the right tape passes, and a tape with a fault does not.

A student's function returns cases, (name, arguments, expected): what lab 9's tape must return. They
are tried on two right tapes, and on tapes with one fault each. A fault is a change of the tape's
text, in which letters stand for numbers that are drawn. Neither the text nor the tape is in the
student's reach, for cases are data: what they show is how a tape behaves.
"""
import copy
import importlib
import inspect

import numpy as np

from labkit import exercises

FUNCTION = "cases"
POINTS = 40
SECONDS = 5.0       # that making the cases may take, and a tape all of them
ALL_SECONDS = 30.0  # of all tapes
COUNTED = None      # no function of the labs is needed
TRIES_IT = True     # a trial is a module, whose function gets what the student's returned
MOST = 100          # cases
ASKED = ("summed_to", "multiply_backward", "matmul_backward", "take_backward", "replay",
         "backward", "rotation")

# What a right tape may do in another way: the docstrings do not speak of it. All at once.
OTHERWISE = (
    ("np.add.at(grad_a, index, grad)", "for at in np.ndindex(np.shape(index)):\n"
     "        grad_a[np.asarray(index)[at]] += np.asarray(grad)[at]"),
    ("    grad = np.sum(grad, axis=tuple(range(np.ndim(grad) - len(shape))))\n",
     "    grad = np.asarray(grad)\n    while grad.ndim > len(shape):\n        grad = sum(grad)\n"),
    ("np.outer(grad, b)", "grad[:, None] * b"),
    ("and np.any(grads[place])", "and (np.ndim(grads[place]) or grads[place])"),
    ("= grads[places[argument]] + part", "= part + grads[places[argument]]"),
    ("2.0 * (q[0] * K + K @ K) / square", "(q[0] * K + K @ K) * (2.0 / square)"))

# The faults that one may look at: (where, what the text says, what it says then).
KINDS = (
    ("summed_to", "if size == 1)", "if size == 1 and axis != {axis})"),
    ("multiply_backward", "summed_to(grad * a,", "summed_to(grad * np.abs(a),"),
    ("take_backward", "np.add.at(grad_a, index, grad)", "grad_a[index] += grad"),
    ("replay", "(found[k] for k in step[1])", "(values[k] for k in step[1])"),
    ("backward", "= grads[places[argument]] + part", "= part"),
    ("backward", "grads[-1] = grad", "grads[-1] = np.ones(np.shape(grad)) * np.{mean}(grad)"))


def kinds():
    """All kinds of faults. A hand-out has no others but those above."""
    try:
        return *KINDS, *importlib.import_module("tasks.held_back.break_it").KINDS
    except ModuleNotFoundError:
        return KINDS


def drawn(seed):
    """{letters: what stands for them} in the faults of a seed."""
    rng = np.random.default_rng([seed, 11])
    numbers = {"axis": (0, 3), "few": (1, 3), "uses": (2, 5), "row": (0, 4), "size": (2, 5),
               "power": (3, 7), "large": (5, 40), "many": (30, 900)}
    return {"mean": rng.choice(["mean", "max", "min"]), "sum": rng.choice(["sum", "max", "all"]),
            "small": rng.choice([-1, 1]) * round(rng.uniform(0.05, 0.3), 3),
            **{name: rng.integers(*ends) for name, ends in numbers.items()}}


def trials(seed):
    """[(name, (the text of a module,))]: two right tapes, and one with each kind of fault."""
    right = exercises.read(exercises.questions("tape"))
    faults = [(f"fault {number}, in {where}", (old, new.format(**drawn(seed))))
              for number, (where, old, new) in enumerate(kinds(), 1)]
    return [(name, (module(right, changes),)) for name, *changes in
            (("the right tape",), ("a right tape, written otherwise", *OTHERWISE), *faults)]


def module(text, changes):
    """A tape's text with changes made, and a function `cases` that tries it."""
    for old, new in changes:
        if text.count(old) != 1:
            raise ValueError("labs/tape.py is not as it was handed out, and the faults are changes "
                             "of it: `python3 -m course close 9` puts it back")
        text = text.replace(old, new)
    return "\n\n".join([text, "import copy", f"MOST, ASKED = {MOST}, {ASKED}",
                        *map(inspect.getsource, (cases, holds, same))])


def cases(found):
    """Whether each case holds, as numbers. ValueError: these are no cases."""
    if not isinstance(found, tuple | list) or not 0 < len(found) <= MOST:
        raise ValueError(f"return a list of 1 to {MOST} cases")
    for case in found:
        if not isinstance(case, tuple) or len(case) != 3 or case[0] not in ASKED:
            raise ValueError("a case is (name, arguments, expected), and the name one of "
                             f"{', '.join(ASKED)}")
    return np.array([holds(*case) for case in found])


def holds(name, arguments, expected):
    """Does it return what is expected, and leave its arguments as they are? An error is a no."""
    given = copy.deepcopy(arguments)
    try:
        with np.errstate(all="ignore"):
            return same(globals()[name](*given), expected) and same(given, arguments)
    except Exception:
        return False


def same(found, expected):
    """Of the same shapes, and to six digits of the largest number."""
    if isinstance(expected, tuple | list):
        return len(found) == len(expected) and all(map(same, found, expected))
    if expected is None or isinstance(expected, str):
        return found == expected
    least = 1e-6 * np.max(np.abs(expected), initial=1e-3)
    return np.shape(found) == np.shape(expected) and np.allclose(found, expected, 0, least)


def expected(seed):
    """1 for a right tape, 0 for one with a fault."""
    return [int(number < 2) for number, _ in enumerate(trials(seed))]


def claims(found, truths, answers):
    """Is each fault found, and no right tape accused? -> [(claim, whether it holds, why)]."""
    wrong = [accusation(name, answer) for (name, _), right, answer in
             zip(found, truths, answers, strict=True) if right]
    why = next(filter(None, wrong), "")
    for (name, _), right, answer in zip(found, truths, answers, strict=True):
        if not right:
            caught = answer is not None and not np.all(answer)
            yield (f"{name}, is found", caught and not why,
                   why or ("" if caught else "all cases hold on it"))


def accusation(name, answer):
    """A sentence where cases do not hold on a right tape. "": they do."""
    if answer is None:
        return f"no cases could be tried on {name}"
    return f"case {np.argmin(answer) + 1} does not hold on {name}" * (not np.all(answer))
