"""feedback.zip: all reports, under the names by which a platform gives them to their students.

    Moodle    Participant_1234_assignsubmission_file_/report.html
              for "upload multiple feedback files in a zip". Moodle reads the participant's number.
    Canvas    lovelaceada_1234_56789_labs.zip, with report.html in it
              for "upload submissions". Canvas reads the numbers of student and file, and shows
              the name that the student's file had. So it has to be a zip, as that was. That of a
              group is there once, for all whose report is the same.
    others    ada/report.html

Moodle's and Canvas's rules are those of their own code: assignfeedback_file_zip_importer and
AbstractAssignment#infer_comment_context_from_filename.
"""
from ... import places
from ..handing import platforms
from ..handing.archives import zipped


def write(out, records) -> None:
    """Write out/feedback.zip, all or nothing. Who has no report is not in it."""
    reports = ((record, out / "students" / record.work.student / "report.html")
               for record in records)
    files = {}
    for record, path in reports:
        if path.exists() and not record.result.problem:
            name, content = entry(record, path.read_bytes())
            if files.setdefault(name, content) != content:
                files[f"{record.work.student}/report.html"] = path.read_bytes()
    places.write_whole(out / "feedback.zip", zipped(files.items()))


def entry(record, report):
    """-> (the name that the platform reads, the content)."""
    platform, number, _, _, file = record.work.identity
    if platform == "moodle" and number:
        return f"Participant_{number}_assignsubmission_file_/report.html", report
    if platform in ("canvas", "people") and platforms.CANVAS.fullmatch(file) and (
            file.lower().endswith(".zip")):
        return file.replace("\\", "_"), zipped([("report.html", report)])
    return f"{record.work.student}/report.html", report
