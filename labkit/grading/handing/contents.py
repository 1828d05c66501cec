"""The texts of labs, out of the bytes of their files, and the hash of these texts."""
import functools
import hashlib
from typing import NamedTuple

from ... import exercises, imports

MOST_TEXT = 1 << 18  # bytes of one lab


ABSENT = "there is no labs/{}.py in what was handed in"


class Lab(NamedTuple):
    """The file of one lab."""

    when: float | tuple         # the later, the greater
    source: str                 # the file's name, or the archive's
    content: bytes | ValueError  # or why there is none


def texts_of(labs, topics, notes) -> tuple[dict, dict]:
    """{topic or module: Lab} -> (their texts, {topic: sentence} of those that are not there).

    Of the student's own modules, those that the topics import. What cannot be taken is noted.
    """
    texts, missing = {}, {}
    for topic in topics:
        try:
            texts[topic] = text_of(labs[topic].content)
            notes += imports.pasted(topic, texts[topic])
        except KeyError:
            missing[topic] = ABSENT.format(topic)
        except ValueError as error:
            missing[topic] = f"labs/{topic}.py {error}"
    texts |= imports.own_modules(texts.values(), functools.partial(own_text, labs, notes))
    if not texts and notes:
        missing = {topic: f"{sentence} ({'; '.join(notes)})" for topic, sentence in missing.items()}
    return texts, missing


def own_text(labs, notes, name):
    """The text of a module of the student's own. None: it cannot be taken, which is noted."""
    try:
        return text_of(labs[name].content, imports.MOST_OWN)
    except KeyError:
        notes.append(f"labs/{name}.py, which is imported, is not beside the lab that imports it")
    except ValueError as error:
        notes.append(f"labs/{name}.py {error}")


def text_of(content, most=MOST_TEXT):
    """A lab's bytes, or the error that they gave -> its text, whose lines all end with \\n.

    It is all that the code can read of its own file, so it is what the hash is made of.
    """
    if isinstance(content, ValueError):
        raise content
    if len(content) > most:
        raise ValueError(f"has more than {most >> 10} kB; a long lab has 20")
    try:
        return content.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise ValueError(f"is not UTF-8 text (line {line}): save it as UTF-8") from None


def digest(texts) -> str:
    """The hash of the labs, however they were packed: 64 hexadecimal digits."""
    whole = hashlib.sha256()
    for topic in sorted(texts):
        whole.update(f"{topic}\0{exercises.digest(texts[topic])}\n".encode())
    return whole.hexdigest()


def readable(lab):
    """A lab's text, "" where it has none."""
    try:
        return text_of(lab.content)
    except ValueError:
        return ""
