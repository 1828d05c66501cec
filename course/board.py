"""The progress board: what is done, what is not, and what to do next."""
import contextlib
import json
import os
import re
import subprocess
import sys
import time
import webbrowser
from pathlib import Path
from typing import NamedTuple
from unittest import mock

from rich.console import Console
from rich.table import Table

from . import exercises
from .checks import page
from .checks.loader import folder
from .checks.report import rerun
from .checks.runner import run_checks
from .checks.showing import layout
from .given import places

BAR = 20  # characters of a whole lab's bar
LOOK = 0.3  # seconds between two looks at the files that are watched
STYLES = {"done": "green", "failing": "red"}


class Entry(NamedTuple):
    """An exercise on the board, with its checks. It is done when its question is."""

    topic: str
    exercise: exercises.Exercise
    verdict: str  # done, failing, not run, not started, blocked by 2.1, not readable
    checks: list

    @property
    def open_fine_print(self):
        """The checks of a done exercise's fine print that do not pass."""
        return [check for check in self.checks
                if self.verdict == "done" and check.verdict != "passed"]

    @property
    def told(self):
        return f"{self.verdict}{', fine print open' * bool(self.open_fine_print)}"


def check(target=None, implementation="labs", json_file=None, seed=0, pictures=False, extra=False):
    """Run the checks of a lab (2, rasterization), an exercise (2.3) or all, and show the board.

    implementation: labs, reference, or a folder with files like those in labs/.
    json_file: the board is written there, too. pictures: opens what failed, see `open_pictures`.
    extra: extras that are closed are checked as well.
    -> 0 if all that was asked for is done, else 1.
    ValueError: there is no such target or folder, or it is an extra that is not open.
    """
    labs, asked = asked_for(target)
    code = folder(implementation)
    closed = set() if extra else closed_extras(labs, code)
    if not set(asked) - closed:
        raise ValueError(not_open(target, labs, asked))
    asked = [number for number in asked if number not in closed]
    called = called_exercises(labs, code, closed)
    needed = closure(asked, called)
    broken = not_python(labs, code)
    found, problems = run_checks({topic: labs[topic] for topic in labs if topic not in broken},
                                 needed, implementation, seed)
    everything = entries(labs, needed, called, found, broken)
    board = [entry for entry in everything if entry.exercise.number in asked]

    all_is_done = all(entry.verdict == "done" for entry in board)
    Console(force_jupyter=False).print(table(board))
    if closed and target not in asked:
        lab = min(int(number.split(".")[0]) for number in closed)
        print(f"\n{plural(len(closed), 'extra')} more, complete as they came; "
              f"python3 -m course open {lab} empties those of lab {lab}")
    print("", *problems, *broken.values(), *foreign_imports(labs, code), sep="\n")
    if all_is_done:
        print(all_done(board, target))
    if not broken and any(entry.told != "done" for entry in board):
        print(next_to_do(everything, code, implementation, seed))
    if pictures:
        open_pictures(board, seed)
    if json_file:
        places.write_whole(json_file, as_json(board).encode("utf-8"))
    return int(bool(problems) or not all_is_done)


def watch(target=None, implementation="labs", **options):
    """`check`, and again whenever a file of the code under test is saved. Ends with Ctrl-C.

    While checks run, Ctrl-C stops these alone, as where a loop has no end.
    """
    code, seen = folder(implementation), None
    while True:
        files = {path: path.stat().st_mtime_ns for path in code.glob("*.py") if path.exists()}
        if files != seen:
            Console().clear()
            try:
                check(target, implementation, **options)
            except ValueError as error:
                if seen is None:  # what was asked for is not there
                    raise
                print(error)
            seen = files
            print(f"\nWatching {places.shown_path(code)}/; Ctrl-C ends this.", flush=True)
        time.sleep(LOOK)


def show(target=None, implementation="labs"):
    """The board of `check`, in a notebook; in a process of its own, so that labs are read anew."""
    command = [sys.executable, "-m", "course", "check", *filter(None, [target])]
    plain = {**os.environ, "FORCE_COLOR": "", "COLUMNS": "80", "PYTHONIOENCODING": "utf-8"}
    try:
        board = subprocess.run([*command, "--impl", implementation], cwd=places.ROOT, env=plain,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
    except OSError:  # a browser starts no processes
        return show_here(target, implementation, plain)
    print(board.stdout)


def show_here(target, implementation, plain):
    """The board of `check`, made in this process, with other environment variables."""
    with contextlib.chdir(places.ROOT), mock.patch.dict(os.environ, plain):
        try:
            check(target, implementation)
        except ValueError as error:
            print(f"course: {error}")


def asked_for(target):
    """({topic: its exercises}, the numbers of those that are asked for)."""
    topics = {topic: str(exercises.lab_number(topic)) for topic in exercises.asking_topics()}
    labs = {topic: exercises.topic_exercises(topic) for topic, lab in topics.items()
            if target is None or target == topic or target.split(".")[0] == lab}
    asked = [exercise.number for lab in labs.values() for exercise in lab
             if target in (None, *labs, exercise.number) or target in topics.values()]
    if not asked:
        numbers = list(dict.fromkeys(topics.values()))
        raise ValueError(f'there is no lab or exercise "{target}"; give a lab '
                         f"({', '.join(numbers)}), a file of it ({', '.join(topics)}), or an "
                         "exercise, as in 2.1")
    return labs, asked


def closed_extras(labs, code):
    """The numbers of the extras that the code under test marks as closed: complete as they came."""
    closed = set()
    for topic, lab in labs.items():
        with contextlib.suppress(OSError, UnicodeDecodeError):  # its checks say so
            closed |= exercises.closed_extras(lab, exercises.read(code / f"{topic}.py"))
    return closed


def not_open(target, labs, asked):
    """The sentence on a target of which nothing is open."""
    kind, it = (("is an extra, and", "it") if target in asked else
                ("has extras alone, and they are", "them"))
    where = ", ".join(f"labs/{topic}.py" for topic, lab in labs.items()
                      if any(exercise.number in asked for exercise in lab))
    return (f"{target} {kind} complete in {where}; python3 -m course open {target} empties {it} "
            "for you to write")


def not_python(labs, code):
    """{topic: what is wrong with its file, in a line} of the files that Python cannot read."""
    broken = {}
    for topic in labs:
        with contextlib.suppress(OSError):  # not there: its checks say so
            try:
                exercises.top_level_functions(exercises.read(code / f"{topic}.py"))
            except ValueError as error:
                broken[topic] = f"{places.shown_path(code / topic)}.py, {error}"
    return broken


def foreign_imports(labs, code):
    """Sentences on imports that are not there where labs are graded."""
    for topic in labs:
        with contextlib.suppress(OSError, UnicodeDecodeError):
            path = code / f"{topic}.py"
            for line, module in exercises.foreign_imports(exercises.read(path)):
                yield (f"{places.shown_path(path)}, line {line}: {module} is not there when your "
                       "labs are graded; import numpy, scipy, Python's own library and what was "
                       "imported already")


def called_exercises(labs, code, closed=()):
    """{number: numbers of the exercises that the code under test calls in it}, without closed."""
    called = {}
    for topic, lab in labs.items():
        numbers = {exercise.name: exercise.number for exercise in lab
                   if exercise.number not in closed}
        try:
            names = exercises.calls(exercises.read(code / f"{topic}.py"), numbers)
        except (OSError, ValueError):  # not there, or not Python: then it is not called either
            continue
        called |= {numbers[name]: [numbers[other] for other in names[name]] for name in names}
    return called


def closure(numbers, called):
    """These exercises, and all that they call."""
    needed, ends = set(numbers), list(numbers)
    while ends:
        new = set(called.get(ends.pop(), ())) - needed
        needed |= new
        ends += new
    return needed


def entries(labs, needed, called, found, broken=()):
    """The Entry of each needed exercise, in the course's order."""
    of = {number: [check for check in found if check.exercise == number] for number in needed}
    asks = {number: [check for check in of[number] if not check.fine_print] for number in needed}
    done = {number for number in needed
            if asks[number] and all(check.verdict == "passed" for check in asks[number])}

    def verdict(number):
        if number in done:
            return "done"
        verdicts = [check.verdict for check in asks[number]]
        if "failed" in verdicts or not verdicts:
            undone = [other for other in called.get(number, ()) if other not in done]
            return f"blocked by {undone[0]}" if undone else "failing"
        return next((text for text in verdicts if text.startswith(("blocked", "not run"))),
                    "not started")

    return [Entry(topic, exercise,
                  "not readable" if topic in broken else verdict(exercise.number),
                  of[exercise.number])
            for topic, lab in labs.items() for exercise in lab
            if exercise.number in needed]


def table(board):
    """The exercises on the board, lab by lab. A file that is not the lecture's own has a row."""
    rows = Table.grid(padding=(0, 2))
    for number in dict.fromkeys(exercises.lab_number(entry.topic) for entry in board):
        lab = [entry for entry in board if exercises.lab_number(entry.topic) == number]
        reached, of = points(lab)
        bar = ("#" * (BAR * reached // max(of, 1))).ljust(BAR, ".")
        rows.add_row(f"Lab {number}", exercises.LABS[number - 1][0], f"{reached} of {of}", bar,
                     style="bold")
        topic = exercises.LABS[number - 1][0]
        for entry in lab:
            if entry.topic != topic:
                topic = entry.topic
                rows.add_row("", f"{topic}.py", style="dim")
            exercise = entry.exercise
            worth = "extra" if exercise.is_extra else plural(exercise.points, "point")
            rows.add_row(f"{exercise.number:>5}", exercise.name, worth, entry.told,
                         style=STYLES.get(entry.verdict))
    return rows


def points(board):
    """(points reached, points in all) of the core: an exercise gives all of its points, or none."""
    core = [entry for entry in board if not entry.exercise.is_extra]
    return (sum(entry.exercise.points for entry in core if entry.verdict == "done"),
            sum(entry.exercise.points for entry in core))


def plural(count, word):
    return f"{count} {word}{'s' * (count != 1)}"


def next_to_do(entries, code, implementation, seed):
    """The first claim that fails, and why, in the first exercise that can be worked on.

    The fine print comes when there is nothing else to do.
    """
    entries = sorted(entries, key=lambda entry: tuple(map(int, entry.exercise.number.split("."))))
    undone = [entry for entry in entries if entry.verdict != "done"]
    ready = [entry for entry in undone if "blocked" not in entry.verdict]
    entry = (ready or undone or [entry for entry in entries if entry.open_fine_print])[0]
    topic, exercise, verdict, found = entry
    wrong = [check for check in found if check.verdict != "passed"]
    wrong.sort(key=lambda check: (check.fine_print, check.verdict != "failed"))
    lines = [f"Left: the fine print of {exercise.number} {exercise.name}" if verdict == "done" else
             f"Next: {exercise.number} {exercise.name}, {verdict}"]
    if verdict == "failing" and found:
        not_run = sum(check.verdict == "not run" for check in found)
        lines = [f"{lines[0]} in {len(wrong) - not_run} of {plural(len(found), 'check')}"
                 f"{f', {not_run} not run' * bool(not_run)}"]
    if not found:
        lines += [layout([("wrong", f"it has no check in tests/labs/test_{topic}.py")])]
    if wrong:
        lines += [layout([("claim", wrong[0].claim)])]
        lines += [wrong[0].message] * (verdict != "not started")
    number = verdict.removeprefix("blocked by ") if "blocked" in verdict else exercise.number
    rows = [("again", rerun(number, implementation, seed)),
            ("read", reading(topic, exercise, code))]
    if verdict != "done" and exercises.reference(topic).exists():
        put_in = f"python3 -m course close {exercise.number} --core puts it in; "
        rows.append(("stuck", f"{put_in * (verdict == 'not started')}the solution is in "
                              f"reference/{topic}.py"))
    return "\n".join([*lines, layout(rows)])


def reading(topic, exercise, code):
    """Where an exercise's question stands, and its lecture."""
    line = exercise.line
    with contextlib.suppress(OSError, ValueError):
        lines = {function.name: function.lineno for function in
                 exercises.top_level_functions(exercises.read(code / f"{topic}.py"))}
        line = lines.get(exercise.name, line)
    question = f"{places.shown_path(code / topic)}.py:{line}, the docstring is the question"
    lecture = exercises.lecture(topic)
    if not lecture.exists():
        return question
    section = section_of(lecture, exercise)
    titled = f", section\n  {section}" if section else ""
    return f"{question}\n{places.shown_path(lecture)}{titled}"


def section_of(lecture, exercise):
    """The title of the notebook's section that is about an exercise, or that names it; or none."""
    sections, title = {}, ""
    with contextlib.suppress(OSError, ValueError, KeyError):
        for cell in json.loads(lecture.read_bytes())["cells"]:
            for line in "".join(cell["source"]).splitlines():
                heading = re.match("##+ (.*)", line) if cell["cell_type"] == "markdown" else None
                title = heading[1] if heading else title
                sections[title] = f"{sections.get(title, '')}{line}\n"
    sections.pop("", None)
    last = "Exercises" if sections.pop("Exercises", None) else None
    name = re.escape(exercise.name)
    for title, text in sections.items():
        if exercise.number in exercises_in(text):
            return title
    for pattern in rf"`{name}`", rf"\b{name}\b":
        for title, text in sections.items():
            if re.search(pattern, text):
                return title
    return last


def exercises_in(text):
    """The numbers in the lines that say which exercises a section leads to, as 7.10 to 7.16."""
    numbers = set()
    for line in re.findall(r"\*(?:Exercise|Extra)s? \d.*|\((?:`\w+`, )?extra \d[^)]*", text):
        for lab, first, last in re.findall(r"(\d+)\.(\d+)(?: to (?:\d+\.)?(\d+))?", line):
            numbers |= {f"{lab}.{k}" for k in range(int(first), int(last or first) + 1)}
    return numbers


def open_pictures(board, seed):
    """Print where the pictures of failed checks are. Open a page with all that failed, if any did.

    Where there is no browser to open it with, its path is all.
    """
    paths = {Path(check.picture) for entry in board for check in entry.checks if check.picture}
    failing = [entry for entry in json.loads(as_json(board))["exercises"]
               if entry["verdict"] == "failing"]
    if not failing:
        return
    pictures = {path.name: path.read_bytes() for path in paths}
    file = places.out("checks", "failed.html")
    places.write_whole(file, page.document("What failed", *(
        part for entry in failing
        for part in page.exercise_part(entry, None, pictures, seed))).encode("utf-8"))
    print("", "Pictures, all of them in the last:",
          *map(places.shown_path, [*sorted(paths), file]), sep="\n")
    webbrowser.open(file.as_uri())


def all_done(board, target):
    """The points, and what comes next: another lab, or the rest of this one."""
    reached, of = points(board)
    lab = exercises.lab_number(board[-1].topic)
    later = [number for number in map(exercises.lab_number, exercises.asking_topics())
             if number > lab]
    coming = "python3 -m course check, for the rest"
    if target not in (None, str(lab)):
        coming = f"python3 -m course check {lab}, for the rest of the lab"
    elif later:
        coming = f"lab {later[0]}, {exercises.LABS[later[0] - 1][0]}"
    return f"All that was asked for is done, {reached} of {plural(of, 'point')}. Next: {coming}."


def as_json(board):
    """{"points", "of", "exercises": [{number, name, topic, points, extra, verdict, told,
    checks}]}.
    """
    reached, of = points(board)
    lines = [{"number": exercise.number, "name": exercise.name, "topic": topic,
              "points": exercise.points, "extra": exercise.is_extra, "verdict": entry.verdict,
              "told": entry.told, "checks": [check._asdict() for check in entry.checks]}
             for entry in board for topic, exercise in [entry[:2]]]
    return json.dumps({"points": reached, "of": of, "exercises": lines}, indent=2) + "\n"
