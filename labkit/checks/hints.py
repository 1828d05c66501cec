"""Hints: which common mistake explains a wrong answer.

Some are found in the numbers alone: a flipped sign, swapped axes (suspicions.py). Others are known
mistakes of tests/mistakes/. What a mistake, or two at once, returned to each check that it fails is
kept as a fingerprint. It is named where a student's answer fails the same checks with the same
numbers, and no others. It "may be" one where an output, a column, or some of the checks is the
same.
"""
import functools
import hashlib
import itertools
import json
import operator
import re
from typing import NamedTuple

import numpy as np

from ..contract import as_array
from ..places import ROOT
from ..suspicions import ANYWHERE, ENOUGH, TRUTHS, Suspicion, evidence, suspicion
from .showing import arguments, shape_name

HINTS = ROOT / "tests" / "labs" / "hints.json"
WHOLE = "whole"
OTHER = "other"         # the fingerprint where inputs are not those of the known mistakes
MOST = 1 << 18          # numbers that a fingerprint is taken of
MOST_MADE = 1 << 20     # numbers and lists, of which each row is one, that it makes of an answer
NOTHING = Suspicion("", False)  # explains it: no suspicion
WHY = r"[,;:] (?![^\[]*\]).*$"  # of a suspicion: a comma in [..., 1] ends nothing
PLACE = r"( in (?:\[[^\]]*\](?: and )?)+| in all that is wrong| where [^,;:]*)"


def suspected(compared, call, returned):
    """The Suspicion that explains all that was compared, NOTHING, or None: nothing can be said.

    compared: of a Mismatch. call: function, args and kwargs of the last call, or None. returned:
    its result. What a check made of the result shows less surely what is wrong with it.
    """
    if not (compared and call):
        return None
    got, expected, agrees, picture = compared
    found, place = suspicion(*compared[:3], arguments(*call), picture), place_in(returned, got)
    if place is None:
        return found and found._replace(certain=found.certain and is_made_of(got, returned))
    if place is not WHOLE and evidence(got, expected, agrees) >= ENOUGH and any(
            is_right(output, compared) for output in returned):
        return Suspicion("the outputs are in the wrong order", True)
    if not got.any() and got.dtype.kind != "i":
        return NOTHING  # that it is zero everywhere is seen, and says nothing about the cause
    if found and place is not WHOLE:
        found = found._replace(sentence=f"in output {place + 1} {found.sentence}")
    return found or (NOTHING if compared.expected.any() else None)


def is_made_of(got, returned):
    """Are all numbers in got such as were returned? They may be a part, or several outputs."""
    outputs = returned if isinstance(returned, tuple) else (returned,)
    return bool(np.isin(got, np.concatenate([np.ravel(output) for output in outputs])).all())


def is_right(output, compared):
    """Is an output what was expected?"""
    output = as_array(output)
    return output.shape == compared.expected.shape and np.all(
        compared.agrees(output, compared.expected))


def place_in(returned, got):
    """Which output of what was returned got is: WHOLE, its number, or None."""
    def is_it(output):
        return output is got or (np.isscalar(output) and got.ndim == 0 and output == got)

    if not isinstance(returned, tuple):
        return WHOLE if is_it(returned) else None
    return next((number for number, output in enumerate(returned) if is_it(output)), None)


class Pattern(NamedTuple):
    """How a wrong answer does in the checks of an exercise.

    failed {check: the fingerprint of what it was returned, or None} of the question, and of the
    fine print where the question is answered; numbers: so many were returned there. drawn: those
    of the checks whose numbers are drawn at random.
    """

    failed: dict
    numbers: int
    drawn: frozenset = frozenset()


def pattern(checks):
    """The Pattern of checks that fail."""
    counted = [check for check in checks if not check.fine_print] or checks
    return Pattern({name(check.nodeid): check.mark for check in counted},
                   sum(check.numbers for check in counted),
                   frozenset(name(check.nodeid) for check in counted if check.drawn))


def known_mistake(exercise, found):
    """"this is what comes out when ...": the known mistake that has the Pattern found, or None.

    All that it fails is failed, with the same numbers, and nothing else. Or it is two that do this
    together. Fewer than ENOUGH numbers can be the same by chance.
    """
    listed = known_mistakes().get(exercise, ())
    said = [sentence for sentence, failed in listed
            if found.numbers and agree(failed, found.failed)]
    said += [f"two things are wrong at once. One: {listed[one][0]}. The other: {listed[other][0]}"
             for mark, one, other in known_mistakes().get(f"{exercise} twice", ())
             if mark == digest(found.failed)]
    if len(said) != 1:  # with another seed, two mistakes may agree in all that can be compared
        return None
    certain = found.numbers >= ENOUGH and OTHER not in found.failed.values()
    return f"this {'is' if certain else 'may be'} what comes out when {said[0]}"


def agree(known, found):
    """Do both fail the same checks, with the same numbers where these can be compared?"""
    return known.keys() == found.keys() and all(
        came == OTHER or whole(came) == whole(known[check]) for check, came in found.items())


def digest(failed):
    """Ten letters for all that a Pattern's failed checks were returned."""
    told = repr(sorted((check, whole(mark)) for check, mark in failed.items()))
    return hashlib.sha256(told.encode("utf-8")).hexdigest()[:10]


def in_part(exercise, found):
    """"in output 2 this is what comes out when ...", of one or two known mistakes, or None.

    All checks that they fail are failed. What came is theirs in a part, wherever they spoil it. Of
    columns, no other is wrong. It "may be" theirs unless several checks say so, one of them with
    numbers that are drawn.
    """
    named = {}
    for sentence, failed in known_mistakes().get(exercise, ()):
        if failed.keys() <= found.failed.keys() and (places := alike(failed, found.failed)):
            sure = len(failed) > 1 and failed.keys() & found.drawn
            named.setdefault(places, []).append(
                f"this {'is' if sure else 'may be'} what comes out when {sentence}")
    clear = {places: said for places, [said, *more] in sorted(named.items()) if not more}
    wrong = {part.partition(":")[0] for mark in found.failed.values()
             for part in (mark or "").split() if "." in part}
    if not wrong <= {*itertools.chain(*clear)}:
        clear = {places: said for places, said in clear.items() if "." not in places[0]}
    if 0 < len(clear) <= 2:
        return "; ".join(f"{in_words(places)} {said}" for places, said in clear.items())


def alike(known, found):
    """The places where a wrong answer does as a known mistake: ("2",), ("1.0", "1.2"), or () if
    there is none. Of columns, all that it spoils.
    """
    same = {}
    for check, mark in known.items():
        if mark and found[check] != OTHER:
            came = (found[check] or "").split()
            for part in mark.split()[1:]:
                same.setdefault(part.partition(":")[0], []).append(part in came)
    places = [place for place, are in same.items() if all(are)]
    outputs = tuple(place for place in places if "." not in place)
    return outputs or (tuple(places) if len(places) == len(same) else ())


def in_words(places):
    """in output 2, in [..., 1] and [..., 2], in 5 places."""
    named = [f"[..., {place[2:]}]" if "." in place else f"output {place}" for place in places]
    return "in " + (" and ".join(named) if len(named) < 4 else f"{len(named)} places")


def in_checks(exercise, checks):
    """"in 3 of 4 checks this may be what comes out when ...": the known mistake whose numbers came
    in half of the Checks, or the only one whose numbers came in any of them; else None.
    """
    found = []
    for sentence, failed in known_mistakes().get(exercise, ()):
        same = [check for check in checks if (mark := failed.get(name(check.nodeid)))
                and whole(mark) == whole(check.mark)]
        if sum(check.numbers for check in same) >= ENOUGH:
            found.append((len(same), sentence, same))
    if not found:
        return None
    (most, sentence, same), *others = sorted(found, reverse=True)
    if others and (others[0][0] == most or most < max(2, len(checks) / 2)):
        return None
    return f"in {claims(same, checks)} this may be what comes out when {sentence}"


def whole(mark):
    """The fingerprint of all that was returned, without those of its parts."""
    return mark and mark.partition(" ")[0]


def hint(exercise, checks):
    """The hint that holds for all these Checks, those of an exercise that fail, or None.

    A known mistake explains all of them, or two do. A suspicion is certain of one, or else that of
    several, and no other speaks against it. Where it tells no cause, mistakes explain a part, or a
    suspicion one claim.
    """
    found = pattern(checks)
    if any("changed its input" in check.message for check in checks):
        return None  # which says it all
    if known := known_mistake(exercise, found):
        return known
    checks = [check for check in checks if name(check.nodeid) in found.failed]
    said = [Suspicion(*check.suspected) for check in checks if check.suspected is not None]
    suspected = told(said, sure=any(one.certain for one in said) or (
        len(said) > 1 and said[0].sentence[-1:] != "?" and ANYWHERE not in said[0].sentence))
    if suspected and is_sure(suspected) and checks[0].suspected is not None:
        return suspected
    hints = [in_part(exercise, found), of_one_claim(checks), suspected, in_checks(exercise, checks)]
    return next((hint for hint in hints if hint and is_sure(hint)),
                next(filter(None, hints), None))


def of_one_claim(checks):
    """'in "The rows sum to 1": it is twice as much', of the first Check that suspects it surely, or
    None.
    """
    for check in checks:
        if check.suspected and check.suspected[1] and is_sure(check.suspected[0]):
            return f"in {claims([check], checks)}: {check.suspected[0]}"


def claims(some, checks):
    """What a report on the first of the Checks calls some of them: this claim, "The rows sum to 1",
    3 of 4 checks.
    """
    if len(some) > 1:
        return f"{len(some)} of {len(checks)} checks"
    claim = some[0].claim.partition(" [")[0]
    return "this claim" if some[0] is checks[0] else f'"{claim}"'


def told(said, sure):
    """The sentence of several Suspicions that say one thing, each of its own numbers, or None.

    Where they say it of several places, or with several factors, it is that of the first.
    """
    sentences = [one.sentence for one in said]
    if not all(sentences) or len({*map(kernel, sentences)}) != 1 or not (sure or len(said) > 1):
        return None
    if len({"".join(re.findall(WHY, sentence)) for sentence in sentences}) > 1:
        sentences[0] = common(sentences)
    return str(Suspicion(sentences[0], sure))


def common(sentences):
    """The first sentence, and of the inputs after its ";" those that the others have, too."""
    named = [sentence.partition("; ")[2].partition(" is ")[0].split(" or ")
             for sentence in sentences]
    shared = " or ".join(name for name in named[0] if all(name in names for names in named))
    value = sentences[0].rpartition(" is ")[2]
    return re.sub(WHY, "", sentences[0]) + (f"; {shared} is {value}" if shared else "")


def kernel(sentence):
    """What a suspicion says, without the place, and without how much more or how many times."""
    return re.sub(rf"^in output \d+ |{PLACE}|[\d.e-]+ (?=times|more|less)|{WHY}", "", sentence)


def is_sure(said):
    """Is a hint certain, and does it tell a cause? Zeros or a factor without a reason do not."""
    return "may be" not in said and not re.search(
        rf"zero everywhere$|(what was|more than|less than) expected({PLACE})?$", said)


@functools.cache
def known_mistakes():
    """{exercise: [(sentence, its Pattern's failed)]}: tests/labs/hints.json, see upkeep."""
    try:
        return json.loads(HINTS.read_bytes())
    except OSError:
        return {}


def name(nodeid):
    """tests/labs/test_x.py::test_y[one] -> test_y[one]: an exercise has all its checks in one file.
    """
    return nodeid.split("::", 1)[-1]


def fingerprint_and_count(nodeid, returned, compared=None):
    """(fingerprint, `count`) of what a check was returned; (None, 0) if nothing was, or too much.

    Or of an array that it made of what was returned: then the rest does not matter, as an order.
    """
    if compared and compared.got.size >= ENOUGH and place_in(returned, compared.got) is None:
        returned = compared.got
    if returned is None or count(returned) > MOST or made(returned) > MOST_MADE:
        return None, 0
    marks = [fingerprint(nodeid, returned)]
    marks += [f"{place}:{fingerprint(nodeid + place, part)[:6]}"
              for place, part in parts(returned, compared) if count(part) >= ENOUGH]
    return " ".join(marks), count(returned)


def parts(returned, compared):
    """Yield (place, part): "2" and output 2 of several, "2.0" and its column 0, if that is wrong.

    Columns are those of what was compared, where it has up to 4.
    """
    for number, output in enumerate(returned if isinstance(returned, tuple) else (), 1):
        yield str(number), as_array(output)
    if compared is None or compared.got.shape != compared.expected.shape:
        return
    got, place = compared.got, place_in(returned, compared.got)
    if place is not None and got.ndim > 1 and 1 < got.shape[-1] <= 4 and got.dtype.kind in "fc":
        right = np.broadcast_to(compared.agrees(got, compared.expected), got.shape)
        for k in np.flatnonzero(~right.reshape(-1, got.shape[-1]).all(0)):
            yield f"{1 if place is WHOLE else place + 1}.{k}", got[..., k]


def count(returned):
    """How many numbers or letters were returned; TRUTHS truth values say as much as one number."""
    return sum(np.size(output) // (TRUTHS if as_array(output).dtype == bool else 1)
               for output in outputs(returned))


def made(returned):
    """The numbers and lists that a fingerprint makes. An axis of length 1 is a list of each number.
    """
    return sum(sum(itertools.accumulate((max(n, 1) for n in np.shape(output)), operator.mul))
               for output in outputs(returned))


def outputs(returned):
    """Yield what was returned, and of tuples, also in tuples, what is in them."""
    for output in returned if isinstance(returned, tuple) else (returned,):
        yield from outputs(output) if isinstance(output, tuple) else (output,)


def fingerprint(nodeid, returned):
    """Twelve letters for what a check was returned: the same for equal numbers but for rounding."""
    parts = [nodeid.rpartition("/")[2]]
    several = isinstance(returned, tuple) or as_array(returned).dtype == object
    for output in returned if several and np.iterable(returned) else (returned,):
        array = as_array(output)
        if array.dtype.kind in "fc":
            size = np.abs(array[np.isfinite(array)]).max(initial=1e-3)
            array = np.round(array, int(6 - np.ceil(np.log10(size) - 1e-9))) + 0.0  # no -0
        kind = "n" if array.dtype.kind in "iufc" else array.dtype.kind
        numbers = array.astype(complex) if kind == "n" else array
        parts += [kind, shape_name(array), str(numbers.tolist())]
    return hashlib.sha256("|".join(parts).encode("utf-8")).hexdigest()[:12]
