"""What an output folder remembers of how it was asked for."""
import json
import os
import sys

import pytest

from labkit.grading.grade import own_seed
from labkit.grading.request import Request, recalled, remember


@pytest.fixture
def ask(tmp_path):
    """ask(labs="1-2", due="...") -> (the whole request, what is said), then remembered."""
    def asked(**options):
        request, said = recalled(Request("in", tmp_path, **options))
        remember(request)
        return request, said

    return asked


def test_an_option_that_is_not_given_again_is_as_it_was(ask, tmp_path):
    """A deadline, lateness or points by hand are gone after the next command, without a word."""
    by_hand = tmp_path / "o.csv"
    by_hand.touch()
    first, said = ask(labs="1-2", extra=True, due="2026-11-22T23:59", late="10%/day",
                      overrides=os.path.relpath(by_hand))
    assert said == "" and first.seconds is None
    again, said = ask(grace="1h", seconds=4.0)
    assert again == first._replace(seconds=4.0, grace="1h", overrides=str(by_hand))
    assert said == ("as in the last run: --labs 1,2 --extra --due 2026-11-22T23:59 --late 10%/day "
                    f"--overrides {by_hand}")
    third, _ = ask()
    assert third.seconds == 4 and third.grace == "1h"


def test_an_option_is_forgotten_with_an_empty_text(ask):
    """Nobody can take a deadline back."""
    ask(due="2026-11-22T23:59", late="10%/day", seed=0)
    for options in {"due": "", "late": ""}, {}:
        asked, _ = ask(**options)
        assert (asked.due, asked.late, asked.seed) == (None, None, 0)


def test_the_rule_for_points_can_be_taken_back(ask):
    """Who has tried --all-or-nothing grades so for ever."""
    assert ask(labs="1", all_or_nothing=True)[0].all_or_nothing
    assert ask()[1] == "as in the last run: --labs 1 --all-or-nothing"
    assert not ask(all_or_nothing=False)[0].all_or_nothing
    assert not ask()[0].all_or_nothing


def test_other_labs_do_not_go_into_the_same_folder(ask):
    """The table of labs 1 to 3 becomes one of lab 1; or 1-2 and 1,2 are two things."""
    ask(labs="1-2")
    assert ask(labs="1,2")[0].labs == "1,2"
    with pytest.raises(ValueError, match="holds grades of labs 1,2, and not of 1: name another"):
        ask(labs="1")


def test_a_file_that_has_gone_since_is_told(ask, tmp_path):
    """The overrides of the last run count no more."""
    (tmp_path / "o.csv").touch()
    ask(overrides=str(tmp_path / "o.csv"))
    (tmp_path / "o.csv").unlink()
    with pytest.raises(ValueError, match="the last run's --overrides, is not there any more"):
        ask()
    assert ask(overrides="")[0].overrides is None


def test_the_seed_is_drawn_kept_and_secret(ask, tmp_path):
    """A seed that everybody knows: a submission finds its own, and runs the public checks."""
    first, _ = ask()
    assert first.seed >> 64 and ask()[0].seed == first.seed
    assert "seed" not in ask()[1]
    kept = tmp_path / "asked.json"
    assert json.loads(kept.read_text())["seed"] >> 64
    if sys.platform != "win32":
        assert kept.stat().st_mode & 0o777 == 0o600


def test_a_submission_has_no_time_to_try_all_seeds():
    """Of 2^31 seeds, it finds its own from its first inputs in 10 s, and runs the public checks."""
    seeds = [own_seed(7, {"transforms": str(k)}) for k in range(100)]
    assert 1 << 47 < max(seeds) < 10 ** 15  # more digits are not kept by a spreadsheet


def test_a_memory_that_cannot_be_read_is_no_empty_one(ask, tmp_path):
    """A new seed is drawn, and everybody gets other random inputs."""
    (tmp_path / "asked.json").write_text("{")
    with pytest.raises(ValueError, match=r"asked.json cannot be read: restore it"):
        ask()
