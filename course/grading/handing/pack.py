"""What a student hands in: the labs in one zip, checked as they are in it."""
import contextlib
import io
import tempfile
from pathlib import Path

from ... import board, exercises
from ...given import places
from . import archives


def run(name="labs.zip") -> int:
    """Pack labs/, unpack the zip in a clean folder, check that, print its board and hash -> 0.

    The hash is that of grades.csv: it does not depend on how the labs were packed.
    """
    labs = (places.ROOT / "labs" / f"{topic}.py" for topic in exercises.topics())
    places.write_whole(name, archives.zipped(
        (f"labs/{path.name}", path.read_bytes()) for path in labs if path.exists()))

    texts, missing, notes = archives.read(name, exercises.topics())
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
    print(f"{name} is what to hand in; hash {archives.digest(texts)}")
    return 0
