"""What earlier runs left in the same folder: nobody falls out of the tables."""
from ..apart import typed_json
from ..handing import contents, texts
from . import worth
from .records import Record


def records(out, handed_in, columns) -> tuple[list[Record], list[str]]:
    """-> (the records of those who are not graded now, the names that have no row any more).

    These are groups whose members have rows now, and members of a group that has one, or lost them.
    ValueError: a record would not fit into the same table, or a folder is another student's.
    """
    now = {one.student.casefold(): one for one in handed_in}
    names = {name for one in handed_in for name in (one.student, one.group)} - {""}
    found, gone = [], []
    for path in sorted(out.glob("students/*/record.json")):
        record, one = read(path), now.get(path.parent.name.casefold())
        if one is None and names & {path.parent.name, record and record.work.group}:
            gone.append(path.parent.name)
        elif one is None and not fits(record, columns):
            raise ValueError(f"{out} holds grades of {path.parent.name} for other labs or points, "
                             "or of another version of the course: grade all submissions again "
                             "in one run, or name another folder with --out")
        elif one is None:
            found.append(record)
        elif record and are_two(record.work.identity, one.identity):
            raise ValueError(f"{path.parent} holds grades of another student, whose name is almost "
                             "the same: name another folder with --out")
    return found, gone


def works(out, topics, seed_of) -> tuple[dict, list[str]]:
    """-> ({student: the Submission that the tables show, with its texts}, the names of those whose
    texts are not kept). seed_of(texts) -> the seed from which these are graded.
    """
    found, gone, first = {}, [], {}
    for path in sorted(out.glob("students/*/record.json")):
        student, record = path.parent.name, read(path)
        group = (record and record.work.group) or student
        kept = texts.of(out, first.setdefault(group, student))
        if record and seed_of(kept) == record.how.seed:
            found[student] = record.work._replace(texts=kept, missing={
                topic: record.result.missing.get(topic, contents.ABSENT.format(topic))
                for topic in topics if topic not in kept})
        else:
            gone.append(student)
    return found, gone


def read(path) -> Record | None:
    """What an earlier run wrote. None: there is nothing, or of another version of the course."""
    try:
        return typed_json.loads(Record, path.read_bytes())
    except (OSError, ValueError):
        return None


def fits(record, columns):
    """Whether a record has what the tables show."""
    points = {one.number: one.points for one in worth.counting(record)} if record else {}
    return bool(record) and (not points or points == {one.number: one.points for one in columns})


def are_two(before, now):
    """Whether names that were handed in by hand are of two people."""
    return before.platform == now.platform == "" and before.name != now.name
