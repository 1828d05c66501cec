"""The pages: the class's, a student's, what is cut, and how reports are given back."""
import io
import re
import zipfile

import pytest
from graded import check, entry, exercise, record, result, submission
from submitted import put

from labkit.grading.gradebook import handback
from labkit.grading.handing import platforms
from labkit.grading.pages import overview, report

COLUMNS = [exercise("1.1", "double", 1), exercise("1.2", "halve", 2)]
CLAIMS = {"1.1": ("It is twice as much",), "1.2": ("It is half", "Zero stays")}


def found(wrong=(), verdict="failing", **more):
    """What became of lab 1, where these claims fail. {claim: message}."""
    wrong = dict(wrong)
    entries = []
    for asked in COLUMNS:
        checks = [check(asked.number, claim, "failed" if claim in wrong else "passed",
                        wrong.get(claim, "")) for claim in CLAIMS[asked.number]]
        is_wrong = any(one.verdict == "failed" for one in checks)
        entries.append(entry(asked, verdict if is_wrong else "done", *checks, topic="transforms"))
    return result(*entries, **more)


def graded(student="ada", wrong=(), work=None, **more):
    """A record of lab 1, where these claims fail."""
    return record(work or submission(student), found(wrong, **more))


IMPORT = "labs/transforms.py cannot be imported: SyntaxError: invalid syntax"
BROKEN = dict.fromkeys(("It is twice as much", "It is half", "Zero stays"),
                       f"wrong     {IMPORT}\n          labs/transforms.py:1 in")


def broken(student):
    return graded(student, BROKEN, missing={"transforms": f"{IMPORT}\nlabs/transforms.py:1 in"})


def class_page(*records, **more):
    return overview.overview(records, COLUMNS, "strict", "as told", **more)


def student_page(one):
    return report.page(one, {}, "as told")


def section(text, title):
    """The text of a section, without tags."""
    found = re.search(rf"<h2[^>]*>{title}</h2>(.*?)(<h2|</body>)", text, re.DOTALL)
    return " ".join(re.sub("<[^>]*>", " ", found[1]).split())


# --- the class --------------------------------------------------------------------------------


def test_the_class_s_page_counts_for_how_many_a_claim_fails():
    """A lab that cannot be imported counts as failing every claim, or who has not begun does."""
    unstarted = record(submission("dan"), result(*(
        entry(asked, "not started", *(check(asked.number, claim, "not started")
                                      for claim in CLAIMS[asked.number]), topic="transforms")
        for asked in COLUMNS)))
    text = class_page(graded("ada"), graded("bob", {"Zero stays": "no"}), broken("cyd"), unstarted,
                      graded("eve", {"Zero stays": "no", "It is half": "no"}))
    assert section(text, "Claims that fail") == (
        "the claim fails for of 1.2 halve Zero stays 2 3 1.2 halve It is half 1 3")


def test_what_is_missing_and_what_is_not_understood_stands_in_the_class_s_page():
    """A file that nobody can have handed in, or a lab that cannot be imported, is never seen."""
    text = class_page(graded("ada"), broken("cyd"), not_understood=[
        ("<img src=x>.rar", "<b>no student can be told from this name")])
    assert section(text, "Not understood") == (
        "&lt;img src=x&gt;.rar &lt;b&gt;no student can be told from this name")
    assert section(text, "Labs that are not there, or cannot be imported") == (
        f"cyd transforms {IMPORT}")


def test_everybody_s_row_tells_time_lateness_points_by_hand_and_seed():
    """LATE is only in the platform's name of a file; nobody sees which marks are by hand."""
    late = record(submission("bob", late=True, when=1e9), found(), seed=77,
                  late=("1 day, 0:00:00", 10))
    late = late._replace(lateness=late.lateness._replace(handed_in="2001-09-09T01:46:40+00:00"))
    agreed = record(submission("eve", late=True), found(), seed=5,
                    overrides={"1.2": (1, "as <agreed>")})
    rows = section(class_page(late, agreed), "Everybody")
    assert rows.startswith("points of 3 handed in late points left by hand seed bob 3")
    assert "2001-09-09 01:46:40+00:00 LATE 1 day, 0:00:00 2.7 77" in rows
    assert "eve 2 LATE 2 1.2: 1 instead of 2 by hand (as &lt;agreed&gt;) 5" in rows


def test_the_class_s_page_says_how_many_are_graded_and_how_well():
    """After Ctrl-C, 2 of 8 rows look like the whole class. Or the median of two is the better one.
    """
    text = class_page(graded("ada"), graded("bob", {"Zero stays": "no"}), waiting=2)
    assert "Submissions: 2 of 4 graded" in text and "2 are still to be graded" in text
    assert section(text, "Distribution").startswith("median 2.5 of 3 points")


def test_a_class_of_which_nothing_could_be_graded_has_a_page():
    """The median of nothing."""
    text = class_page(record(submission("ada"), result(problem="no worker could be started\nno")))
    assert "Submissions: 0 of 1 graded" in text
    assert section(text, "Everybody") == (
        "points of 3 seed problem ada 0 4 no worker could be started")


def test_a_lab_without_exercises_that_count_is_not_missed():
    """Full marks, and below them: "nothing could be checked"."""
    one = graded("ada", missing={"cube_maps": "there is no labs/cube_maps.py"})
    assert "cube_maps" not in student_page(one) + class_page(one)


def test_a_platform_s_number_has_a_name_beside_it():
    """Nobody knows who s1001 is."""
    rows = section(class_page(
        graded(work=submission("s1001", name="Ada <b>")),
        graded(work=submission("lovelaceada_7", "canvas", name="lovelaceada"))), "Everybody")
    assert "s1001 Ada &lt;b&gt; 3" in rows and "lovelaceada_ 7 3 4" in rows


def test_the_class_s_page_begins_with_links_to_its_parts():
    """Everybody's row is below three screens of tables."""
    text = class_page(graded("ada"), broken("cyd"))
    anchors = re.findall(r'<h2 id="([\w-]+)"', text)
    assert anchors == re.findall(r'href="#([\w-]+)"', text) and "everybody" in anchors


# --- a student --------------------------------------------------------------------------------


def test_that_a_lab_cannot_be_imported_is_said_once():
    """The same sentence under every check, and nothing else is found between them."""
    text = student_page(broken("cyd"))
    assert text.count("cannot be imported") == 1 and "claims hold" not in text


def test_what_fails_besides_is_still_said():
    """A lab is lost after its first exercises; what these got wrong is not told any more."""
    wrong = {**BROKEN, "It is twice as much": "expected 2"}
    text = student_page(graded("cyd", wrong, missing={"transforms": IMPORT}))
    assert "expected 2" in text and "1.1 double" in text and text.count("<h2>1.2") == 0


def test_a_student_s_page_names_nobody():
    """A page that was shown to others, or marked without names, tells whose it is."""
    ada = submission("lovelaceada", "canvas", id="12", name="Ada Lovelace", email="ada@x.org",
                     notes=["lovelaceada_12_34_old.zip is older, Ada Lovelace_5.zip not"])
    text = student_page(graded(work=ada, missing={
        "transforms": "there is no labs/transforms.py (lovelaceada.rar: what?)"}))
    assert "ovelace" not in text and "..._12_34_old.zip is older" in text


@pytest.mark.parametrize("make", [
    lambda text: student_page(graded(wrong={"Zero stays": text})),
    lambda text: student_page(graded(work=submission("ada", notes=[text]))),
    lambda text: student_page(graded(lost={"1.1": text}, wrong={"It is twice as much": ""})),
    lambda text: class_page(graded(lost={"1.1": text})),
    lambda text: class_page(not_understood=[(text, text)])],
    ids=["message", "note", "lost", "lost in the class", "not understood"])
def test_megabytes_that_a_student_sends_are_cut(make):
    """Five hundred pages that no browser can open."""
    text = make("<x" * 500_000)
    assert len(text) < 40_000 and "<x" not in text and "characters more)" in text


def test_tables_scroll_by_themselves():
    """On a phone the whole page moves sideways. Or a page may load what a student wrote."""
    text = student_page(graded())
    assert text.count('<div class="wide"><table>') == text.count("<table>") > 0
    assert "default-src 'none'" in text


# --- given back -------------------------------------------------------------------------------


def test_reports_have_the_names_that_platforms_read(tmp_path):
    """Everybody's feedback is refused: Moodle and Canvas know students by numbers in names. Or a
    student reads the report of an earlier run.
    """
    students = "Ada_1200", "lovelaceada", "bob", "cyd", "dan", "50101", "50102", "50103", "eve"
    put(tmp_path, {f"students/{student}/report.html": f"of {student}" for student in students})
    sender, = platforms.senders(tmp_path / "lovelaceada_LATE_12_34_labs.zip", {})
    works = (submission("Ada_1200", "moodle", id="1200", name="Ada_B"),
             submission("lovelaceada")._replace(identity=sender.identity),
             submission("bob", "canvas", id="13", file="bob_13_35_sampling.py"),
             *(submission(member, "people", file="red_7_8_labs.zip") for member in students[5:8]),
             submission("eve", "canvas", id="9", file=r"eve_9_9_..\..\evil.zip"),
             submission("cyd"), submission("without a report"))
    put(tmp_path, {f"students/{student}/report.html": "of red" for student in students[5:7]})
    handback.write(tmp_path, [*(graded(work=one) for one in works),
                              graded("dan").failed("no worker could be started")])
    with zipfile.ZipFile(tmp_path / "feedback.zip") as archive:
        there = {name: archive.read(name) for name in archive.namelist()}
    inner = zipfile.ZipFile(io.BytesIO(there.pop("lovelaceada_LATE_12_34_labs.zip")))
    assert inner.read("report.html") == b"of lovelaceada"
    assert there.pop("eve_9_9_.._.._evil.zip") and there.pop("50103/report.html") == b"of 50103"
    inner = zipfile.ZipFile(io.BytesIO(there.pop("red_7_8_labs.zip")))
    assert inner.read("report.html") == b"of red"
    assert there == {"Participant_1200_assignsubmission_file_/report.html": b"of Ada_1200",
                     "bob/report.html": b"of bob", "cyd/report.html": b"of cyd"}
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == ["feedback.zip"]


