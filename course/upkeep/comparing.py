"""Does a lecture's run give what its file has? Each difference in a sentence."""
import itertools
import json
import re

from ..given.places import read_whole
from . import notebooks, pictures

NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
NUMBER_LIMIT = 0.01                                # between two printed numbers
ROUNDING = 1e-9                                    # numbers below it are rounding errors


def compare(path):
    """Run the notebook again and hold it against the file -> list of differences, in sentences.

    Text and pictures must be equal byte for byte where the file was written with the versions and
    the rounding of this environment. Elsewhere fonts and roundings differ a little: there a number
    may be off by NUMBER_LIMIT of itself or by one in its last digit, and below ROUNDING all numbers
    are the same. For pictures see `pictures.difference`.
    """
    try:
        was = json.loads(read_whole(path))
        now = json.loads(notebooks.wait_for(notebooks.execute(path)))
    except (ValueError, OSError) as error:
        return [str(error)]
    here = was["metadata"].get("written_with") == now["metadata"]["written_with"]
    return [f"{path.name}: {difference}" for pair in zip(was["cells"], now["cells"], strict=True)
            for difference in cell_differences(*pair, here)]


def cell_differences(was, now, here):
    before, after = was.pop("outputs", []), now.pop("outputs", [])
    if was != now:
        yield f"{now['id']} has a name, count, source or metadata that the command does not write"
    if [form(output) for output in before] != [form(output) for output in after]:
        yield f"{now['id']} has {len(after)} outputs, and in the file {len(before)} or other ones"
        return
    for outputs in zip(before, after, strict=True):
        old, new = map(notebooks.contents, outputs)
        for kind in old:
            difference = (pictures.difference(old[kind], new[kind], here) if kind == "image/png"
                          else text_difference(old[kind], new[kind], here))
            if difference:
                yield f"{now['id']} {difference}"


def form(output):
    """All of an output but what it shows, and how large."""
    told = output.get("metadata", {}).get("image/png", {}).get("alt")
    return {**output, "text": None, "data": sorted(notebooks.contents(output)), "metadata": told}


def text_difference(was, now, here):
    for old, new in itertools.zip_longest(was.splitlines(), now.splitlines(), fillvalue=""):
        if old != new and (here or not says_the_same(old, new)):
            return f"prints {new!r}, and the file says {old!r}"


def says_the_same(old, new):
    """Are two lines equal but for spaces and for numbers that another rounding explains?"""
    words = [re.sub(r"\s+", "", NUMBER.sub("#", line)) for line in (old, new)]
    return words[0] == words[1] and all(
        abs(float(one) - float(other)) <= max(ROUNDING, NUMBER_LIMIT * abs(float(one)),
                                              last_digit(one), last_digit(other))
        for one, other in zip(NUMBER.findall(old), NUMBER.findall(new), strict=True))


def last_digit(number):
    """A little more than one in the last digit of a printed number: "1.25e-3" -> 1.1e-05."""
    digits, _, exponent = number.lower().partition("e")
    return 1.1 * 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))
