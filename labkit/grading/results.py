"""What is written while a class is graded, as it comes.

    DIR/students/ada/   report.html, record.json (for --resume), pictures/ of the report
    DIR/grades.csv      points for each exercise
    DIR/changes.csv     points that are other ones than in the last run, and why
    DIR/index.html      the overview
    DIR/scoreboard.html  of an open task: nicknames, and what holds
    DIR/code/           what was handed in, for programs that look for copies
    DIR/feedback.zip    the reports, to give back
"""
import shutil
from typing import NamedTuple

from .. import places
from ..table import COMMAND, TASKS
from .apart import typed_json
from .gradebook import earlier, handback, sheets, tables, worth
from .gradebook.records import How, Record
from .handing import texts
from .pages import overview, report, scoreboard, unusual


class Run(NamedTuple):
    """What all results of a run have in common."""

    columns: list   # the exercises that count
    level: str
    about: str      # a sentence on the level
    checks: str     # a hash of the course's own part
    not_understood: list = ()  # [(name, sentence)] of what is nobody's


class Results:
    """The results of a run. records {student: Record}."""

    def __init__(self, out, book, run):
        self.out, self.book, self.run = out, book, run
        self.records = {}
        self.works = {}        # {student: the Submission}
        self.before = {}       # {student: the Record of the last run}
        self.unusual = ()      # of `unusual.by_student`, once all are there

    def forget(self, students):
        """Remove what earlier runs left of those who have no row any more."""
        for student in students:
            shutil.rmtree(self.folder(student))
            shutil.rmtree(self.out / "code" / student, ignore_errors=True)

    def keep(self, one, fingerprint) -> bool:
        """Take over the result of an earlier run, if it is of the same work -> whether it was."""
        record = earlier.read(self.folder(one.student) / "record.json")
        if not record or record.how.fingerprint != fingerprint or record.result.problem:
            return False
        self.take(record, one)
        return True

    def take(self, record, one):
        """Take over a result. Its pages are written again if its grade is another one."""
        entered = self.book.entered(record._replace(work=one))
        if self.count(one, entered) and entered != record:
            pictures = self.folder(one.student).glob("pictures/*.png")
            self.write_student(entered, {path.name: path.read_bytes() for path in pictures})

    def count(self, one, record) -> bool:
        """Enter a Submission and its record, if no better one of this student's is there."""
        other = self.records.get(one.student)
        better = other is None or worth.rank(record) > worth.rank(other)
        if better:
            self.records[one.student], self.works[one.student] = record, one
        return better

    def add(self, one, seed, fingerprint, result, pictures):
        """Write what belongs to one student, and the tables."""
        how = How(self.run.level, seed, self.run.checks[:12], fingerprint)
        record = self.book.entered(Record(one, how, result))
        if not self.count(one, record):
            return
        try:
            self.write_pictures(one.student, pictures)
            self.write_student(record, pictures)
        except Exception as error:  # one student's trouble is no other's
            record = record.failed(f"its results cannot be written: {error}")
        self.records[one.student] = record
        self.write_tables()

    def folder(self, student):
        return self.out / "students" / student

    def write_pictures(self, student, pictures):
        folder = self.folder(student) / "pictures"
        shutil.rmtree(folder, ignore_errors=True)
        (folder if pictures else folder.parent).mkdir(parents=True, exist_ok=True)
        for name, content in pictures.items():
            places.write_whole(folder / name, content)

    def write_student(self, record, pictures):
        folder = self.folder(record.work.student)
        self.before.setdefault(record.work.student, earlier.read(folder / "record.json"))
        if not record.result.problem:
            page = report.page(record, pictures, self.run.about)
            places.write_whole(folder / "report.html", page.encode("utf-8"))
        places.write_whole(folder / "record.json", typed_json.dumps(record).encode("utf-8"))

    def write_tables(self):
        """grades.csv, changes.csv and index.html."""
        records = [self.records[name] for name in sorted(self.records)]
        table = tables.grades(records, self.run.columns)
        self.out.mkdir(parents=True, exist_ok=True)
        places.write_whole(self.out / "grades.csv", sheets.written(table))
        changes = [("student", "exercise", "before", "now", "why"), *self.changes()]
        places.write_whole(self.out / "changes.csv", sheets.written(changes))
        page = overview.overview(records, self.run.columns, self.run.level, self.run.about,
                                 self.run.not_understood, self.unusual,
                                 len(self.book.handed_in) - len(records))
        places.write_whole(self.out / "index.html", page.encode("utf-8"))
        if any(column.number in TASKS for column in self.run.columns):
            page = scoreboard.page(records)
            places.write_whole(self.out / "scoreboard.html", page.encode("utf-8"))

    def changes(self):
        """Yield `worth.changes` since the last run."""
        for student, before in self.before.items():
            if before:
                yield from worth.changes(before, self.records[student])

    def said_of_checks(self):
        """Yield a sentence, or none, on rows that are older than the course."""
        if old := [name for name, record in self.records.items()
                   if record.how.checks != self.run.checks[:12]]:
            yield (f"graded by other checks than today's: {', '.join(old)}; {COMMAND} grade --out "
                   f"{self.out} grades again all that is in the tables")

    def changed(self):
        """Sentences on those who have other points in the end than before."""
        return [f"{student}: points {now or 'none'}, before {before or 'none'}: {why}"
                for student, what, before, now, why in self.changes() if what == worth.LEFT]

    def close(self) -> list:
        """Write what needs all results -> the paths of all tables."""
        files = self.book.write(self.out, self.records)
        self.unusual = unusual.by_student(texts.kept(self.out, self.works.values()))
        self.write_tables()
        handback.write(self.out, [self.records[name] for name in sorted(self.records)])
        names = "grades.csv", "changes.csv", "index.html", "feedback.zip"
        return [*(self.out / name for name in names), *files]
