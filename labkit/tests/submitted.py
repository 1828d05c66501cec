"""What students hand in: files, archives, and the other solutions as labs that are complete."""
import io
import os
import re
import zipfile

from labkit import exercises, places

FOLDER = places.ROOT / "tests" / "other_solutions"
CORE = {topic: [exercise for exercise in exercises.topic_exercises(topic)
                if exercise.points and not exercise.is_extra]
        for topic in exercises.asking_topics()}


def other_solution(topic):
    """A lab's text: the reference's code, and then its core exercises once more, otherwise."""
    if not (FOLDER / f"{topic}.py").exists():
        return exercises.read(exercises.reference(topic))
    own = re.sub(r"^from reference\b(\.(?=\w))?", lambda found: "from .",
                 exercises.read(FOLDER / f"{topic}.py"), flags=re.MULTILINE)
    return f"{exercises.read(exercises.reference(topic))}\n\n{own}"


def put(folder, files):
    """Write {path: text, bytes, or {path in the zip: text}} -> the paths."""
    paths = [folder / os.fsdecode(name) for name in files]
    for path, content in zip(paths, files.values(), strict=True):
        path.parent.mkdir(parents=True, exist_ok=True)
        content = zipped(content.items()) if isinstance(content, dict) else content
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return paths


def zipped(entries):
    """[(name or ZipInfo, text or bytes)] -> the bytes of a zip archive."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in entries:
            archive.writestr(name, text)
    return content.getvalue()
