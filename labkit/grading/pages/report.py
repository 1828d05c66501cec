"""A student's page. Whatever comes from students is escaped.

The page names nobody, so that it can be given back, and shown, in any way: see `handback`.
"""
import itertools
import re

from ...checks import page as html
from ..gradebook.records import Record
from ..gradebook.sheets import number_text
from ..gradebook.worth import after_lateness, by_checks, points, sentences

IMPORT = "cannot be imported"  # so `examine` says of a lab


def page(record: Record, pictures, about) -> str:
    """pictures {file name: PNG}. about: a sentence on the level of isolation."""
    work, how, result = record.work, record.how, record.result
    of = sum(entry.points for entry in result.entries)
    notes = (unnamed(note, record) for note in work.notes)
    parts = [html.paragraph(f"{number_text(after_lateness(record))} of {of} points", "claim"),
             *map(html.paragraph, (*sentences(record), *notes)),
             board_table(result.entries, points(record))]
    for topic, why in missing(record).items():
        parts += [f"<h2>{topic}: nothing could be checked</h2>",
                  html.preformatted(why if IMPORT in why else unnamed(why, record))]
    for entry in result.entries:
        if needs_a_part(entry, record):
            lost = result.lost.get(entry.number)
            got = by_checks(record).get(entry.number)
            parts += html.exercise_part(entry, got, lost, pictures, how.seed)
    parts += ["<h2>How this was found</h2>", html.paragraph(
        f"Isolation {how.level} ({about}); seed {how.seed}; {result.seconds:.1f} s; "
        f"hash of what was handed in {work.digest}.")]
    return html.document("Report", *parts)


def unnamed(sentence, record):
    """The sentence without the student's name, which stands in the names of files."""
    identity = record.work.identity
    names = record.work.student, identity.name, identity.email
    for name in sorted(filter(None, names), key=len, reverse=True):
        sentence = re.sub(rf"(?<![^\W_]){re.escape(name)}(?![^\W_])", "...", sentence)
    return sentence


def missing(record: Record) -> dict[str, str]:
    """{topic: why}: labs that count, and were not handed in, or cannot be imported."""
    counting = {entry.topic for entry in record.result.entries}
    return {topic: why for topic, why in record.result.missing.items() if topic in counting}


def is_of_the_lab(check, topic, record) -> bool:
    """Whether a check failed only because its whole lab is missing: that is said once."""
    why = missing(record).get(topic, "").partition("\n")[0].split()
    return bool(why) and " ".join(why) in " ".join(check.message.split())


def needs_a_part(entry, record):
    """Whether something is wrong in an exercise that is not said of its lab already."""
    wrong = [check for check in entry.checks if check.verdict != "passed"
             and not is_of_the_lab(check, entry.topic, record)]
    is_wrong = entry.verdict == "failing" or entry.fine_print_open
    return is_wrong and (bool(wrong) or entry.number in record.result.lost)


def board_table(entries, reached):
    """reached {exercise: points}."""
    lines = []
    for topic, each in itertools.groupby(entries, key=lambda entry: entry.topic):
        lab = list(each)
        got = sum(reached.get(entry.number, 0) for entry in lab)
        of = sum(entry.points for entry in lab)
        lines.append(["", html.Markup(f"<strong>{topic}</strong>"), got, of, html.bar(got, of)])
        lines += [[entry.number, entry.name, reached.get(entry.number, ""),
                   entry.points or "step", html.coloured(entry.told)] for entry in lab]
    return html.rows(lines, ["", "", "points", "of", ""])
