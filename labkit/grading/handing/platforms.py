"""The names that platforms give to what was handed in: who sent it, and when.

    lovelaceada_LATE_1234_56789_labs-1.zip      Canvas: name, user, file; a group's name as well
    anon_Ab3dE_56789_labs.zip                   Canvas, when names are hidden
    lovelaceada_1234_text.html, _link.html      Canvas: text or an address in the place of a file
    Ada Lovelace_1234_assignsubmission_file/    Moodle: name, participant; a file's name may follow
    ada@x.edu_2_handin.zip                      Autolab: e-mail, version, file
    submission_1234/                            Gradescope, beside submission_metadata.yml
    ada/, ada.zip, ada_transforms.py            by hand

Canvas's names are made in its lib/content_zipper.rb, Moodle's in mod/assign/classes/downloader.php.
In the name of a Moodle folder, the last number is Moodle's. In that of a file, which ends as its
student likes, it is the first.
"""
import contextlib
import datetime
import re
import unicodedata
from typing import NamedTuple

from ... import exercises
from . import archives

METADATA = "submission_metadata.yml"
NOT_HANDED_IN = {METADATA, "__MACOSX", ".DS_Store", ".git", "Thumbs.db", "desktop.ini"}
CANVAS = re.compile(r"(?P<name>.+?)(?P<late>_LATE)?_(?P<id>\d+)"
                    r"_(?:(?P<order>\d+)_.+|(?:text|link)\.html)", re.S)
ANONYMOUS = re.compile(r"(?P<late>LATE_)?(?P<name>anon_[0-9A-Za-z]+)"
                       r"_(?:(?P<order>\d+)_.+|(?:text|link)\.html)", re.S)
AUTOLAB = re.compile(r"(?P<email>.+?@[^_]+)_(?P<order>\d+)_.+", re.S)
MOODLE_FOLDER = re.compile(r"(?P<name>.+)_(?P<id>\d+)_assign(?:submission|feedback)_[a-z]+_?", re.S)
MOODLE = re.compile(r"(?P<name>.+?)(?:_(?P<id>\d+))?_assign(?:submission|feedback)_[a-z]+.*", re.S)
FORMS = (("moodle", MOODLE_FOLDER), ("moodle", MOODLE), ("autolab", AUTOLAB),
         ("canvas", ANONYMOUS), ("canvas", CANVAS))


class Identity(NamedTuple):
    """What a platform tells of a person. "": it does not tell that."""

    platform: str = ""
    id: str = ""
    name: str = ""
    email: str = ""
    file: str = ""   # the name that the platform gave to what was handed in


class Sender(NamedTuple):
    """Who handed something in."""

    student: str     # the same for all that this person hands in, and nobody else's
    identity: Identity
    order: float = 0               # the later it was handed in, the greater
    handed_in: float | None = None  # seconds since 1970 UTC
    late: bool | None = None  # as the platform says; None: it says nothing


def senders(path, submitters) -> list[Sender]:
    """Those who handed in what lies at a path. Several: a group. []: nobody.

    submitters: of `gradescope`.
    """
    whole = archives.printable(unicodedata.normalize("NFC", path.name))
    name = " ".join(whole.split())
    if found := submitters.get(name.partition(".")[0]):
        return found
    for platform, form in FORMS:
        if (form is not MOODLE_FOLDER or path.is_dir()) and (match := form.fullmatch(name)):
            return [named(platform, name, **match.groupdict())]
    person = by_hand(path, whole)
    return [Sender(person, Identity(name=person))] if person else []


def named(platform, file, name="", id=None, email="", order=None, late=None):
    """The Sender that the parts of a file's name tell of. Canvas alone says who is in time."""
    return Sender(f"{name}_{id}" if id else name or email,
                  Identity(platform, id or "", name, email, file), int(order or 0),
                  late=bool(late) if platform == "canvas" else None)


def by_hand(path, name):
    """ada/, ada.tar.gz, ada_transforms.py -> "ada". "": nobody."""
    person, topic = archives.named_lab(name)
    packed = archives.PACKED.fullmatch(name)
    if not topic and (path.is_dir() or path.is_symlink() or packed):
        person = packed[1] if packed and not path.is_dir() else name
    words = re.sub(archives.COPY + "$", "", person).casefold()
    return "" if words in {"labs", *exercises.topics()} or name.startswith(".") else person


# --- Gradescope -------------------------------------------------------------------------------


def gradescope(folder) -> dict[str, list[Sender]]:
    """{"submission_1234": [a Sender for each of its submitters]} of an export."""
    path = folder / METADATA
    if not path.is_file():
        return {}
    try:
        import yaml
        whole = yaml.load(path.read_bytes(), getattr(yaml, "CBaseLoader", yaml.BaseLoader))
        return {name: [submitter(one, about.get(":created_at")) for one in about[":submitters"]]
                for name, about in whole.items() if about.get(":submitters")}
    except ImportError:
        raise ValueError(f"{METADATA} cannot be read without PyYAML: pip install pyyaml") from None
    except (yaml.YAMLError, AttributeError, KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path} is not as Gradescope exports it "
                         f"({archives.reason(error)}): download it again") from None


def submitter(about, created):
    id, name, email = (archives.printable(about.get(field) or "")
                       for field in (":sid", ":name", ":email"))
    when = gradescope_time(created)
    return Sender(id or email or name, Identity("gradescope", id, name, email), when or 0, when)


def gradescope_time(text):
    """"2026-01-02 10:00:00.418372000 Z" -> seconds since 1970. None: it is no time."""
    with contextlib.suppress(TypeError, ValueError):
        when = datetime.datetime.fromisoformat(re.sub(r"\s+(?=Z|[+-]\d)", "", text))
        return (when if when.tzinfo else when.replace(tzinfo=datetime.UTC)).timestamp()
