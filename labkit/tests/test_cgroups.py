"""Shares of the machine, on folders like those of cgroup v2. The kernel's own part is not here."""
import shutil

import pytest

from labkit.grading.apart import cgroups


@pytest.fixture
def tree(tmp_path, monkeypatch):
    """Our group is slice/ours. Shares can be made in slice, and in the tree's root."""
    for folder, controllers in (("", "memory pids"), ("slice", "cpu memory pids"),
                                ("slice/ours", "")):
        (tmp_path / folder).mkdir(exist_ok=True)
        (tmp_path / folder / "cgroup.subtree_control").write_text(controllers)
        (tmp_path / folder / "cgroup.procs").write_text("")
    own = tmp_path / "own"
    own.write_text("1:name=systemd:/elsewhere\n0::/slice/ours\n")
    monkeypatch.setattr(cgroups, "TREE", tmp_path)
    monkeypatch.setattr(cgroups, "OWN", own)
    cgroups.ground.cache_clear()
    yield tmp_path
    cgroups.ground.cache_clear()


def test_shares_are_made_in_the_nearest_folder_that_counts(tree):
    """The first folder taken though it counts nothing, or the root though a nearer one will do."""
    assert cgroups.ground() == tree / "slice"


def test_without_the_controllers_or_without_cgroup_v2_there_is_no_ground(tree):
    """An error, or a share that counts processes alone."""
    for folder in ("", "slice"):
        (tree / folder / "cgroup.subtree_control").write_text("pids")
    assert cgroups.ground() is None
    cgroups.ground.cache_clear()
    cgroups.OWN.write_text("4:memory:/slice/ours\n")
    assert cgroups.ground() is None
    cgroups.Share([1], 1 << 28, 20).close()


def test_a_share_has_its_limits_and_its_processes_and_goes_when_they_have_gone(tree, monkeypatch):
    """A limit that is not set, processes that stay outside, a folder left for each worker."""
    share = cgroups.Share([71, 72], 1 << 28, 20)
    folder = share.folder
    written = {path.name: path.read_text() for path in folder.iterdir()}
    assert written == {"memory.max": str(1 << 28), "memory.swap.max": "0", "memory.oom.group": "1",
                       "pids.max": "20", "cgroup.procs": "72"}  # the kernel would add 72 to 71
    monkeypatch.setattr(cgroups.time, "sleep",  # a real folder goes with its files
                        lambda _: [path.unlink() for path in folder.iterdir()])
    share.close()
    assert not folder.exists()
    assert share.folder is None


def test_two_graders_with_one_number_have_their_own_shares(tree, monkeypatch):
    """Containers count processes from 1: one grader's workers ended by another's."""
    monkeypatch.setattr(cgroups.os, "getpid", lambda: 7)
    first, second = (cgroups.Share([1], 1 << 28, 20).folder for _ in range(2))
    assert first.exists()
    assert first != second


def test_a_share_that_cannot_be_made_does_nothing(tree, monkeypatch):
    """A read-only tree, as in most containers, that ends the run or costs every worker a second."""
    shutil.rmtree(cgroups.ground())
    monkeypatch.setattr(cgroups.time, "sleep", lambda _: pytest.fail("it waits for nothing"))
    share = cgroups.Share([1], 1 << 28, 20)
    assert share.folder is None
    assert not share.is_exceeded()
    share.close()


@pytest.mark.parametrize(("events", "told"), [
    ("oom 0\noom_kill 0\n", False), ("oom 1\noom_kill 3\noom_group_kill 1\n", True), ("", False)])
def test_a_share_tells_whether_its_memory_was_used_up(tree, events, told):
    """Every death put down to memory, or none."""
    share = cgroups.Share([1], 1 << 28, 20)
    (share.folder / "memory.events").write_text(events)
    assert share.is_exceeded() is told
