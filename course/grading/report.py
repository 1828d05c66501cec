"""The pages: one for each student, one for the class. Whatever comes from students is escaped."""
import html

from ..checks.page import coloured, document, exercise_part, paragraph
from .marks import after_lateness, is_graded, points, told, total
from .sheets import shown


def rows(lines, head=None):
    """lines: rows of cells. A number is set to the right, what begins with < is HTML."""
    def cell(content, tag):
        kind = ' class="number"' if isinstance(content, int | float) else ""
        text = str(content)
        return f"<{tag}{kind}>{text if text.startswith('<') else html.escape(text)}</{tag}>"

    table = [[*(cell(content, "td") for content in line)] for line in lines]
    if head:
        table.insert(0, [cell(content, "th") for content in head])
    return "\n".join(["<table>", *(f"<tr>{''.join(line)}</tr>" for line in table), "</table>"])


def bar(part, whole):
    return f'<div class="bar"><i style="width:{100 * part / max(whole, 1):.0f}%"></i></div>'


# --- one student ------------------------------------------------------------------------------


def page(record, pictures, about, seed):
    """record: of grade.run. pictures {file name: PNG}."""
    board = record["board"]
    of = sum(entry["points"] for entry in board["exercises"])
    parts = [paragraph(f"{shown(after_lateness(record))} of {of} points", "claim"),
             *map(paragraph, (*told(record), *record["notes"])), board_table(board, points(record))]
    for entry in board["exercises"]:
        if entry["verdict"] == "failing" or entry["told"] != entry["verdict"]:
            parts += exercise_part(entry, record["lost"].get(entry["number"]), pictures, seed)
    parts += ["<h2>How this was found</h2>", paragraph(
        f"Isolation {record['level']} ({about}); seed {seed}; {record['seconds']:.1f} s; "
        f"hash of what was handed in {record['digest']}.")]
    return document(record["student"], *parts)


def board_table(board, reached):
    """reached {exercise: points}."""
    lines, topic = [], None
    for entry in board["exercises"]:
        if entry["topic"] != topic:
            topic = entry["topic"]
            lab = [other for other in board["exercises"] if other["topic"] == topic]
            got = sum(reached[other["number"]] for other in lab)
            of = sum(other["points"] for other in lab)
            lines.append([f"<strong>{html.escape(topic)}</strong>", "", got, of, bar(got, of)])
        lines.append([entry["number"], entry["name"], reached[entry["number"]], entry["points"],
                      coloured(entry["told"])])
    return rows(lines, ["", "", "points", "of", ""])


def gradescope(record, about):
    """Gradescope's results.json."""
    tests, reached = [], points(record)
    for entry in record["board"]["exercises"]:
        done = entry["verdict"] == "done"
        wrong = [f"{check['claim']}\n{check['message']}" for check in entry["checks"]
                 if check["verdict"] != "passed"]
        tests.append({"number": entry["number"], "name": entry["name"],
                      "score": reached[entry["number"]], "max_score": entry["points"],
                      "status": "passed" if done else "failed", "output_format": "text",
                      "output": "\n\n".join([entry["told"], *wrong]) if wrong else ""})
    about = f"isolation {record['level']} ({about}), hash {record['digest']}"
    return {"score": after_lateness(record),
            "output": "\n".join([*told(record), *record["notes"], about]),
            "output_format": "text", "execution_time": round(record["seconds"]),
            "stdout_visibility": "hidden", "tests": tests}


# --- the class --------------------------------------------------------------------------------


def overview(records, exercises, level, about):
    """Distribution, exercises by how many solved them, what was lost, everybody."""
    graded = [record for record in records if is_graded(record)]
    of = sum(exercise.points for exercise in exercises)
    totals = [total(record) for record in graded]
    parts = [paragraph(f"{len(graded)} of {len(records)} submissions graded; isolation {level} "
                       f"({about})")]
    if graded:
        middle = sorted(totals)[len(totals) // 2]
        parts += ["<h2>Distribution</h2>", paragraph(f"median {shown(middle)} of {of} points"),
                  distribution(totals, of), "<h2>Exercises, the hardest first</h2>",
                  hardest(graded, exercises)]
    lost = [[student_link(record["student"]), number, sentence] for record in records
            for number, sentence in record["lost"].items()]
    if lost:
        parts += ["<h2>Crashes, time-outs, and worse</h2>", rows(lost)]
    parts += ["<h2>Everybody</h2>", rows(
        [[student_link(record["student"]), total(record), bar(total(record), of),
          record["problem"] or ""] for record in records])]
    return document("Grades", *parts)


def student_link(name):
    name = html.escape(name)
    return f'<a href="students/{name}/report.html">{name}</a>'


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
