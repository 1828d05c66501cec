"""What was handed in, as the folders that programs take which look for copies.

    DIR/code/ada/transforms.py            of each student, or of one member of each group, and what
                                          labs import of the student's own
    DIR/code-handed-out/transforms.py     what all of them were given

Later runs find here what was handed in before.
"""
import shutil

from ... import exercises, lab_text, places


def kept(out, works) -> dict[str, dict[str, str]]:
    """Write the texts that came with these Submissions -> of all, {student: {name: text}}. The name
    is a topic, or that of a module of the student's own.

    Who has none and lacks none is of an earlier run. Of a group, one member stands for all.
    """
    first = {}
    for one in sorted(works, key=lambda one: one.student):
        first.setdefault((one.group, one.group or one.student), one.student)
    found = {}
    for one in works:
        folder = out / "code" / one.student
        if one.student not in first.values() or one.texts or one.missing:
            shutil.rmtree(folder, ignore_errors=True)
        if one.student in first.values():
            write(folder, one.texts)
            found[one.student] = of(out, one.student)
    topics = set().union(*found.values()).intersection(exercises.TOPICS)
    write(out / "code-handed-out", {topic: handed_out(topic) for topic in topics})
    return found


def of(out, student):
    """{name: text} of what a student handed in, as it is kept."""
    return {path.stem: exercises.read(path) for path in (out / "code" / student).glob("*.py")}


def write(folder, texts):
    for topic, text in texts.items():
        folder.mkdir(parents=True, exist_ok=True)
        places.write_whole(folder / f"{topic}.py", text.encode("utf-8"))


def handed_out(topic):
    return lab_text.skeleton(exercises.read(exercises.reference(topic)))
