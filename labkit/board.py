"""The progress board, a screen: what is done, what is not, and what to do next."""
import ast
import contextlib
import functools
import os
import re
import subprocess
import sys
import webbrowser
from pathlib import Path

from . import exercises, places, verdicts
from .checks import page
from .checks.loader import folder
from .checks.report import rerun
from .checks.showing import layout, plural
from .table import COMMAND, NAME, WHEN_DONE

BAR = 20  # characters of a whole lab's bar
MOST_CLAIMS = 3  # shown of the other claims that fail
STYLES = {"done": "green", "failing": "red"}


def check(target: str | None = None, implementation: str = "labs", seed: int = 0,
          pictures: bool = False, extra: bool = False) -> int:
    """Run the checks of a lab (2, rasterization), an exercise (2.3) or all, and show the board.

    implementation: labs, reference, or a folder with files like those in labs/.
    pictures: opens what failed, see `open_pictures`. extra: extras that are closed are checked as
    well.
    -> 0 if all that was asked for is done, and nothing of it would be lost in grading, else 1.
    ValueError: there is no such target or folder, or it is an extra that is not open.
    """
    from rich.console import Console  # the web site's pages have none
    found = verdicts.run(target, implementation, seed, extra)
    Console(force_jupyter=False).print(table(found.asked))
    print(*below(found, target, implementation, seed), sep="\n")
    if pictures:
        open_pictures(found.asked, seed)
    return int(bool(found.problems or found.losses) or not found.all_is_done)


def below(found, target, implementation, seed):
    """Yield what stands below the table: what was left out or is wrong, and what to do next."""
    if found.closed and target not in [entry.number for entry in found.asked]:
        lab = min(int(number.split(".")[0]) for number in found.closed)
        yield (f"\n{plural(len(found.closed), 'extra')} more, complete as they came; "
               f"{COMMAND} open {lab} empties those of lab {lab}")
    yield from ("", *found.problems, *found.broken.values(), *found.warnings)
    if found.all_is_done:
        yield all_done(found.asked)
    if not found.broken and any(entry.told != "done" for entry in not_passed_by(found.asked)):
        yield next_to_do(found.needed, implementation, seed)
    yield from found.losses


def show(target: str | None = None, implementation: str = "labs") -> None:
    """The board of `check`, in a notebook; in a process of its own, so that labs are read anew."""
    command = [sys.executable, "-m", NAME, "check", *filter(None, [target])]
    plain = {**os.environ, "FORCE_COLOR": "", "COLUMNS": "80", "PYTHONIOENCODING": "utf-8"}
    board = subprocess.run([*command, "--impl", implementation], cwd=places.ROOT, env=plain,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
    print(board.stdout)


def table(board):
    """The exercises on the board, lab by lab. A file that is not the lecture's own has a row."""
    from rich.table import Table
    rows, topic = Table.grid(padding=(0, 2)), None
    for entry in board:
        number = exercises.lab_number(entry.topic)
        own = exercises.LABS[number - 1][0]
        if topic is None or exercises.lab_number(topic) != number:
            topic = own
            rows.add_row(*title_row(number, own, board), style="bold")
        if entry.topic != topic:
            topic = entry.topic
            rows.add_row("", f"{topic}.py", style="dim")
        worth = f"{entry.reached:g} of {entry.points}" if entry.points else "step"
        worth = "extra" if entry.extra else worth
        rows.add_row(f"{entry.number:>5}", entry.name, worth, entry.told,
                     style=STYLES.get(entry.verdict))
    return rows


def title_row(number, topic, board):
    """A lab, its own topic, its points, and a bar that shows these."""
    reached, of = verdicts.points([entry for entry in board
                                   if exercises.lab_number(entry.topic) == number])
    bar = ("#" * int(BAR * reached / max(of, 1))).ljust(BAR, ".")
    return f"Lab {number}", topic, *((f"{reached:g} of {of}", bar) if of else ())


def next_to_do(entries, implementation, seed):
    """The first claim that fails, and why, in the first exercise that can be worked on.

    The fine print comes when there is nothing else to do.
    """
    entries = not_passed_by(entries)
    undone = [entry for entry in entries if entry.verdict != "done"]
    ready = [entry for entry in undone if not entry.blocked_by]
    entry = (ready or undone or [entry for entry in entries if entry.fine_print_open])[0]
    wrong = [check for check in entry.checks if check.verdict != "passed"]
    wrong.sort(key=lambda check: (check.fine_print, check.verdict != "failed"))
    lines = [headline(entry)]
    if entry.verdict == "failing" and entry.claims[1]:
        lines.append(layout([("points", entry.told_points(entry.reached))]))
    if not entry.checks:
        lines.append(layout([("wrong", f"it has no check in tests/labs/test_{entry.topic}.py")]))
    if wrong:
        lines.append(layout([("claim", wrong[0].claim)]))
    if wrong and entry.verdict != "not started":
        lines.append(wrong[0].message)
    return "\n".join([*lines, layout([*also(wrong), *seen(wrong),
                                      *ways_on(entry, implementation, seed)])])


def seen(wrong):
    """A row, or none: a picture of what came beside what was expected, of another check that fails.
    """
    pictures = [check for check in wrong if check.picture]
    if pictures and pictures[0] is not wrong[0]:
        yield "picture", f"{places.shown_path(pictures[0].picture)}\n{pictures[0].claim}"


def also(wrong):
    """A row, or none: which other claims fail, where no hint is of all that is wrong."""
    if wrong and not re.match("hint +(?! |in )", wrong[0].message):
        _, *others = dict.fromkeys(check.claim.partition(" [")[0] for check in wrong
                                   if check.fine_print == wrong[0].fine_print)
        more = [f"{len(others) - MOST_CLAIMS} more"] if len(others) > MOST_CLAIMS else []
        if others and wrong[0].verdict == "failed":
            yield "fails too", "; ".join([*others[:MOST_CLAIMS], *more])


def not_passed_by(entries):
    """The entries in a lecture's order, without steps that a student has passed by: not begun,
    though what comes after them is, and nothing waits for them.
    """
    kept, waiting, begun = [], {entry.blocked_by for entry in entries}, False
    for entry in reversed(in_lecture_order(entries)):
        is_open = entry.points or entry.verdict != "not started" or entry.number in waiting
        if is_open or not begun:
            kept.insert(0, entry)
        if entry.points:
            begun = entry.verdict != "not started"
    return kept


def in_lecture_order(entries):
    """Lab by lab, in the order in which a lecture reaches its exercises."""
    topics = {exercises.LABS[exercises.lab_number(entry.topic) - 1] for entry in entries}
    reached = {number: place for own, *_ in topics
               for place, number in enumerate(sections(*exercises.pages(own)))}

    def place(entry):
        lab, rank = map(int, entry.number.split("."))
        return lab, reached.get(entry.number, len(reached)), rank

    return sorted(entries, key=place)


def headline(entry):
    """Which exercise is next, and how it is with it."""
    if entry.verdict == "done":
        return f"Left: the fine print of {entry.number} {entry.name}"
    line = f"Next: {entry.number} {entry.name}, {entry.verdict}"
    if entry.verdict != "failing" or not entry.checks:
        return line
    not_run = sum(check.verdict == "not run" for check in entry.checks)
    return f"{line}, {plural(not_run, 'check')} not run" if not_run else line


def ways_on(entry, implementation, seed):
    """Rows: what runs the checks again, what to read, and what helps who is stuck."""
    yield "again", rerun(entry.blocked_by or entry.number, implementation, seed)
    if entry.verdict == "failing" and (used := elsewhere(entry, folder(implementation))):
        yield "uses", f"your own {', '.join(used)}: a mistake there shows here, too"
    yield "read", reading(entry, folder(implementation))
    if entry.verdict != "done" and exercises.reference(entry.topic).exists():
        solution = f"the solution is in reference/{entry.topic}.py"
        if entry.verdict == "not started" or entry.blocked_by:
            puts_in = f"{COMMAND} close {entry.blocked_by or entry.number} --core puts it in"
            solution = puts_in if entry.blocked_by else f"{puts_in}; {solution}"
        yield "stuck", solution


def elsewhere(entry, code):
    """["2.6 rasterize"]: the exercises of other files that one calls, as rasterization.rasterize.
    """
    called = set()
    with contextlib.suppress(OSError, ValueError):  # its checks say so
        functions = exercises.top_level_functions(exercises.read(code / f"{entry.topic}.py"))
        called = {ast.unparse(node.func) for function in functions if function.name == entry.name
                  for node in ast.walk(function) if isinstance(node, ast.Call)}
    return [f"{one.number} {one.name}" for topic in exercises.topics()
            for one in exercises.topic_exercises(topic) if f"{topic}.{one.name}" in called]


def reading(entry, code):
    """Where an exercise's question stands, and its lecture or the page after it."""
    question = (f"{places.shown_path(code / entry.topic)}.py:{line_of(entry, code)}, "
                "the docstring is the question")
    paths = exercises.pages(entry.topic)
    if not paths:
        return question
    path, section = sections(*paths).get(entry.number, (paths[0], None))
    titled = f", section\n  {section}" if section else ""
    return f"{question}\n{places.shown_path(path)}{titled}"


def line_of(entry, code):
    """The line of an exercise in the code under test, or else where it came from."""
    lines = []
    for path in code / f"{entry.topic}.py", exercises.questions(entry.topic):
        with contextlib.suppress(OSError, ValueError):
            functions = exercises.top_level_functions(exercises.read(path))
            lines += [function.lineno for function in functions if function.name == entry.name]
    return lines[0] if lines else 1


@functools.cache
def sections(*paths):
    """{exercise: notebook, and title of the section that leads to it}, in the notebooks' order."""
    found = {}
    for path in paths:
        title = None
        with contextlib.suppress(OSError, ValueError, KeyError):  # a student may have changed it
            for line in "\n".join(exercises.cells(path)).splitlines():
                if line.startswith("##"):
                    title = line.lstrip("# ")
                for number in numbers_in(line):
                    found.setdefault(number, (path, title))
    return found


def numbers_in(line):
    """Yield the numbers in a line that says which exercises a section leads to, as 7.10 to 7.16."""
    for part in re.findall(r"\*(?:Exercise|Step|Extra)s? \d.*|\((?:`\w+`, )?extra \d[^)]*", line):
        for lab, first, last in re.findall(r"(\d+)\.(\d+)(?: to (?:\d+\.)?(\d+))?", part):
            yield from (f"{lab}.{k}" for k in range(int(first), int(last or first) + 1))


def open_pictures(board, seed):
    """Print where the pictures of failed checks are. Open a page with all that failed, if any did.

    Where there is no browser to open it with, its path is all.
    """
    paths = {Path(check.picture) for entry in board for check in entry.checks if check.picture}
    failing = [entry for entry in board if entry.verdict == "failing"]
    if not failing:
        return
    pictures = {path.name: path.read_bytes() for path in paths}
    file = places.out("checks", "failed.html")
    parts = [part for entry in failing
             for part in page.exercise_part(entry, entry.reached, None, pictures, seed)]
    places.write_whole(file, page.document("What failed", *parts).encode("utf-8"))
    print("", "Pictures, all of them in the last:",
          *map(places.shown_path, [*sorted(paths), file]), sep="\n")
    webbrowser.open(file.as_uri())


def all_done(board):
    """The points, and what comes next: the rest of the lab, or a later one, or the reward."""
    reached, of = verdicts.points(board)
    worth = f", {reached:g} of {plural(of, 'point')}" if of else ""
    return (f"All that was asked for is done{worth}. "
            f"Next: {coming({entry.number for entry in board}, board[-1].topic)}.")


def coming(done, topic):
    """What comes after these exercises, the last of which is of this topic: in its lab, then in
    those after it, then in those before it.
    """
    lab = exercises.lab_number(topic)
    topics = sorted(exercises.asking_topics(), key=lambda one: exercises.lab_number(one) < lab)
    left = next((exercises.lab_number(topic) for topic in topics
                 for one in exercises.topic_exercises(topic)
                 if one.points and one.number not in done and not one.is_extra), None)
    if left is None:
        return WHEN_DONE
    if left == lab:
        return f"{COMMAND} check {lab}, for the rest of the lab"
    if left > lab:
        return f"lab {left}, {exercises.LABS[left - 1][0]}"
    return f"{COMMAND} check, for the rest"
