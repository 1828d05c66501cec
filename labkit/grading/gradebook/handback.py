"""feedback.zip: all reports, under the names by which a platform gives them to their students.

    Moodle    Participant_1234_assignsubmission_file_/report.html
              for "upload multiple feedback files in a zip". Moodle reads the participant's number.
    Canvas    lovelaceada_1234_56789_labs.zip, with report.html in it
              for "upload submissions". Canvas reads the numbers of student and file, and shows
              the name that the student's file had. So it has to be a zip, as that was.
    others    ada/report.html

Moodle's and Canvas's rules are those of their own code: assignfeedback_file_zip_importer and
AbstractAssignment#infer_comment_context_from_filename.
"""
from ... import places
from ..handing.archives import zipped


def write(out, records) -> None:
    """Write out/feedback.zip, all or nothing. Who has no report is not in it."""
    reports = ((record, out / "students" / record.work.student / "report.html")
               for record in records)
    places.write_whole(out / "feedback.zip", zipped(
        entry(record, path.read_bytes()) for record, path in reports
        if path.exists() and not record.result.problem))


def entry(record, report):
    """-> (the name that the platform reads, the content)."""
    platform, number, _, _, file = record.work.identity
    if platform == "moodle" and number:
        return f"Participant_{number}_assignsubmission_file_/report.html", report
    if platform == "canvas" and file.lower().endswith(".zip"):
        return file, zipped([("report.html", report)])
    return f"{record.work.student}/report.html", report
