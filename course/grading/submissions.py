"""What was handed in: folders, zip archives, single files, under the names that platforms give.

Only the texts of labs/<topic>.py are taken out, and nothing is ever unpacked or run here.

    ada/labs/transforms.py, ada/transforms.py, ada.zip, ada_transforms.py     plain
    lovelaceada_LATE_1234_56789_labs-1.zip                                    Canvas
    Ada Lovelace_1234_assignsubmission_file_/labs.zip                         Moodle
    submission_1234/ beside submission_metadata.yml                           Gradescope
"""
import functools
import hashlib
import io
import os
import re
import stat
import zipfile
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from .. import exercises
from ..upkeep import skeleton

MOST_TEXT = 1 << 18       # bytes of one lab
MOST_ARCHIVE = 1 << 25    # bytes of one archive
MOST_ENTRIES = 5000       # of an archive or a folder
OURS = ("reference", "tests", "notebooks", "course", "__MACOSX", ".git", ".venv")
CANVAS = re.compile(r"(?P<student>[^_]+)(_LATE)?_\d+_(?P<when>\d+)_(?P<file>.+)")
MOODLE = re.compile(r"(?P<student>.+_\d+)_assignsubmission_(?:file|onlinetext)_?(?P<file>.*)")


class Submission(NamedTuple):
    """What one student has handed in."""

    student: str
    texts: dict     # {topic: text}
    missing: dict   # {topic: sentence}, of those that were expected and cannot be taken
    notes: tuple    # sentences for the report
    identity: dict = {}  # noqa: RUF012, by the platform: platform, id, name, email
    handed_in: float | None = None  # seconds since 1970, by the platform's time stamp
    late: bool = False  # whether the platform itself marked it late


class Found(NamedTuple):
    """One thing that was handed in."""

    student: str
    when: tuple     # the later, the greater
    path: Path
    topic: str | None  # of a single file


def read(folder, topics):
    """The submissions in a folder, one for each student. OSError or ValueError: there is none."""
    folder = Path(folder)
    if not folder.is_dir():
        raise ValueError(f"there is no folder {folder}: name the one with the submissions")
    groups = {}
    for found in listed(folder):
        groups.setdefault(found.student, []).append(found)
    if not groups:
        raise ValueError(f"nothing was handed in to {folder}: it should hold a folder, a zip or "
                         f"a file such as ada_{topics[0]}.py for each student")
    names = distinct(sorted(groups))
    return [submission(names[student], groups[student], topics) for student in sorted(groups)]


def distinct(students):
    """{student: a name for a folder, a table and a page}, no two the same in any case."""
    names = {}
    for student in students:
        name = tidied = re.sub(r"[^\w.-]+", "_", student).strip("._-")[:80] or "nameless"
        while name.casefold() in map(str.casefold, names.values()):
            name = f"{tidied}_{len(names)}"
        names[student] = name
    return names


def listed(folder):
    """Yield Found for everything in a folder that can be a submission."""
    names = gradescope_names(folder / "submission_metadata.yml")
    for path in sorted(folder.iterdir()):
        if path.name.startswith((".", "__MACOSX")) or path.is_symlink():
            continue
        single = path.suffix == ".py" and not path.is_dir()
        if not (path.is_dir() or single or path.suffix.lower() == ".zip"):
            continue
        stem = path.name if path.is_dir() else path.stem
        student, number, rest = named(stem)
        topic = single and next((topic for topic in exercises.topics()
                                 if re.search(rf"(^|_){topic}(-\d+)?$", rest)), None)
        if single and not topic:
            continue
        if single and rest == stem:
            student = re.sub(rf"_?{topic}(-\d+)?$", "", stem)
        again = re.search(r"-(\d+)$", stem) if number else None
        student = names.get(stem, (student, ""))[0]
        when = (names.get(stem, ("", ""))[1], int(again[1]) if again else 0, number, modified(path))
        yield Found(student or stem, when, path, topic or None)


def named(stem):
    """A platform's name -> student, a number that grows with time, the name of the file."""
    if match := MOODLE.fullmatch(stem):
        return match["student"], 0, match["file"]
    if match := CANVAS.fullmatch(stem):
        return match["student"], int(match["when"]), match["file"]
    return stem, 0, stem


def gradescope_names(path):
    """{"submission_1234": (student, time)} of an export's submission_metadata.yml."""
    if not path.is_file():
        return {}
    names = {}
    for part in re.split(r"^(?=\S)", path.read_text("utf-8", "replace"), flags=re.MULTILINE):
        fields = dict(re.findall(r"^\W*:?(\w+):[ \t]+(.+?)\s*$", part, re.MULTILINE))
        student = fields.get("sid") or fields.get("email") or fields.get("name")
        if student:
            names[part.partition(":")[0]] = (student.strip("'\""), fields.get("created_at", ""))
    return names


def modified(path):
    """When the newest file in it was written."""
    files = path.rglob("*") if path.is_dir() else [path]
    return max((file.lstat().st_mtime for file in files), default=0.0)


def submission(student, found, topics):
    """The student's latest: an archive or folder, with the single files that are later."""
    found = sorted(found, key=lambda one: one.when)
    whole = [one for one in found if not one.topic]
    taken = whole[-1:] + [one for one in found if one.topic]
    older = [one.path.name for one in whole[:-1]]
    notes = [f"older and not looked at: {', '.join(older)}"] if older else []
    contents, missing = {}, {}
    for one in taken:
        try:
            contents |= {one.topic: read_file(one.path)} if one.topic else files_in(one.path, notes)
        except (OSError, ValueError) as error:
            notes.append(f"{one.path.name}: {error}")
    texts = {}
    for topic in topics:
        try:
            texts[topic] = text_of(contents[topic])
        except KeyError:
            missing[topic] = f"there is no labs/{topic}.py in what was handed in"
        except ValueError as error:
            missing[topic] = f"labs/{topic}.py {error}"
    if not texts and notes:
        missing = {topic: f"{sentence} ({'; '.join(notes)})" for topic, sentence in missing.items()}
    return Submission(student, texts, missing, tuple(notes))


def text_of(content):
    """A lab's bytes, or the error that they gave -> its text."""
    if isinstance(content, ValueError):
        raise content
    if len(content) > MOST_TEXT:
        raise ValueError(f"has more than {MOST_TEXT >> 10} kB; a lab has a tenth of that")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError(f"is not UTF-8 text (byte {error.start}): save it as UTF-8") from None


def files_in(path, notes):
    """{topic: bytes} of a folder or archive."""
    entries = folder_entries(path) if path.is_dir() else archive_entries(path)
    chosen = {}
    for topic in exercises.topics():
        places = sorted((rank(name), name) for name in entries if is_lab(name, topic))
        if places:
            chosen[topic] = entries[places[0][1]]
        if len(places) > 1 and places[0][0] == places[1][0]:
            notes.append(f"{places[0][1]} was taken, not {places[1][1]}")
    if not chosen and path.is_dir() and len(archives := sorted(path.glob("*.zip"))) == 1:
        return files_in(archives[0], notes)  # Moodle and Gradescope: an archive in the folder
    return {topic: opened() for topic, opened in chosen.items()}


def is_lab(name, topic):
    path = PurePosixPath(name)
    safe = not path.is_absolute() and ".." not in path.parts and "\\" not in name
    return path.name == f"{topic}.py" and safe and not set(path.parts) & set(OURS)


def rank(name):
    """labs/transforms.py comes before transforms.py, then the least deep comes first."""
    parts = PurePosixPath(name).parts
    return parts[-2:-1] != ("labs",), len(parts)


def folder_entries(folder):
    """{name: function that reads it} of a folder's files. Links are not followed."""
    entries = {}
    for parent, folders, files in os.walk(folder, followlinks=False):
        folders[:] = sorted(set(folders) - set(OURS))
        for file in files:
            path = Path(parent, file)
            name = path.relative_to(folder).as_posix()
            entries[name] = functools.partial(careful, read_file, path)
        if len(entries) > MOST_ENTRIES:
            raise ValueError(f"it holds more than {MOST_ENTRIES} files")
    return entries


def archive_entries(path):
    """{name: function that reads it} of a zip archive, none of which is unpacked."""
    content = read_file(path, MOST_ARCHIVE)
    try:
        archive = zipfile.ZipFile(io.BytesIO(content))
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError) as error:
        raise ValueError(f"it is no zip archive ({error})") from None
    if len(archive.infolist()) > MOST_ENTRIES:
        raise ValueError(f"it holds more than {MOST_ENTRIES} files")
    return {entry.filename: functools.partial(careful, read_entry, archive, entry)
            for entry in archive.infolist() if not entry.is_dir()}


def careful(function, *arguments):
    """What the function returns, or the ValueError that says why there is nothing."""
    try:
        return function(*arguments)
    except (OSError, ValueError) as error:
        return ValueError(str(error))


def read_entry(archive, entry):
    """A file of an archive, and never more than MOST_TEXT + 1 bytes of it."""
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in (0, stat.S_IFREG):
        raise ValueError("is not a file in the archive but a link or the like: put the file there")
    if entry.flag_bits & 1 or entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError("is encrypted or packed in an unusual way: make a plain zip")
    try:
        with archive.open(entry) as file:
            return file.read(MOST_TEXT + 1)
    except Exception as error:  # whatever a broken archive makes the parser stumble over
        raise ValueError(f"cannot be read from the archive ({error})") from None


def read_file(path, most=MOST_TEXT):
    """A regular file's bytes, at most one more than most. A link is not followed."""
    if not stat.S_ISREG(os.lstat(path).st_mode):
        raise ValueError("is not a file but a link or the like: put the file there")
    with open(path, "rb") as file:
        content = file.read(most + 1)
    if most != MOST_TEXT and len(content) > most:
        raise ValueError(f"it has more than {most >> 20} MB")
    return content


def digest(texts):
    """The hash of the labs, however they were packed: 64 hexadecimal digits."""
    whole = hashlib.sha256()
    for topic in sorted(texts):
        whole.update(f"{topic}\0{skeleton.digest(texts[topic])}\n".encode())
    return whole.hexdigest()
