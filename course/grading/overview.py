"""The class's page: marks, what is hard, which claims fail, what was lost, late or alike.

Names of files and students, and messages, come from students: all of them are escaped.
"""
import collections

from ..checks.page import Markup, bar, breakable, document, escaped, paragraph, rows
from .lateness import iso
from .marks import after_lateness, is_graded, points, told_by_hand, total
from .report import is_of_the_lab, missing
from .sheets import shown

MOST_CLAIMS = 60  # in the table of those that fail
MOST_PAIRS = 20   # of those that are alike; similar.csv has all


def overview(records, exercises, level, about, not_understood=(), alike=None):
    """records: of grade.run. exercises: those that count. not_understood: [(name, sentence)].

    alike: what `similarity.pairs` found; None where nobody has looked yet.
    """
    graded = [record for record in records if is_graded(record)]
    parts = [paragraph(f"{len(graded)} of {len(records)} submissions graded; isolation {level} "
                       f"({about})"),
             *part("Not understood", not_understood),
             *(marks(graded, exercises) if graded else ()),
             *part("Claims that fail", failing_claims(graded),
                   ["", "", "the claim", "fails for", "of"]),
             *part("Labs that are not there, or cannot be imported", [
                 [student_link(record["student"]), topic, first_line(why)]
                 for record in records for topic, why in missing(record).items()]),
             *part("Crashes, time-outs, and worse", [
                 [student_link(record["student"]), number, sentence]
                 for record in records for number, sentence in record["lost"].items()]),
             *alike_part(alike),
             *part("Everybody", *everybody(records, exercises))]
    return document("Grades", *parts)


def part(title, lines, head=None):
    """A title and its table. Nothing where the table would be empty."""
    return [f"<h2>{title}</h2>", rows(lines, head)] if lines else []


def student_link(name):
    return Markup(f'<a href="students/{escaped(name)}/report.html">{breakable(name)}</a>')


def first_line(text):
    return text.partition("\n")[0]


# --- the exercises ----------------------------------------------------------------------------


def marks(graded, exercises):
    of = sum(exercise.points for exercise in exercises)
    totals = [total(record) for record in graded]
    middle = sorted(totals)[len(totals) // 2]
    return ["<h2>Distribution</h2>", paragraph(f"median {shown(middle)} of {of} points"),
            distribution(totals, of), "<h2>Exercises, the hardest first</h2>",
            hardest(graded, exercises)]


def distribution(totals, of):
    """Ten bars: how many reached each tenth of the points."""
    counts = [0] * 10
    for reached in totals:
        counts[min(9, int(10 * reached // max(of, 1)))] += 1
    return rows([[f"{10 * tenth} to {10 * tenth + 10} %", count, bar(count, max(counts))]
                 for tenth, count in enumerate(counts)])


def hardest(graded, exercises):
    solved = {exercise.number: sum(points(record).get(exercise.number, 0) > 0 for record in graded)
              for exercise in exercises}
    order = sorted(exercises, key=lambda exercise: solved[exercise.number])
    return rows([[exercise.number, exercise.name, solved[exercise.number],
                  bar(solved[exercise.number], len(graded))] for exercise in order],
                ["", "", "solved by", f"of {len(graded)}"])


def failing_claims(graded):
    """Rows of the claims that most fail, among those whose lab is there and who began."""
    tried, failed = collections.Counter(), collections.Counter()
    for record in graded:
        for entry in record["board"]["exercises"] if record["board"] else ():
            for check in entry["checks"]:
                claim = entry["number"], entry["name"], check["claim"]
                if check["verdict"] in ("passed", "failed") and not is_of_the_lab(
                        check, entry["topic"], record):
                    tried[claim] += 1
                    failed[claim] += check["verdict"] == "failed"
    return [[*claim, count, tried[claim], bar(count, tried[claim])]
            for claim, count in failed.most_common(MOST_CLAIMS) if count]


# --- the students -----------------------------------------------------------------------------


def everybody(records, exercises):
    """(rows, head). A column that would be empty for all is left out."""
    of = sum(exercise.points for exercise in exercises)
    columns = {
        "": lambda record: student_link(record["student"]),
        "points": lambda record: number(total(record)),
        f"of {of}": lambda record: bar(total(record), of),
        "handed in": handed_in,
        "late": lateness,
        "points left": lambda record: number(after_lateness(record)) if lateness(record) else "",
        "by hand": lambda record: "; ".join(told_by_hand(record)),
        "seed": lambda record: str(record.get("seed", "")),
        "problem": lambda record: first_line(record["problem"] or ""),
        "notes": lambda record: "; ".join(record["notes"])}
    table = {head: [cell(record) for record in records] for head, cell in columns.items()}
    table = {head: cells for head, cells in table.items() if any(cell != "" for cell in cells)}
    return list(zip(*table.values(), strict=True)), list(table)


def number(reached):
    return int(reached) if reached == int(reached) else reached


def handed_in(record):
    when = record.get("handed_in")
    told = record.get("lateness", {}).get("handed in") or ("" if when is None else iso(when, None))
    return told.replace("T", " ")


def lateness(record):
    """LATE where the platform says so, and by how much, where that is known."""
    by = record.get("lateness", {}).get("late by", "")
    return " ".join(filter(None, ["LATE" * bool(record.get("late")), by]))


def alike_part(pairs):
    if pairs is None:
        return []
    link = '<a href="similar.html">side by side</a>, <a href="similar.csv">as a table</a>'
    return ["<h2>Alike, for a person to judge</h2>",
            f'<p class="note">Pairs of students whose answers are alike beyond what the questions '
            f"force: {len(pairs)} ({link}). This takes no points.</p>",
            *([rows([[student_link(pair.first), student_link(pair.second), pair.nodes]
                     for pair in pairs[:MOST_PAIRS]])] if pairs else [])]
