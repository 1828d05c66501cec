"""Points by claims that hold: an exercise's share of them, and one sum in all that is written."""
import itertools

import pytest
from graded import check, entry, exercise, record, result, submission

from labkit import verdicts
from labkit.grading.gradebook import tables, worth
from labkit.grading.gradebook.book import Gradebook
from labkit.grading.pages import report
from labkit.grading.request import Request

EDGE, COVER = COLUMNS = [exercise("2.1", "edge", 4), exercise("2.2", "cover", 3)]

DRAWN = check("2.2", "drawn", "failed")._replace(drawn=True)


def half_right(asked=COVER, verdict="failing", held=4, of=5, *more):
    """An exercise of which so many claims hold."""
    return entry(asked, verdict, *(
        check(asked.number, f"claim {k}", "passed" if k < held else "failed")
        for k in range(of)), *more)


@pytest.mark.parametrize(("found", "reached", "claims"), [
    (half_right(), 2, (4, 5)),
    (half_right(held=3), 1.5, (3, 5)),
    (half_right(held=1), 0.5, (1, 5)),
    (half_right(held=0), 0, (0, 5)),
    (half_right(held=5, verdict="done"), 3, (5, 5)),
    (half_right(held=5), 2, (5, 5)),  # its process was lost after that
    (half_right(verdict="not started"), 0, (4, 5)),
    (half_right(verdict="blocked by 2.1"), 2, (4, 5)),
    (half_right(COVER, "failing", 1, 2, check("2.2", fine_print=True)), 1.5, (1, 2)),
    (half_right(COVER, "done", 2, 2, check("2.2", verdict="failed", fine_print=True)), 3, (2, 2)),
    (entry(COVER, "failing", check("2.2", "a[1]"), check("2.2", "a[2]", "failed"),
           check("2.2", "b"), check("2.2", "c", "not run")), 1, (1, 3)),
    (entry(COVER, "failing", check("2.2", "a"), DRAWN), 0, (1, 2)),
    (entry(COVER, "failing", check("2.2", "a", "failed"), check("2.2", "b", "failed"),
           DRAWN._replace(verdict="passed")), 1, (1, 3)),
    (entry(COVER, "not readable"), 0, (0, 0))])
def test_an_exercise_gives_the_share_of_its_claims_that_hold(found, reached, claims):
    """A check that did not run is no claim, each case of a claim is one, fine print gives or costs
    points, a third is rounded up, or all points are there for what is not done. Numbers that are
    typed in from the checks give points.
    """
    assert (found.reached, found.claims) == (reached, claims)
    assert verdicts.points([found, found]) == (2 * reached, 6)


VERDICTS = "passed", "failed", "not started", "not run", "blocked by 2.1"


@pytest.mark.parametrize("spoilt", [False, True])
def test_a_mark_only_rises_when_one_more_claim_holds(spoilt):
    """Who mends one of two claims loses the points of the third, which was not begun. Or all claims
    hold, the process ends badly, and there are fewer points than for all but one.
    """
    def reached(found):
        checks = [check("2.2", str(k), one)._replace(drawn=k == 0) for k, one in enumerate(found)]
        verdict = "failing" if spoilt else verdicts.verdict_of([*found], [])
        return entry(COVER, verdict, *checks).reached

    for found in itertools.product(VERDICTS, repeat=3):
        for k in range(3):
            assert reached(found) <= reached((*found[:k], "passed", *found[k + 1:])), found


def test_all_that_is_written_has_the_same_half_points():
    """The table rounds, the report says all points or none, or the platform gets another sum."""
    ada = record(submission("ada"), result(half_right(EDGE, "done", 2, 2), half_right(held=3)))
    cells = tables.line(ada, COLUMNS)
    assert [cells[name] for name in ("2.1 edge", "2.2 cover", "core", "total", "after lateness")
            ] == ["4", "1.5", "5.5", "5.5", "5.5"]
    page = report.page(ada, {}, "")
    assert "5.5 of 7 points" in page and "1.5 of 3 points: 3 of 5 claims hold" in page
    assert '<td class="number">1.5</td><td class="number">3</td>' in page
    by_hand = ada._replace(overrides=record(None, None, overrides={"2.2": (2.5, "x")}).overrides)
    assert worth.override_sentences(by_hand) == ["2.2: 2.5 instead of 1.5 by hand (x)"]


def test_all_or_nothing_is_another_sum_of_the_same_checks():
    """Everybody is graded again for it, a page keeps the other sum, or nobody can say why."""
    ada = record(submission("ada"), result(half_right(EDGE, "done", 2, 2), half_right(held=3)))
    strict, by_share = (Gradebook(Request("in", "out", all_or_nothing=only), [ada.work],
                                  COLUMNS).entered(ada) for only in (True, None))
    cells, page = tables.line(strict, COLUMNS), report.page(strict, {}, "")
    assert (cells["2.2 cover"], cells["total"]) == ("0", "4")
    assert "4 of 7 points" in page and "0 of 3 points: 3 of 5 claims hold" in page
    *_, left = worth.changes(by_share, strict)
    assert left == ("ada", worth.LEFT, "5.5", "4", "all or nothing")
