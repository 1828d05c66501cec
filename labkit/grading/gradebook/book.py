"""From points to grades: who is who on the platform, lateness, points by hand.

All files that an instructor gives are read before anything is graded, so a mistake costs no time.
"""
from ... import places
from ..handing.submissions import AGAIN
from . import lateness, overrides, people, rosters, sheets, worth
from .records import Record


class Gradebook:
    """What is known of a class besides its work."""

    def __init__(self, asked, handed_in, columns, persons=()):
        """asked: the Request. columns: the exercises that count. persons: the lines of people.csv.

        ValueError: something that was given is wrong.
        """
        if (asked.csv is None) != (asked.roster is None) or (asked.assignment and not asked.csv):
            raise ValueError("--csv PLATFORM and --roster FILE belong together, and --assignment "
                             "to both: the import file is made from the platform's own export")
        self.all_or_nothing = bool(asked.all_or_nothing)
        self.of = sum(exercise.points for exercise in columns)
        self.policy = lateness.policy(asked.due, asked.late, asked.grace)
        self.by_hand = {} if asked.overrides is None else overrides.read(
            asked.overrides, people.called(handed_in), columns)
        self.persons, self.due = persons, people.due_times(handed_in, persons)
        self.roster, self.rows, self.unmatched = None, {}, {}
        if asked.csv:
            self.roster = rosters.read(asked.roster, asked.csv, asked.assignment)
            self.rows, self.unmatched = rosters.match(self.roster, handed_in)
        self.handed_in = {one.student: one for one in handed_in}

    def entered(self, record: Record) -> Record:
        """The record, with what is known of its student besides the work, and without the texts."""
        one, when = record.work, self.when(record.work)
        return record._replace(work=one._replace(texts={}, missing={}, handed_in=when, others=()),
                               lateness=lateness.judged(self.policy_for(one), when, one.late),
                               overrides=self.by_hand.get(one.student, {}),
                               all_or_nothing=self.all_or_nothing)

    def policy_for(self, one):
        """The policy, with the student's own due time."""
        return self.policy._replace(due=self.due.get(one.student, self.policy.due))

    def when(self, one):
        """Seconds since 1970. Moodle tells them in its worksheet only."""
        text = self.moodle_says(one)
        return lateness.moodle_time(text, self.policy.zone) if text else one.handed_in

    def is_late(self, one):
        return lateness.is_late(self.policy_for(one), self.when(one), one.late)

    def with_earlier(self, one, kept):
        """A Submission, with what an earlier run keeps of the same student: of the same work, the
        earlier time counts, and other work is one of the others. kept: a Submission, or None.
        """
        if not (kept and kept.texts):
            return one
        late = lateness.is_late(self.policy_for(kept), kept.handed_in, kept.late)
        is_told = (kept.handed_in, kept.late) != (None, None)
        kept = kept._replace(late=late)  # which says that its time is known, also of Moodle
        if kept.texts != one.texts:
            return one._replace(others=(kept, *one.others))
        if late or not is_told or not self.is_late(one):
            return one
        return one._replace(handed_in=kept.handed_in, late=False, notes=(*one.notes, AGAIN))

    def counting(self, one, kept, count) -> list:
        """The Submissions of a student, of which the best counts. kept: as for `with_earlier`,
        count: as in the Request.
        """
        one = self.with_earlier(one, kept)
        if count == "best":
            return [*one.others, one]
        in_time = [each for each in (*one.others, one) if not self.is_late(each)]
        return in_time[-1:] if in_time and count == "last-on-time" else [one]

    def moodle_says(self, one):
        """When it was handed in, as Moodle's worksheet has it for the student, or else for another
        one of the group, who handed in for it. "": it tells nothing.
        """
        if (not self.rows or self.roster.platform != "moodle" or one.late is False
                or one.identity.platform not in ("moodle", "people")):
            return ""
        group = (each.student for each in self.handed_in.values() if one.group == each.group != "")
        told = (rosters.cell(self.roster, self.rows[student], "Last modified (submission)")
                for student in (one.student, *group) if student in self.rows)
        return next(filter(None, (text.strip("-") for text in told)), "")

    # --- what an instructor is told, before and after

    def said(self) -> list[str]:
        """Sentences on what does not fit together."""
        lines = []
        if self.roster:
            title = self.roster.sheet.header[self.roster.column]
            lines.append(f"submissions matched with {self.roster.path}: {len(self.rows)} of "
                         f"{len(self.handed_in)}; their points go to the column {title!r}")
            lines += [f"not matched: {name}: {why}" for name, why in self.unmatched.items()]
            lines += [f"{name} keeps the {word!r} that the roster has" for name, row in
                      self.rows.items() if (word := rosters.kept_word(self.roster, row))]
            if absent := [name for row, name in rosters.people(self.roster).items()
                          if row not in self.rows.values()]:
                lines.append(f"in the roster without a submission ({len(absent)}): "
                             f"{'; '.join(absent)}")
            most = rosters.most(self.roster)
            if most not in (None, self.of):
                lines.append(f"{title!r} is out of {sheets.number_text(most)} there, and "
                             f"out of {self.of} here: make it {self.of} there before you import")
        return lines + self.said_of_times() + people.said(self.handed_in.values(), self.persons)

    def said_of_times(self):
        unread = {one.student: text for one in self.handed_in.values()
                  if (text := self.moodle_says(one)) and self.when(one) is None}
        late = [one.student for one in self.handed_in.values()
                if one.late and self.when(one) is None
                and "late" not in self.by_hand.get(one.student, {})]
        lines = [f"{name}: Moodle's time {text!r} cannot be read: download the worksheet with "
                 "Moodle's language set to English" for name, text in unread.items()]
        return lines + [f"{name} is {lateness.NOT_TOLD}. Nothing is taken off, but by a line of "
                        f"--overrides: {name},late,POINTS,REASON" for name in late]

    def write(self, out, records) -> list:
        """Write the platform's file, and which marks it replaces there -> the paths.

        records {student: record}.
        """
        if not self.roster:
            return []
        points = {row: sheets.number_text(worth.after_lateness(records[student]))
                  for student, row in self.rows.items() if worth.is_graded(records[student])}
        replaced = [("name", "in the roster", "now"),
                    *(map(sheets.plain, row) for row in rosters.replaced(self.roster, points))]
        files = {f"for-{self.roster.platform}.csv": rosters.filled(self.roster, points),
                 "replaced.csv": sheets.written(replaced)}
        for name, content in files.items():
            places.write_whole(out / name, content)
        return [out / name for name in files]

