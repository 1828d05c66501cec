"""The class's page: marks, what is hard, which claims fail, what was lost, late or unusual.

Names of files and students, and messages, come from students: all of them are escaped.
"""
import collections
import re
import statistics

from ...checks.page import Markup, bar, breakable, document, escaped, paragraph, rows
from ..gradebook.sheets import in_one_cell, number_text
from ..gradebook.worth import after_lateness, is_graded, override_sentences, points, total
from ..handing.submissions import tidy
from .report import is_of_the_lab, missing

MOST_CLAIMS = 60  # in the table of those that fail
MOST_SIGNS = 8    # of a student's unusual things
ABOUT_UNUSUAL = ("Code that reaches outside of a lab, and files that are equal. Each may have a "
                 "good reason. This takes no points.")
STYLE = """
body { max-width: 76rem; } .contents a { margin-right: 1rem; white-space: nowrap; }
td > a { display: inline-block; min-width: min(11rem, 28vw); }
td:last-child:not(:has(.bar)) { min-width: 14rem; }
@media (max-width: 45rem) { .bar { width: 2.5rem; } }
"""


def overview(records, exercises, level, about, not_understood=(), unusual=(), waiting=0) -> str:
    """exercises: those that count. not_understood: [(name, sentence)].

    unusual: of `unusual.by_student`. waiting: how many are not graded yet.
    """
    graded = [record for record in records if is_graded(record)]
    sections = {
        "Not understood": table(not_understood),
        "Distribution": distribution(graded, exercises),
        "Exercises, the hardest first": hardest(graded, exercises),
        "Claims that fail": table(failing_claims(graded), ["", "the claim", "fails for", "of"]),
        "Labs that are not there, or cannot be imported": table([
            [student_link(record.work.student), topic, first_line(why)]
            for record in records for topic, why in missing(record).items()]),
        "Crashes, time-outs, and worse": table([
            [student_link(record.work.student), number, sentence]
            for record in records for number, sentence in record.result.lost.items()]),
        "Unusual, for a person to judge": unusual_part(unusual),
        "Everybody": table(*everybody(records, exercises))}
    sections = {title: content for title, content in sections.items() if content}
    about = (f"Submissions: {len(graded)} of {len(records) + waiting} graded; isolation {level} "
             f"({about})" + f"; {waiting} are still to be graded" * bool(waiting))
    return document("Grades", paragraph(about), contents(sections), *(
        f'<h2 id="{anchor(title)}">{title}</h2>\n{content}'
        for title, content in sections.items()), style=STYLE)


def table(lines, head=None):
    """The table of these rows, or nothing where it would be empty."""
    return rows(lines, head) if lines else ""


def contents(titles):
    """A line of links: in a large class, the last part is far below."""
    links = (f'<a href="#{anchor(title)}">{title.partition(",")[0]}</a>' for title in titles)
    return f'<p class="contents">{" ".join(links)}</p>'


def anchor(title):
    return re.sub(r"\W+", "-", title.lower())


def student_link(name):
    return Markup(f'<a href="students/{escaped(name)}/report.html">{breakable(name)}</a>')


def first_line(text):
    return text.partition("\n")[0]


# --- the exercises ----------------------------------------------------------------------------


def distribution(graded, exercises):
    """The median, and ten bars: how many reached each tenth of the points."""
    if not graded:
        return ""
    of = sum(exercise.points for exercise in exercises)
    totals = [*map(total, graded)]
    counts = collections.Counter(min(9, int(10 * reached // max(of, 1))) for reached in totals)
    return "\n".join([
        paragraph(f"median {number_text(statistics.median(totals))} of {of} points"),
        rows([[f"{10 * tenth} to {10 * tenth + 10} %", counts[tenth],
               bar(counts[tenth], max(counts.values()))] for tenth in range(10)])])


def hardest(graded, exercises):
    solved = {exercise.number: sum(points(record).get(exercise.number, 0) >= exercise.points
                                   for record in graded) for exercise in exercises}
    order = sorted(exercises, key=lambda exercise: solved[exercise.number])
    return table([[exercise.number, exercise.name, solved[exercise.number],
                   bar(solved[exercise.number], len(graded))] for exercise in order],
                 ["", "", "solved by", f"of {len(graded)}"]) if graded else ""


def failing_claims(graded):
    """Rows of the claims that most fail, among those whose lab is there and who began."""
    tried, failed = collections.Counter(), collections.Counter()
    for record in graded:
        for entry in record.result.entries:
            for check in entry.checks:
                claim = f"{entry.number} {entry.name}", check.claim
                if check.verdict in ("passed", "failed") and not is_of_the_lab(
                        check, entry.topic, record):
                    tried[claim] += 1
                    failed[claim] += check.verdict == "failed"
    return [[*claim, count, tried[claim], bar(count, tried[claim])]
            for claim, count in failed.most_common(MOST_CLAIMS) if count]


# --- the students -----------------------------------------------------------------------------


def everybody(records, exercises):
    """(rows, head). A column that would be empty for all is left out."""
    of = sum(exercise.points for exercise in exercises)
    columns = {
        "": lambda record: student_link(record.work.student),
        "name": name_besides,
        "points": lambda record: float(total(record)),
        f"of {of}": lambda record: bar(total(record), of),
        "handed in": lambda record: record.lateness.handed_in.replace("T", " "),
        "late": lateness,
        "points left": lambda record: after_lateness(record) if lateness(record) else "",
        "by hand": lambda record: in_one_cell(override_sentences(record)),
        "seed": lambda record: str(record.how.seed),
        "problem": lambda record: first_line(record.result.problem or ""),
        "notes": lambda record: in_one_cell(record.work.notes)}
    table = {head: [cell(record) for record in records] for head, cell in columns.items()}
    table = {head: cells for head, cells in table.items() if any(cell != "" for cell in cells)}
    return list(zip(*table.values(), strict=True)), list(table)


def name_besides(record):
    """The student's name, where the row has a number or an address of a platform."""
    name = record.work.identity.name
    return "" if record.work.student.startswith(tidy(name)[:20]) else name


def lateness(record):
    """LATE where the platform says so, and by how much, where that is known."""
    return " ".join(filter(None, ["LATE" * bool(record.work.late), record.lateness.late_by]))


def unusual_part(students):
    shown = []
    for student, signs in students:
        shown += [[student_link(student), file_link(student, sign), sign.reason]
                  for sign in signs[:MOST_SIGNS]]
        if len(signs) > MOST_SIGNS:
            shown.append([student_link(student), "", f"and {len(signs) - MOST_SIGNS} more"])
    return shown and f"{paragraph(ABOUT_UNUSUAL)}\n{table(shown)}"


def file_link(student, sign):
    return Markup(f'<a href="code/{escaped(student)}/{sign.name}.py">'
                  f"{sign.name}.py:{sign.line}</a>")
