"""The labs, made of the reference: a raise in place of every core exercise's answer.

Everything else stays, byte for byte, also extras, which `extras` opens. A lab in which an exercise
is written was worked on, and is not made anew without --force.
"""
from .. import exercises, lab_text, places
from ..table import COMMAND


def run(force: bool = False) -> int:
    """Make labs/ from reference/ -> exit status.

    A lab that was worked on stays as it is. With force it is made anew, its text kept beside it.
    ValueError: a reference has a wrong mark. Then no lab is made.
    """
    refused = False
    for path, text in behind():
        if path.exists() and was_worked_on(exercises.read(path)):
            if not force:
                refused = True
                print(f"labs/{path.name} was worked on and stays as it is; to start it anew, run "
                      f"{COMMAND} skeleton --force, which keeps your text beside it")
                continue
            print(f"labs/{path.name} is made anew; your text is in labs/{keep(path).name}")
        path.parent.mkdir(exist_ok=True)
        places.write_whole(path, text.encode("utf-8"))
    return int(refused)


def behind():
    """[(path, its text)] of the labs that are another text, or none. ValueError: as for `run`."""
    made = []
    for topic in exercises.lab_topics():
        exercises.topic_exercises(topic)  # its errors name the file
        text = lab_text.skeleton(exercises.read(exercises.reference(topic)))
        made.append((places.ROOT / "labs" / f"{topic}.py", text))
    return [(path, text) for path, text in made if not path.exists() or exercises.digest(
        exercises.read(path)) != exercises.digest(text)]


def was_worked_on(text):
    """Is an exercise written that is open, or are there none, as in a text that is not Python?"""
    try:
        found = lab_text.answers(text)
    except ValueError:
        return True
    return not found or any(answer.exercise.is_open and answer.text.strip() != answer.todo.strip()
                            for answer in found)


def keep(path):
    """Copy a file to .bak, or .bak2, ... where that is taken; the copy's path."""
    copies = (path.with_name(f"{path.name}.bak{number}") for number in ("", *range(2, 1000)))
    copy = next(copy for copy in copies if not copy.exists())
    places.write_whole(copy, path.read_bytes())
    return copy
