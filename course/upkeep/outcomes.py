"""Do two runs of a cell say the same to a reader? What another processor explains, does not count.

Printed text says the same if it is equal but for spaces and for the last digit of numbers with a
point or an exponent. Below ROUNDING all numbers are the same. Pictures say the same if they are
told in the same words, and if no block of BLOCK x BLOCK dots has another mean by more than LIMIT.
"""
import base64
import itertools
import re

import numpy as np

from . import pictures

NUMBER = re.compile(r"([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)")
ROUNDING = 1e-9
BLOCK, LIMIT = 32, 8  # of 255


def contents(output):
    """What an output shows, by its kind: {"text/plain": ..., "image/png": in base64, ...}."""
    contents = output.get("data", {"text/plain": output.get("text", "")})
    return {kind: "".join(content) for kind, content in contents.items()}


def difference(was, now):
    """How the outputs of a cell differ from those that were there, as a clause, or None."""
    if list(map(form, was)) != list(map(form, now)):
        return f"has {len(now)} outputs, and in the file {len(was)} or other ones"
    for old, new in zip(map(contents, was), map(contents, now), strict=True):
        for kind in old:
            differ = picture_difference if kind == "image/png" else text_difference
            if old[kind] != new[kind] and (clause := differ(old[kind], new[kind])):
                return clause


def form(output):
    """All of an output but what it shows, and how large."""
    told = output.get("metadata", {}).get("image/png", {}).get("alt")
    return output.output_type, output.get("name"), sorted(contents(output)), told


def text_difference(was, now):
    for old, new in itertools.zip_longest(was.splitlines(), now.splitlines(), fillvalue=""):
        parts = [NUMBER.split(re.sub(r"\s+", " ", line)) for line in (old, new)]
        if not all(map(says_the_same, *parts)) or len(parts[0]) != len(parts[1]):
            return f"prints {new!r}, and the file says {old!r}"


def says_the_same(old, new):
    """Are two words the same, or two numbers that rounding explains?"""
    if old == new or not (NUMBER.fullmatch(old) and NUMBER.fullmatch(new)):
        return old == new
    return abs(float(old) - float(new)) <= max(ROUNDING, last_digit(old), last_digit(new))


def last_digit(number):
    """A little more than one in the last digit of a number: "1.25e-3" -> 1.1e-05, "12" -> 0."""
    digits, _, exponent = number.lower().partition("e")
    if digits == number.lower() and "." not in digits:
        return 0.0
    return 1.1 * 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


def picture_difference(was, now):
    """Two pixels more or less are what other fonts explain."""
    old, new = (pictures.frames(base64.b64decode(picture))[0] for picture in (was, now))
    if len(old) != len(new) or np.abs(np.subtract(old[0].size, new[0].size)).max() > 2:
        return (f"draws {len(new)} pictures of {new[0].size} dots, "
                f"and the file has {len(old)} of {old[0].size}")
    size = np.minimum(old[0].size, new[0].size)
    distance = max(np.abs(blocks(one, size) - blocks(other, size)).max()
                   for one, other in zip(old, new, strict=True))
    if distance > LIMIT:
        return f"draws another picture than the file has: a block differs by {distance:.0f} of 255"


def blocks(frame, size):
    """The means of the blocks of a picture."""
    return np.asarray(frame.crop((0, 0, *size)).reduce(BLOCK), float)
