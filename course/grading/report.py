"""A student's page, and Gradescope's results. Whatever comes from students is escaped.

The page names nobody, so that it can be given back, and shown, in any way: see `handback`.
"""
import re

from .. import verdicts
from ..checks.page import (
    Markup,
    bar,
    coloured,
    document,
    escaped,
    exercise_part,
    paragraph,
    preformatted,
    rows,
)
from .marks import after_lateness, points, told
from .sheets import shown

IMPORT = "cannot be imported"  # so `examine` says of a lab


def page(record, pictures, about):
    """record: of grade.run. pictures {file name: PNG}."""
    board, seed = record["board"], record["seed"]
    of = sum(entry["points"] for entry in board["exercises"])
    notes = (unnamed(note, record) for note in record["notes"])
    parts = [paragraph(f"{shown(after_lateness(record))} of {of} points", "claim"),
             *map(paragraph, (*told(record), *notes)), board_table(board, points(record))]
    for topic, why in missing(record).items():
        parts += [f"<h2>{topic}: nothing could be checked</h2>",
                  preformatted(why if IMPORT in why else unnamed(why, record))]
    for entry in board["exercises"]:
        if needs_a_part(entry, record):
            lost = record["lost"].get(entry["number"])
            parts += exercise_part(verdicts.entry_of(entry), lost, pictures, seed)
    parts += ["<h2>How this was found</h2>", paragraph(
        f"Isolation {record['level']} ({about}); seed {seed}; {record['seconds']:.1f} s; "
        f"hash of what was handed in {record['digest']}.")]
    return document("Report", *parts)


def unnamed(sentence, record):
    """The sentence without the student's name, which stands in the names of files."""
    identity = record.get("identity") or {}
    names = record["student"], identity.get("name"), identity.get("email")
    for name in sorted(filter(None, names), key=len, reverse=True):
        sentence = re.sub(rf"(?<![^\W_]){re.escape(name)}(?![^\W_])", "...", sentence)
    return sentence


def first_wrong(board):
    """A sentence on the first check that does not pass, or None."""
    for entry in board["exercises"]:
        for check in entry["checks"]:
            if check["verdict"] != "passed":
                return f"{entry['number']}: {check['claim']}: {check['message']}"


def missing(record):
    """{topic: why}: labs that count, and were not handed in, or cannot be imported."""
    counting = {entry["topic"] for entry in record["board"]["exercises"]} if record["board"] else ()
    return {topic: why for topic, why in record.get("missing", {}).items() if topic in counting}


def is_of_the_lab(check, topic, record):
    """Whether a check failed only because its whole lab is missing: that is said once."""
    why = missing(record).get(topic, "").partition("\n")[0].split()
    return bool(why) and " ".join(why) in " ".join(check["message"].split())


def needs_a_part(entry, record):
    """Whether something is wrong in an exercise that is not said of its lab already."""
    wrong = [check for check in entry["checks"] if check["verdict"] != "passed"
             and not is_of_the_lab(check, entry["topic"], record)]
    is_wrong = entry["verdict"] == "failing" or entry["told"] != entry["verdict"]
    return is_wrong and (bool(wrong) or entry["number"] in record["lost"])


def board_table(board, reached):
    """reached {exercise: points}."""
    lines, topic = [], None
    for entry in board["exercises"]:
        if entry["topic"] != topic:
            topic = entry["topic"]
            lab = [other for other in board["exercises"] if other["topic"] == topic]
            got = sum(reached[other["number"]] for other in lab)
            of = sum(other["points"] for other in lab)
            lines.append(["", Markup(f"<strong>{escaped(topic)}</strong>"), got, of, bar(got, of)])
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
    about = (f"isolation {record['level']} ({about}), hash {record['digest']}, "
             f"seed {record['seed']}")
    return {"score": after_lateness(record),
            "output": "\n".join([*told(record), *record["notes"], about]),
            "output_format": "text", "execution_time": round(record["seconds"]),
            "stdout_visibility": "hidden", "tests": tests}
