"""What a person should look at: disguised and copied answers are named, honest work is not."""
import ast
import base64
import textwrap
import time
import zlib

import pytest
from graded import submission
from submitted import CORE

from course import exercises, lab_text
from course.given import places
from course.grading.handing import texts
from course.grading.pages import numeric, overview, similarity, unusual

FOLDERS = "tests/other_solutions", "tests/mistakes"
OTHER = exercises.read(places.ROOT / "tests" / "other_solutions" / "rasterization.py")


def lab(topic, functions):
    """The text of a lab that was handed out, with these functions {name: node} in it."""
    tree = ast.parse(lab_text.skeleton(exercises.read(exercises.reference(topic))))
    tree.body = [functions.get(getattr(node, "name", None), node) for node in tree.body]
    return ast.unparse(tree)


def found(labs, others=()):
    """{topic: reasons} of what is named in a student's {topic: text}. others: the class besides."""
    whole = {**dict(others), "ada": labs}
    named = dict(unusual.by_student(whole, CORE, similarity.compare(whole, CORE)[1]))
    return {topic: [sign.reason for sign in named.get("ada", ()) if sign.topic == topic]
            for topic in labs}


# --- honest work ------------------------------------------------------------------------------


@pytest.mark.parametrize("folder", FOLDERS)
def test_honest_work_is_not_named(folder):
    """Everybody is in the list, so nobody reads it."""
    for topic in CORE:
        path = places.ROOT / folder / f"{topic}.py"
        for functions in similarity.versions(exercises.read(path)) if path.exists() else ():
            assert found({topic: lab(topic, functions)}) == {topic: []}


def test_who_did_nothing_is_not_named():
    """All empty labs are equal, also where an editor has set them anew."""
    for topic in CORE:
        assert found({topic: lab(topic, {})}, {"bob": {topic: lab(topic, {})}}) == {topic: []}


# --- disguises --------------------------------------------------------------------------------


def without(name):
    """The other right answer to lab 2, whole but for one exercise; and that one."""
    functions = {node.name: node for node in ast.parse(OTHER).body
                 if isinstance(node, ast.FunctionDef)}
    tree = ast.parse(lab("rasterization", functions))
    tree.body = [node for node in tree.body if getattr(node, "name", None) != name]
    return ast.unparse(tree), ast.unparse(functions[name])


REST, ANSWER = without("is_covered")
PACKED = base64.b64encode(zlib.compress(ANSWER.encode())).decode()


@pytest.mark.parametrize(("more", "words"), [
    ("is_covered = lambda p, triangle: True", []),
    (f"{ANSWER.replace('is_covered', 'c')}\nis_covered = c", []),
    ("class Lab:\n    def is_covered(p, triangle): return True\nis_covered = Lab.is_covered", []),
    ("if True:\n" + textwrap.indent(ANSWER, "    "), []),
    ("try:\n    x\nexcept NameError:\n    is_covered, y = print, 2", []),
    ("[is_covered := print]", []), ("from .arrays import scatter as is_covered", []),
    (f"{ANSWER}\n\ndef other():\n    global is_covered\n    is_covered = 1", []),
    (f"{ANSWER}\n\n\n{ANSWER}", []), (f"import functools\n@functools.cache\n{ANSWER}", []),
    ("def __getattr__(name):\n    return print", ["def __getattr__"]),
    (f"exec({ANSWER!r})", ["exec"]),
    (f"import zlib, base64\nexec(zlib.decompress(base64.b64decode({PACKED!r})))",
     ["exec", "import zlib", "import base64"]),
    ("globals()['is_covered'] = print", ["globals"]),
    ("import sys\nsetattr(sys.modules[__name__], 'is_covered', print)", ["import sys", "setattr"]),
    ("np.lib.npyio.os", [".os"]), ("from numpy.lib.npyio import os", ["import numpy.lib.npyio.os"]),
])
def test_an_exercise_that_is_no_plain_function_is_named(more, words):
    """The same answer in another place: neither the comparison nor anybody else looks at it."""
    reasons = found({"rasterization": f"{REST}\n{more}\n"})["rasterization"]
    named = "not one plain function each: 2.6 is_covered" in "".join(reasons)
    assert named and all(word in "".join(reasons) for word in words), reasons


@pytest.mark.parametrize("word", [
    "eval", "compile", "__import__", "locals", "vars", "getattr", "open", "__builtins__",
    "is_covered.__globals__", "().__class__.__subclasses__", "error.tb_frame", "'__builtins__'",
    "np.ctypeslib", "import linecache", "import ctypes", "import gc", "import inspect",
    "from os import path", "import importlib.util", "from types import CodeType",
    "from reference import msaa", "np.isclose = print", "x = '" + "b" * 1200 + "'",
    "x = [" + "0.125, " * 130 + "]", "x = 0x" + "f" * 5000, "x = " + "-" * 110 + "1"])
def test_what_labs_do_without_is_named_with_its_line(word):
    """A lab that reads its caller, its checks or a table is like any other."""
    text = f"{REST}\n{ANSWER}"
    (reason, *_), = found({"rasterization": f"{text}\n\n{word}\n"}).values()
    assert f"(line {len(text.splitlines()) + 2})" in reason


def test_the_same_file_twice_is_named():
    """Two copies that nobody has touched are only one pair of many, or nothing."""
    text = f"{REST}\n{ANSWER}"
    same = {"rasterization": text}
    assert found(same, {"bob": same, "eve": {"rasterization": f"{text}\n# mine"}}) == {
        "rasterization": ["the same file as that of bob"]}


# --- numeric derivatives ----------------------------------------------------------------------

VJP = '''
def vjp(forward, grad, *given):
    """Differences of a function, by one number after the other."""
    given, result = [np.array(one, float) for one in given], []
    for one in given:
        slopes = np.zeros(one.size)
        for k in range(one.size):
            sides = []
            for step in 1e-6, -2e-6:
                one.flat[k] += step
                sides.append(np.asarray(forward(*given)))
            one.flat[k] += 1e-6
            slopes[k] = np.sum(grad * (sides[0] - sides[1])) / 2e-6
        result.append(slopes.reshape(one.shape))
    return tuple(result)
'''
DIFFERENCES = {  # X: the forward pass, A: what it is given
    "as it is": (VJP, "return vjp(X, A)"),
    "by another name": (f"{VJP}\n_f = X\n_differences = vjp", "return _differences(_f, A)"),
    "out of a table": (f"{VJP}\nT = {{}}\nT['f'] = X", "return vjp(T['f'], A)"),
    "imported": (f"from .other import X as f\n{VJP}", "return vjp(f, A)"),
    "from a module": (f"from . import elsewhere\n{VJP}", "return vjp(elsewhere.X, A)"),
    "in a class": ("class K:\n    def run(*v):\n        return [X(*v) for _ in v]",
                   "return K.run(A)"),
    "in a helper's loop": ("def h(*v):\n    while v:\n        v = X(*v)", "return h(A)"),
    "by helpers": ("def _p(*v):\n    return X(*v)\n\ndef _m(*v):\n    return X(*v)",
                   "return _p(A) - _m(A)"),
    "calls itself": ("def h(k, *v):\n    return X(*v) + h(k - 1, *v) if k else 0",
                     "return h(9, A)"),
    "by default": ("def h(*v, f=X):\n    return [f(*v) for _ in v]", "return h(A)"),
    "inside": ("", "def f(*v):\n        return X(*v)\n    return [f(A) for _ in range(9)]"),
    "twice": ("", "return (X(A) - X(A)) / 1e-6"),
    "written out again": (VJP, "return vjp(lambda *v: sum(v), A)")}


@pytest.mark.parametrize("form", DIFFERENCES)
def test_a_numeric_derivative_is_named(form):
    """Half of the points for backward passes come from 20 lines without one derivative."""
    named, tried = [], []
    for topic in "transforms", "rasterization", "msaa", "inverse_rendering", "reconstruction":
        text, asked = exercises.read(exercises.reference(topic)), CORE[topic]
        functions = {one.name: one for one in exercises.top_level_functions(text)}
        for one in asked:
            forward = one.name.replace("_backward", "")
            if forward != one.name and forward in functions:
                given = ", ".join(arg.arg for arg in functions[one.name].args.args)
                more, body = (part.replace("X", forward).replace("A", given)
                              for part in DIFFERENCES[form])
                head = ast.unparse(functions[one.name].args)
                answer = ast.parse(f"def {one.name}({head}):\n    {body}").body[0]
                tree = ast.parse(f"{lab(topic, {one.name: answer})}\n{more}\n")
                tried.append(one.name)
                named += [each.name for _, each in numeric.backward_passes(tree, topic, asked)]
    assert named == tried and len(tried) >= 7


# --- what is written --------------------------------------------------------------------------


@pytest.mark.parametrize("text", [
    "def (", "\0", "x = " + "-" * 100_000 + "1", "x = " + "+".join("1" * 50_000),
    "x = a" + "<a" * 50_000, "if x:\n    x\n" + "elif x:\n    x\n" * 15_000,
    " = ".join(f"a{k}" for k in range(9000)) + " = 0",
    "".join(f"a{k + 1} = a{k}\n" for k in range(4000)),
    "".join(f"def f{k}():\n    f{k + 1}()\n" for k in range(3000)), "x = a" + ".b" * 900,
    "import a\n@a" + ".b" * 900 + "\ndef is_covered(): a[0" + "+0" * 900 + "] = 1"])
def test_no_text_breaks_the_list_or_keeps_it_busy(text):
    """One student's file costs the class its page, or takes hours."""
    begun = time.process_time()
    found({"rasterization": text}, {"bob": {"rasterization": text}})
    assert time.process_time() - begun < 10


def test_the_page_names_the_most_unusual_first_and_escapes_what_they_wrote():
    """A student's text is HTML in the instructor's browser; one student hides all others."""
    labs = {topic: f"exec('')\nimport {'_' * 400}\nx = '__<script>__'" for topic in CORE}
    whole = {"bob": {"rasterization": "eval('1')"}, "ada": labs}
    signs = unusual.by_student(whole, CORE, {})
    page = overview.overview([], [], "strict", "", looked_at=overview.LookedAt([], signs))
    part = page.partition('<h2 id="unusual')[2].partition("<h2")[0]
    assert part.count("code/ada/") == overview.MOST_SIGNS
    assert part.index(" more<") < part.index("report.html\">bob")
    assert "takes no points" in part and "<script" not in page and len(part) < 20_000
    assert 'href="code/bob/rasterization.py">rasterization.py:1</a>' in part


def test_later_runs_find_the_texts_of_earlier_ones_and_of_a_group_one(tmp_path):
    """Late work is compared with nobody's; a group's members are copies of each other."""
    def work(student, text, group=""):
        return submission(student)._replace(group=group, texts={"sampling": text} if text else {})

    first = [work("ada", "a\r\n"), work("bob", "b"), work("eve", "e", "g"), work("ann", "e", "g")]
    assert texts.kept(tmp_path, first) == {
        "ada": {"sampling": "a\r\n"}, "bob": {"sampling": "b"}, "ann": {"sampling": "e"}}
    nothing = work("bob", "")._replace(missing={"sampling": "it is gone"})
    second = [work("ada", ""), nothing, work("eve", "", "g"), work("ann", "", "g"),
              work("zoe", "z")]
    assert texts.kept(tmp_path, second) == {
        "ada": {"sampling": "a\r\n"}, "bob": {}, "ann": {"sampling": "e"}, "zoe": {"sampling": "z"}}
    assert {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.py")} == {
        "code/ada/sampling.py", "code/ann/sampling.py", "code/zoe/sampling.py",
        "code-handed-out/sampling.py"}
