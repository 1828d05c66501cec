"""How often the report names what is wrong: measured on wrong answers as students write them.

tests/wrong_answers/<topic>.py was written by people who had seen the questions, and neither the
checks nor the known mistakes. Each wrong function's docstring says what is wrong with it, and,
after "told by:", how one recognises a sentence that says so: words joined by & stand all in it,
| separates alternatives. The report's sentences are judged by these words:

    named    a hint, or what the first failing check lists or says, tells what is wrong
    silent   nothing does
    wrong    a hint that is certain tells something else
    passes   all checks pass

This is a measurement of 95 answers, one for each exercise that was core when they were drawn, and
is: of the 737 that had been written, the one whose text has the least SHA-256. With 95 answers the
standard error of a share of 98 % is 1.4 %. All 737 were named in the end, and so are these. A new
exercise needs none. A better answer may take another one's place.
"""
import re
from collections import Counter
from typing import NamedTuple

from .. import exercises
from ..checks.hints import is_sure
from ..checks.runner import explained
from .mistakes import wrong_functions
from .trials import Trial, caught_by

LABELS = "claim", "hint", "perhaps", "wrong", "differs"  # of the rows that are read


class WrongAnswer(NamedTuple):
    """An exercise, the text of a wrong function, what is wrong, and the words that tell it."""

    exercise: exercises.Exercise
    text: str
    cause: str
    told_by: str


def corpus(topic):
    """The WrongAnswers of a topic. ValueError: one is no exercise, or does not say its words."""
    found = []
    for place, exercise, text, said in wrong_functions("wrong_answers", topic):
        cause, _, told_by = said.partition(" told by: ")
        if not told_by:
            raise ValueError(f"{place}: {exercise.name} must say in its docstring what is wrong "
                             'and, after "told by:", the words that tell it')
        found.append(WrongAnswer(exercise, text, cause, told_by))
    return found


def tells(sentence, told_by):
    """Are all words of one alternative in the sentence?"""
    return any(all(word.strip().lower() in sentence.lower() for word in alternative.split("&"))
               for alternative in told_by.split("|"))


def verdict(answer, checks):
    """named, silent, wrong or passes: of a WrongAnswer and the Checks that it fails."""
    if not checks:
        return "passes"
    first = min(explained(checks), key=lambda check: check.fine_print)
    rows = rows_of(first)
    hint = rows.get("hint", "")
    if tells(hint, answer.told_by):
        return "named"
    if hint and is_sure(hint):
        return "wrong"
    return "named" if any(tells(row, answer.told_by) for row in rows.values()) else "silent"


def rows_of(check):
    """{label: text} of the sentences in a check's report. What differs in numbers is none."""
    rows, label = {"claim": check.claim}, ""
    for line in check.message.splitlines():
        label = line[:10].strip() or label
        rows[label] = f"{rows.get(label, '')} {line[10:].strip()}"
    if not rows.get("differs", "").startswith((" in shape", " in kind")):
        rows.pop("differs", None)
    return {label: re.sub(r"\s+", " ", text) for label, text in rows.items() if label in LABELS}


def measured(topic):
    """[(WrongAnswer, its verdict, the Checks that it fails)]."""
    answers = corpus(topic)
    trials = [Trial(answer.exercise, answer.text) for answer in answers]
    found = caught_by(topic, trials, all_checks=True, with_hints=True)
    return [(answer, verdict(answer, checks), checks)
            for answer, checks in zip(answers, found, strict=True)]


def run(target=None):
    """Print each topic's counts, and what is not named. -> 0 if nothing is wrong or passes."""
    total = Counter()
    for topic in exercises.asked_for(target)[0]:
        found = measured(topic)
        counts = Counter(verdict for _, verdict, _ in found)
        total += counts
        print(line(topic, counts))
        for answer, verdict, checks in found:
            if verdict != "named":
                print(f"    {answer.exercise.number} {verdict}: {answer.cause}")
                if checks and target:
                    first = min(explained(checks), key=lambda check: check.fine_print)
                    print(*(f"        {label:8} {text}" for label, text in rows_of(first).items()),
                          sep="\n")
    print(line("all", total))
    return int(bool(total["wrong"] + total["passes"]))


def line(title, counts):
    shares = (f"{counts[name]:4} {name}" for name in ("named", "silent", "wrong", "passes"))
    return f"{title:20} {counts.total():4}: {'  '.join(shares)}"
