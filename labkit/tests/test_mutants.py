"""Mutants: which changes are made, and what counts as caught."""
import ast

import pytest
from made_up import check_text, exercise_text
from submitted import put

from labkit import places
from labkit.upkeep import mutants, mutations

FUNCTION = '''\
def f(x, y, n):
    """The question, with 1 + 1 in it."""
    z = x[:, 0] + 2 * y
    for k in range(n):
        if x[k] < y:
            z += np.sin(k)
    return z.T, np.sum(z, axis=1)
'''

CHANGES = """\
x[:, 0] + 2 * y -> x[:, 0] - 2 * y
x[:, 0] + 2 * y -> x[:, 0]
x[:, 0] + 2 * y -> 2 * y
(:, 0) -> (0, :)
0 -> 1
0 -> -1
2 * y -> 2 / y
2 * y -> 2
2 * y -> y
2 -> 3
2 -> 1
range(n) -> n
if x[k] < y: z += np.sin(k) -> if True: z += np.sin(k)
if x[k] < y: z += np.sin(k) -> if False: z += np.sin(k)
x[k] < y -> x[k] <= y
x[k] < y -> x[k] > y
z += np.sin(k) -> z -= np.sin(k)
z += np.sin(k) -> pass
np.sin(k) -> k
np.sin -> np.cos
(z.T, np.sum(z, axis=1)) -> (np.sum(z, axis=1), z.T)
z.T -> z
np.sum(z, axis=1) -> z
np.sum(z, axis=1) -> np.sum(z)
np.sum -> np.mean
1 -> 2
1 -> 0
"""


def made(text):
    return mutations.mutants(ast.parse(text).body[0])


def test_every_change_is_made_once_in_the_order_of_the_text():
    """An operator is forgotten, the docstring is changed, or two runs give two lists."""
    assert [mutant.change for mutant in made(FUNCTION)] == CHANGES.splitlines()
    assert [mutant.text for mutant in made(FUNCTION)] == [mutant.text for mutant in made(FUNCTION)]
    assert [mutant.line for mutant in made(FUNCTION)] == (
        [3] * 11 + [4] + [5] * 4 + [6] * 4 + [7] * 7)


def test_every_mutant_is_another_function_and_only_one_place_is_changed():
    """A mutant is the function itself, or keeps the change of the one before."""
    texts = [mutant.text for mutant in made(FUNCTION)]
    right = [line for line in ast.unparse(ast.parse(FUNCTION)).splitlines() if '"""' not in line]
    assert len({*texts}) == len(texts) and "\n".join(right) not in texts
    for text in texts:
        lines = text.splitlines()
        assert len(lines) == len(right)
        assert sum(a != b for a, b in zip(lines, right, strict=True)) == 1


def test_the_same_change_in_two_places_has_two_names():
    """A reason for one of them excuses the other."""
    assert [mutant.change for mutant in made('def f(x):\n    "?"\n    return g(x + 1) * x + 1\n')
            if mutant.change.startswith("1 -> 2")] == ["1 -> 2", "1 -> 2 (#2)"]


REFERENCE = "import itertools\n" + "".join((
    exercise_text("1.1", "double", "Twice x.", "return 2 * x", points=2),
    exercise_text("1.2", "count", "n.", "for k in itertools.count():", "    if k >= n:",
                  "        return k", points=2, inputs="n", kind="extra"),
    exercise_text("1.3", "unseen", "x, or nothing below 0.", "return x if x > 0 else 0.0")))

CHECKS = "import pytest\n\nfrom labkit.checks import assert_close, exercise\n" + "".join((
    '\n\n@pytest.fixture(scope="module")\ndef two():\n    return 2.0\n',
    check_text("1.1", "twice", "Once.", "assert_close(impl.double(x), two * x)",
               inputs="impl, two, x", marks=['@pytest.mark.parametrize("x", [0.0, 1.0])']),
    check_text("1.2", "counted", "Too many.", "assert_close(impl.count(3), 3)"),
    check_text("1.3", "it_is_there", "No return.", "impl.unseen(1.0)"),
    check_text("1.3", "below_0", "It is seen.", "assert_close(impl.unseen(-1.0), 0.0)",
               fine_print=True)))

FILES = {"reference/transforms.py": REFERENCE, "tests/labs/test_transforms.py": CHECKS,
         "tests/equivalents/transforms.txt":
         "# a comment\n1.3  x > 0 -> x >= 0\n      At 0 both give 0,\n      as numbers.\n"
         "1.3  no such change\n      For no reason.\n"}


def test_what_lives_is_shown_with_its_line(house, run_module):
    """A check that looks at nothing has a full score; an error is not caught, or an endless loop
    goes on; an equivalent mutant counts."""
    tried = run_module(house(FILES), "course", "mutants", "1")
    assert tried.stderr == ""
    rows = [line.split() for line in tried.stdout.splitlines()[:5]]
    assert rows[0] == "1.1 double 5 of 5 caught 100.0 %".split()
    assert rows[1] == "1.2 count 4 of 4 caught 100.0 %".split()
    assert rows[2] == ("1.3 unseen 0 of 3 caught 0.0 %, 3 more by the fine print, and 1 equivalent"
                       ).split()
    assert [row[:2] for row in rows[3:]] == [["core", "2"], ["extra", "1"]]
    assert "1.3  x > 0 -> x >= 0\n" not in tried.stdout
    assert "1.3  0 -> 1\n      lives, reference/transforms.py:18\n" in tried.stdout
    assert "1.3  no such change\n      is listed as equivalent, but is caught, or is no mutant" in (
        tried.stdout)
    assert tried.returncode == 1


def test_a_reference_that_fails_is_told(house, run_module):
    """All mutants of an exercise are caught, for nothing passes."""
    root = house(FILES | {"reference/transforms.py": REFERENCE.replace("2 * x", "3 * x")})
    done = run_module(root, "course", "mutants", "1.1")
    assert done.returncode == 2
    assert done.stderr.startswith(
        "course: the checks of transforms do not run, or do not pass on the reference: "
        "mend them first\n")


def test_an_equivalent_mutant_has_a_reason(monkeypatch, tmp_path):
    """Survivors are excused by a list of names."""
    path, = put(tmp_path, {"tests/equivalents/transforms.txt":
                           "1.1  a -> b\n1.2  c -> d\n      Both.\n      Of them.\n1.3  e -> f\n"})
    monkeypatch.setattr(places, "ROOT", tmp_path)
    with pytest.raises(ValueError, match="e -> f has no reason below it"):
        mutants.equivalents("transforms")
    path.write_text(path.read_text() + "      Why.\n")
    assert mutants.equivalents("transforms") == {
        ("1.1", "a -> b"): "Both. Of them.", ("1.2", "c -> d"): "Both. Of them.",
        ("1.3", "e -> f"): "Why."}
