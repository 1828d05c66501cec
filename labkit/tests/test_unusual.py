"""What a person should look at: code that reaches outside and equal files, not honest work."""
import keyword
import re
import subprocess
import sys
import time

import pytest
from graded import submission
from submitted import CORE, other_solution, put

from labkit import exercises
from labkit.grading.handing import texts
from labkit.grading.pages import overview, unusual

ANSWER = other_solution("rasterization")


def reasons(files, **others):
    """What is named in a student's {name: text}. others: the class besides."""
    found = dict(unusual.by_student({**others, "ada": files}))
    return [sign.reason for sign in found.get("ada", ())]


# --- honest work ------------------------------------------------------------------------------


def test_honest_work_is_not_named():
    """Everybody is in the list, so nobody reads it."""
    labs = {topic: other_solution(topic) if CORE.get(topic) else texts.handed_out(topic)
            for topic in exercises.lab_topics()}
    assert reasons(labs, bob={topic: texts.handed_out(topic) for topic in CORE}) == []


def test_who_did_nothing_is_not_named(tmp_path):
    """All empty labs are equal, also where an editor has set them anew."""
    empty = {topic: texts.handed_out(topic) for topic in CORE}
    paths = put(tmp_path, {f"{topic}.py": text for topic, text in empty.items()})
    subprocess.run([sys.executable, "-m", "ruff", "format", "--isolated", "--quiet", tmp_path],
                   check=True)
    anew = {path.stem: exercises.read(path) for path in paths}
    assert anew != empty
    assert unusual.by_student({"ada": empty, "bob": empty, "eve": anew, "zoe": anew}) == []


# --- what is named ----------------------------------------------------------------------------


@pytest.mark.parametrize(("line", "named"), [
    *((word, word) for word in ("eval", "exec", "__import__", "globals", "open", "import socket")),
    ("from types import CodeType", "import types"), ("from numpy.lib.npyio import os", "os"),
    ("from reference import msaa", "import reference"), ("np.lib.npyio.os", "os"),
    ("is_covered.__globals__", "__globals__"), ("().__class__.__subclasses__", "__subclasses__"),
    ("error.tb_frame", "tb_frame"), ("'__builtins__'", "__builtins__")])
def test_what_reaches_outside_is_named_with_its_line(line, named):
    """A lab that reads its caller, its checks or a table is like any other."""
    assert unusual.words(f"x = 1\n{line}\n") == {named: 2}


def dressed(text):
    """Every name is another one, every text, too, and there are comments and other lines."""
    renamed = re.sub(r"\b[A-Za-z_]\w*\b(?!['\"])", lambda word: word[0] if keyword.iskeyword(
        word[0]) else f"my_{word[0]}", text)
    return re.sub(r"\n( +)(?=\w)", r"\n\n\1# mine, and nobody else's\n\1", renamed)


@pytest.mark.parametrize("dress", [str, dressed])
def test_the_same_file_twice_is_named(dress):
    """Two copies, or one of the solution, are like any other file. Or all that two labs have in
    common lies in modules of their own.
    """
    reference = exercises.read(exercises.reference("rasterization"))
    same = "the same file as that of {}, but for names, comments and layout".format
    for name, other in ("rasterization", "rasterization"), ("norms", "helpers"):
        assert reasons({name: ANSWER}, bob={other: dress(ANSWER)}) == [same("bob")]
    assert reasons({"rasterization": dress(reference)})[0] == same(unusual.REFERENCE)
    assert reasons({"rasterization": ANSWER}, bob={"rasterization": ANSWER + "x = 1"}) == []
    short = "\n".join(f"x{k} = {k}" for k in range(unusual.OWN_LINES - 1))
    assert reasons({"norms": short}, bob={"norms": dress(short)}) == []


# --- what is written --------------------------------------------------------------------------


@pytest.mark.parametrize("text", [
    "def (", "\0", "x = " + "-" * 100_000 + "1", "x = " + "+".join("1" * 50_000),
    "x = a" + "<a" * 50_000, "if x:\n    x\n" + "elif x:\n    x\n" * 15_000,
    " = ".join(f"a{k}" for k in range(9000)) + " = 0", "x = 0x" + "f" * 5000,
    "x = a" + ".b" * 900, "import a\n@a" + ".b" * 900 + "\ndef f(): a[0" + "+0" * 900 + "] = 1"])
def test_no_text_breaks_the_list_or_keeps_it_busy(text):
    """One student's file costs the class its page, or takes hours."""
    begun = time.process_time()
    reasons({"rasterization": text}, bob={"rasterization": text})
    assert time.process_time() - begun < 10


def test_the_page_names_the_most_unusual_first_and_escapes_what_they_wrote():
    """A student's text is HTML in the instructor's browser. One student hides all others."""
    files = {topic: f"exec('')\nimport {'_' * 400}\nx = '__<script>__'" for topic in CORE}
    signs = unusual.by_student({"bob": {"rasterization": "eval('1')"}, "ada": files})
    page = overview.overview([], [], "strict", "", unusual=signs)
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
