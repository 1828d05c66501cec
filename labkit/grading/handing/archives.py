"""What is in folders and archives: the file of each lab. Nothing is unpacked, no link is followed.

In a folder or an archive, labs/transforms.py comes before transforms.py, then the least deep. Of
things that were handed in apart, the newest counts, for each lab. A module of the student's own
that a lab imports is read as labs are, from the folder that the lab is in.
"""
import functools
import io
import itertools
import os
import re
import stat
import zipfile
from pathlib import Path, PurePosixPath

from ... import exercises, imports
from ...table import COMMAND, HANDED_OUT, NAME, TASKS, USED
from .contents import MOST_TEXT, Lab, readable, texts_of

BUDGET = 1 << 23         # bytes that are read of what one student has handed in. Among these,
EACH_ARCHIVE = 1 << 19   # an archive counts as so many more, for what is unpacked,
EACH_FILE = 200          # and a file of a folder as it would in an archive's list of files
DEEPEST = 40             # folders in folders
NO_LINK = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)  # nor a pipe to wait for
PACKED = re.compile(r"(.+?)(\.tar)?\.(zip|tar|tgz|gz|rar|7z|bz2|xz|zst|tbz2?|txz)", re.I | re.S)
OURS = {each.split("/")[-2] for each in (*USED, *HANDED_OUT) if "/" in each} - {NAME}
NOT_THEIRS = {"reference", "tests", "notebooks", "handed_out", *OURS,
              "__MACOSX", "__pycache__", "env", "node_modules", "site-packages", "venv"}  # others'
COPY = r"(?:[\s_-]*\(\d+\)|[\s_-]+(?:v?\d+|copy|kopie|copie))*+"  # transforms (1), transforms-2
LAB = re.compile(r"(?:(.*?)(?<![\W_])[\W_]++)??((?a:"
                 + "|".join(sorted((*exercises.TOPICS, *TASKS), key=len, reverse=True))
                 + rf")){COPY}\.py", re.I | re.S)


class Budget:
    """How many bytes of what one student has handed in may still be read."""

    def __init__(self):
        self.left = BUDGET

    def pay(self, count):
        self.left -= count
        if self.left < 0:
            raise ValueError("holds too many files, or comes after too many others, so neither it "
                             "nor what is older was read: hand in one zip of labs/ alone")


def read(path, topics) -> tuple[dict, dict, list]:
    """What one student has handed in -> (texts, missing, notes), and what is to be said of it.

    texts {topic or module: text}, missing {topic: sentence}, notes: sentences.
    """
    notes = []
    labs = labs_in(Path(path), Path(path).name, notes, Budget())
    return *texts_of(labs, topics, notes), notes


def zipped(files) -> bytes:
    """Pairs (name, content) -> a zip of them: from the same files, the same bytes."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, part in files:
            entry = zipfile.ZipInfo(name)
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, part, zipfile.ZIP_DEFLATED)
    return content.getvalue()


def printable(name) -> str:
    """A name, or what went wrong. What moves a cursor or has no code is written out: \\udce9."""
    return "".join(c if c.isprintable() else " " if c.isspace() else
                   c.encode("unicode_escape").decode() for c in str(name))


def quoted(name) -> str:
    """A name, or what went wrong, as it may stand in a sentence."""
    return printable(name)[:120]


def reason(error) -> str:
    """What went wrong, without the paths of this machine."""
    return quoted(getattr(error, "strerror", None) or error or type(error).__name__)


# --- which file is a lab ----------------------------------------------------------------------


def named_lab(name) -> tuple[str, str | None]:
    """(what stands before the lab's name, topic) of a file's name. ("", None): it is no lab.

    "ada_Transforms (1).py" -> ("ada", "transforms")
    """
    match = LAB.fullmatch(name) if len(name) < 256 else None
    before = (match[1] or "").strip(" ._-") if match else ""
    if not match or before.lower() == "test":  # test_transforms.py is ours
        return "", None
    return before, match[2].lower()


def topic_at(place):
    """The topic of the lab at a place in a folder or archive. None: it is not a student's lab."""
    folders = place.parts[:-1]
    if place.is_absolute() or len(folders) > DEEPEST or any(map(is_not_theirs, folders)):
        return None
    return named_lab(place.name)[1]


def is_not_theirs(folder):
    """Whether a folder holds what is ours or a program's. "..": it is not even in the archive."""
    return folder in NOT_THEIRS or folder.startswith(".")


def rank(place, topic, when):
    """The least is taken. Files that were handed in one by one lie in no folder: the newest."""
    parts = place.parts
    alone = len(parts) == 1
    return (parts[-2:-1] != ("labs",), len(parts), -when if alone else 0,
            place.name != f"{topic}.py", len(place.name))


def chosen(entries, name, notes):
    """{topic: Lab} of entries (name, when, function that reads it), one file for each topic. And
    {name: Lab} of the student's own modules that these import.

    name: of the folder or archive that they are in.
    """
    files, there = {}, {}
    for entry, when, content in entries:
        place = PurePosixPath(entry.replace("\\", "/"))
        files[place] = Lab(when, quoted(entry), content)
        if topic := topic_at(place):
            there.setdefault(topic, {})[place] = rank(place, topic, when)
    taken = {topic: min(found, key=found.get) for topic, found in there.items()}
    labs = {topic: loaded(files[place]) for topic, place in taken.items()}
    own = beside(labs, {place.parent: None for place in taken.values()}, files)
    sources = {lab.source for lab in (*labs.values(), *own.values())}
    for topic, found in there.items():
        if left := [files[place].source for place in found if files[place].source not in sources]:
            notes.append(f"{labs[topic].source} was taken, not {few(left)}")
    if not labs:
        others = few([file.source for file in files.values()])
        notes.append(f"{quoted(name)} " + (f"holds no lab, only {others}" if files else "is empty"))
    return labs | own


def loaded(file):
    """A Lab whose content is a function -> the Lab with what that returns."""
    return file._replace(content=careful(file.content))


def beside(labs, folders, files):
    """{name: Lab} of the modules that labs import, in their folders. files {path: Lab}, not loaded.
    """
    found = {}

    def read(name):
        path = next((path for folder in folders if (path := folder / f"{name}.py") in files), None)
        if path:
            found[name] = loaded(files[path])
            return readable(found[name])

    imports.own_modules(map(readable, labs.values()), read)
    return found


def newest(found, notes) -> dict[str, Lab]:
    """A list of {topic: Lab} -> {topic: the newest Lab}."""
    labs, others = {}, {}
    for topic in dict.fromkeys(itertools.chain(*found)):
        there = [one[topic] for one in found if topic in one]
        labs[topic] = max(there, key=lambda lab: lab.when)
        if older := [lab.source for lab in there if lab is not labs[topic]]:
            others.setdefault((labs[topic].source, few(older)), []).append(topic)
    notes += [f"{', '.join(topics)}: {source} is the newest; not looked at: {older}"
              for (source, older), topics in others.items()]
    return labs


def few(names):
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(map(quoted, names[:3])) + more


def careful(function):
    """What the function returns, or the ValueError that says why there is nothing.

    PermissionError: the grader may not read what is there, which is nobody's fault who handed in.
    """
    try:
        return function()
    except PermissionError:
        raise
    except ValueError as error:
        return error
    except Exception as error:  # whatever a broken archive makes the parser stumble over
        return ValueError(f"cannot be read ({reason(error)}): pack it again as a zip")


# --- folders, archives, files -----------------------------------------------------------------


def labs_in(path, name, notes, budget) -> dict[str, Lab]:
    """{topic: Lab} of a folder, an archive or a file. notes: grows by what cannot be read."""
    if budget.left < 0:  # it has been said
        return {}
    found = careful(functools.partial(found_in, path, name, notes, budget))
    if isinstance(found, ValueError):  # one student's trouble is no other's
        notes.append(f"{quoted(name)} {printable(found)}")
        return {}
    return found


def found_in(path, name, notes, budget):
    if path.is_dir() and not path.is_symlink():
        return labs_in_folder(path, name, notes, budget)
    when = os.lstat(path).st_mtime
    if topic := named_lab(path.name)[1]:
        content = careful(functools.partial(content_of, path, budget))
        return {topic: Lab(when, quoted(name), content)}
    with opened(path, budget) as file:
        if not PACKED.fullmatch(path.name):
            raise ValueError("is neither a lab nor an archive: hand in the zip that "
                             f"{COMMAND} pack makes")
        budget.pay(EACH_ARCHIVE)
        with zipfile.ZipFile(file) as archive:
            labs = chosen(entries_of(archive, when), name, notes)
    return {topic: lab._replace(source=quoted(name)) for topic, lab in labs.items()}


def labs_in_folder(folder, folder_name, notes, budget):
    """The labs of its files, and those of each archive in it, the newest first."""
    entries, archives = [], []
    for name, path in files_in(folder, budget):
        when = os.lstat(path).st_mtime
        if PACKED.fullmatch(path.name):
            archives.append((-when, name, path))
        else:
            entries.append((name, when, functools.partial(content_of, path, budget)))
    found = [chosen(entries, folder_name, notes)] if entries or not archives else []
    found += [labs_in(path, name, notes, budget) for _, name, path in sorted(archives)]
    return newest(found, notes)


def files_in(folder, budget):
    """Yield (name, path) of a folder's files. Links are not followed."""
    for parent, folders, files in os.walk(folder, onerror=fail):
        folders[:] = sorted(name for name in folders if not is_not_theirs(name))
        budget.pay(EACH_FILE * len(files))
        for file in sorted(files):
            yield Path(parent, file).relative_to(folder).as_posix(), Path(parent, file)


def fail(error):
    raise error


class Paid(io.BufferedReader):
    """A file of which no more is read than a budget allows, whatever an archive says of itself."""

    def __init__(self, path, budget):
        super().__init__(io.FileIO(path, opener=lambda name, flags: os.open(name, flags | NO_LINK)))
        self.budget = budget

    def read(self, size=-1):
        most = max(0, self.budget.left) + 1
        content = super().read(min(size, most) if size >= 0 else most)
        self.budget.pay(len(content))
        return content


def opened(path, budget):
    """A regular file, opened. A link is not followed."""
    if not stat.S_ISREG(os.lstat(path).st_mode):
        raise ValueError("is not a file but a link or the like: put the file there")
    return Paid(path, budget)


def content_of(path, budget):
    with opened(path, budget) as file:
        return file.read(MOST_TEXT + 1)


def entries_of(archive, when):
    """Yield what `chosen` takes. Of entries of one name, the content is the last one's."""
    for name in archive.namelist():
        entry = archive.getinfo(name)
        if not entry.is_dir():
            yield name, when, functools.partial(zip_entry, archive, entry)


def zip_entry(archive, entry):
    """A file of an archive, and never more than MOST_TEXT + 1 bytes of it."""
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in (0, stat.S_IFREG):
        raise ValueError("is not a file in the archive but a link or the like: put the file there")
    if entry.flag_bits & 1 or entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError("is encrypted or packed in an unusual way: make a plain zip")
    with archive.open(entry) as file:
        return file.read(MOST_TEXT + 1)
