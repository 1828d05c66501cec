"""grades.csv: one line for each student, with columns for core, fine print, extras, lateness."""
from . import sheets, worth
from .records import Record
from .sheets import number_text


def grades(records, exercises) -> list[list]:
    """The rows of grades.csv, its titles first. There is at least one record."""
    lines = [line(record, exercises) for record in records]
    return [list(lines[0]), *(list(map(sheets.plain, cells.values())) for cells in lines)]


def line(record: Record, exercises) -> dict:
    """{title: cell} of one student."""
    got = worth.points(record)
    graded = worth.is_graded(record)
    work, how, result = record.work, record.how, record.result
    return {
        "student": work.student, "name": work.identity.name,
        "id": work.identity.id, "email": work.identity.email,
        **{f"{one.number} {one.name}": number_text(got.get(one.number)) for one in exercises},
        **sums("core", [one for one in exercises if not one.is_extra], got),
        **sums("extras", [one for one in exercises if one.is_extra], got),
        "total": number_text(worth.total(record) if graded else None),
        "of": sum(one.points for one in exercises),
        "handed in": record.lateness.handed_in, "late by": record.lateness.late_by,
        worth.LEFT: number_text(worth.after_lateness(record) if graded else None),
        "by hand": sheets.in_one_cell(worth.override_sentences(record)),
        "fine print open": " ".join(worth.open_fine_print(record)),
        "isolation": how.level, "seconds": f"{result.seconds:.1f}", "seed": how.seed,
        "checks": how.checks, "hash": work.digest, "problem": result.problem or "",
        "notes": sheets.in_one_cell(work.notes)}


def sums(title, exercises, got):
    """Two columns, if there are such exercises: what was reached of them, and the most."""
    if not exercises:
        return {}
    reached = sum(got.get(one.number, 0) for one in exercises) if got else None
    return {title: number_text(reached), f"{title} of": sum(one.points for one in exercises)}
