"""Do two runs of a cell say the same to a reader?

On one machine: if they print the same text, and draw pictures that are told in the same words and
of which no block of BLOCK x BLOCK dots has another mean by more than STEP.

Elsewhere, where another processor or another matplotlib drew them, numbers with a point or an
exponent may differ in their last digit, all numbers below ROUNDING are the same, pictures may be
two dots larger or smaller, and a share of their blocks, NOISE, may differ: curves that show nothing
but rounding errors take up to 0.017.
"""
import base64
import itertools
import re

import numpy as np

from . import pictures

NUMBER = re.compile(r"([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)")
ROUNDING = 1e-9
BLOCK, STEP, NOISE = 32, 8, 0.025


def contents(output):
    """What an output shows, by its kind: {"text/plain": ..., "image/png": in base64, ...}."""
    contents = output.get("data", {"text/plain": output.get("text", "")})
    return {kind: "".join(content) for kind, content in contents.items()}


def difference(was, now, elsewhere=False):
    """How the outputs of a cell differ from those that were there, as a clause, or None."""
    if list(map(form, was)) != list(map(form, now)):
        return f"has {len(now)} outputs, and the file has {len(was)}, or other ones"
    for old, new in zip(map(contents, was), map(contents, now), strict=True):
        for kind in old:
            differ = picture_difference if kind == "image/png" else text_difference
            if old[kind] != new[kind] and (clause := differ(old[kind], new[kind], elsewhere)):
                return clause


def form(output):
    """All of an output but what it shows, and how large."""
    told = output.get("metadata", {}).get("image/png", {}).get("alt")
    return output.output_type, output.get("name"), sorted(contents(output)), told


def text_difference(was, now, elsewhere):
    for old, new in itertools.zip_longest(was.splitlines(), now.splitlines(), fillvalue=""):
        parts = [NUMBER.split(re.sub(r"\s+", " ", line)) for line in (old, new)]
        alike = len(parts[0]) == len(parts[1]) and all(map(says_the_same, *parts))
        if old != new and not (elsewhere and alike):
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


def picture_difference(was, now, elsewhere):
    old, new = (pictures.frames(base64.b64decode(picture))[0] for picture in (was, now))
    if len(old) != len(new) or np.abs(np.subtract(old[0].size, new[0].size)).max() > 2 * elsewhere:
        return (f"draws {len(new)} pictures of {new[0].size} dots, "
                f"and the file has {len(old)} of {old[0].size}")
    size = np.minimum(old[0].size, new[0].size)
    share = max((np.abs(blocks(one, size) - blocks(other, size)) > STEP).any(-1).mean()
                for one, other in zip(old, new, strict=True))
    if share > NOISE * elsewhere:
        return f"draws another picture than the file has: {100 * share:.1f} % of it differ"


def blocks(frame, size):
    """The means of the blocks of a picture."""
    return np.asarray(frame.crop((0, 0, *size)).reduce(BLOCK), float)
