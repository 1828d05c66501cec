"""Extras in labs/: opened to be written, and closed again.

An extra is complete in labs/ until it is opened. Its answer then waits in labs/.answers.json, and
comes back when the extra is closed. A core exercise is open from the start. It can be closed once
its solution is released, that is where reference/ has its module.
"""
import json

from .. import exercises, lab_text, places


def open_extras(target: str) -> int:
    """Open an extra (2.14), or all of labs (2, 1-3 or scanline) -> 0. ValueError: there is none."""
    found = [pair for pair in asked(target) if pair[1].exercise.is_extra]
    if not found:
        raise ValueError(f"{target} has no extra; what belongs to the core is open from the start")
    kept = kept_answers()
    for topic, answer in found:
        if answer.exercise.is_open:
            print(f"{named(answer)} is open already")
            continue
        kept[answer.exercise.number] = answer.text
        write(kept_path(), json.dumps(kept, indent=2))
        replace(topic, answer, answer.todo, is_open=True)
        print(f"{named(answer)} is open: write it in labs/{topic}.py")
    return 0


def close(target: str, core: bool = False) -> int:
    """Put the answers back into untouched extras, with core into all exercises -> 0.

    ValueError: there is none that is open.
    """
    found = [(topic, answer) for topic, answer in asked(target)
             if answer.exercise.is_open and (core or answer.exercise.is_extra)]
    if not found:
        more = "" if core else ("; with --core, released solutions are put into the exercises of "
                                "the core")
        raise ValueError(f"{target} has no extra that is open{more}")
    for topic, answer in found:
        known = known_answer(topic, answer.exercise)
        if answer.text == known:
            print(f"{named(answer)} is complete already")
        elif answer.text.strip() != answer.todo.strip():
            print(f"{named(answer)} was worked on, and stays as it is")
        elif known is None:
            print(f"{named(answer)} stays open: its solution is not released in this copy")
        else:
            replace(topic, answer, known, is_open=False)
            again = " again" * (answer.exercise.number in kept_answers())
            print(f"{named(answer)} is complete{again}")
    return 0


def asked(target):
    """[(topic, Answer)] in labs/ of labs, a topic or an exercise, the last one of a file first."""
    labs, numbers = exercises.asked_for(target)
    return [(topic, answer) for topic in labs
            for answer in reversed(lab_text.answers(exercises.read(lab_path(topic))))
            if answer.exercise.number in numbers]


def known_answer(topic, exercise):
    """The text of an answer that was there before, or that was released, or None."""
    known = kept_answers()
    path = exercises.reference(topic)
    if path.exists():
        known |= {answer.exercise.number: answer.text
                  for answer in lab_text.answers(exercises.read(path))}
    return known.get(exercise.number)


def replace(topic, answer, text, is_open):
    lines = exercises.text_lines(exercises.read(lab_path(topic)))
    lab_text.put(lines, answer, text, is_open)
    write(lab_path(topic), "".join(lines))


def named(answer):
    return f"{answer.exercise.number} {answer.exercise.name}"


def lab_path(topic):
    return places.ROOT / "labs" / f"{topic}.py"


def kept_path():
    return places.ROOT / "labs" / ".answers.json"


def kept_answers():
    """{number: the answer that an opened extra had}."""
    path = kept_path()
    return json.loads(path.read_bytes()) if path.exists() else {}


def write(path, text):
    places.write_whole(path, text.encode("utf-8"))
