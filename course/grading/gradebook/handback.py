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
import io
import os
import zipfile

NEVER = 1980, 1, 1, 0, 0, 0  # the same reports make the same zip


def write(out, records) -> None:
    """Write out/feedback.zip, all or nothing. Who has no report is not in it."""
    path, neighbour = out / "feedback.zip", out / f".feedback.zip.{os.getpid()}"
    try:
        with zipfile.ZipFile(neighbour, "w", zipfile.ZIP_DEFLATED) as archive:
            for record in records:
                report = out / "students" / record.work.student / "report.html"
                if report.exists() and not record.result.problem:
                    put(archive, *entry(record, report.read_bytes()))
        os.replace(neighbour, path)
    finally:
        neighbour.unlink(missing_ok=True)


def entry(record, report):
    """-> (the name that the platform reads, the content)."""
    platform, number, _, _, file = record.work.identity
    if platform == "moodle" and number:
        return f"Participant_{number}_assignsubmission_file_/report.html", report
    if platform == "canvas" and file.lower().endswith(".zip"):
        content = io.BytesIO()
        with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
            put(archive, "report.html", report)
        return file, content.getvalue()
    return f"{record.work.student}/report.html", report


def put(archive, name, content):
    archive.writestr(zipfile.ZipInfo(name, NEVER), content, zipfile.ZIP_DEFLATED)
