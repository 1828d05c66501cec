"""Two threads and one pixel: every schedule ends as the reference says."""
import itertools

import numpy as np
from reading import opened, settled

from reference import kernels


def test_every_schedule_ends_as_the_references(call):
    """A thread writes what it should only have read, or compares with what is there by now."""
    face, depth = [7, 8, 9], [0.5, 0.25, 0.75]
    schedules = sorted(set(itertools.permutations([0, 0, 1, 1, 2, 2])))
    found = call("race", "race", [(face, depth, schedule) for schedule in schedules])
    wanted = [kernels.race(np.array(face), np.array(depth), np.array(s)) for s in schedules]
    assert [(steps[-1]["seen"], steps[-1]["nearest"]) for steps in found] == wanted
    assert len(set(wanted)) == 3


def test_two_of_six_schedules_go_wrong(page, address):
    """The verdict is that of the schedule before, or a schedule counts twice."""
    opened(page, address, "race")
    wrong = []
    for schedule in sorted(set(itertools.permutations("AABB"))) + [tuple("AABB")]:
        for name in schedule:
            page.get_by_role("button", name=f"{name} goes on").click()
            settled(page)
        if page.inner_text(".verdict").startswith("Wrong"):
            wrong.append("".join(schedule))
        page.get_by_role("button", name="Again").click()
    assert wrong == ["ABAB", "BAAB"]
    assert "6 of 6 schedules tried: two go wrong" in page.inner_text(".pane")
