"""What a student hands in: the labs in one zip, checked as they are in it."""
import contextlib
import functools
import io
import tempfile
from pathlib import Path

from ... import board, exercises, imports, places, verdicts
from ...table import TASKS
from . import archives, contents


def run(name="labs.zip") -> int:
    """Pack labs/ and what they import, unpack the zip in a clean folder, check that, print its
    board and hash -> 0, or 1 if something could not be taken.

    The hash is that of grades.csv: it does not depend on how the labs were packed.
    """
    labs = places.ROOT / "labs"
    read = functools.partial(imports.text_in, labs)
    there = {topic: text for topic in (*exercises.lab_topics(), *TASKS)
             if (text := read(topic)) is not None}
    places.write_whole(name, archives.zipped(
        (f"labs/{each}.py", (labs / f"{each}.py").read_bytes())
        for each in (*there, *imports.own_modules(there.values(), read))))

    texts, missing, notes = archives.read(name, (*exercises.lab_topics(), *({*TASKS} & {*there})))
    with tempfile.TemporaryDirectory() as made:
        folder = str(Path(made).resolve())
        for topic, text in texts.items():
            Path(folder, f"{topic}.py").write_text(text, "utf-8", newline="")
        with contextlib.redirect_stdout(io.StringIO()) as said:
            board.check(implementation=folder)
        # That folder is gone when the student reads this.
        print(said.getvalue().replace(f" --impl {folder}", "").replace(folder, "labs"), end="")
    for sentence in (*missing.values(), *notes):
        print(sentence)
    asked = {topic: exercises.topic_exercises(topic) for topic in there if topic not in TASKS}
    print(f"{name} is what to hand in; hash {contents.digest(texts)}")
    return int(bool(missing or notes or verdicts.not_there(asked, labs)[1]))
