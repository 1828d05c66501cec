"""A counted share of the machine for a worker, where cgroup v2 is there and may be used.

The kernel itself counts all memory and processes of a share, and ends what goes beyond. An ordinary
user needs a part of the tree that is theirs: systemd-run --user --scope python3 -m course grade ...
"""
import contextlib
import functools
import os
import tempfile
import time
from pathlib import Path

TREE = Path("/sys/fs/cgroup")
OWN = Path("/proc/self/cgroup")


@functools.cache
def ground():
    """The nearest folder, from our own group upwards, where shares can be made. None: nowhere."""
    with contextlib.suppress(OSError, StopIteration):
        lines = OWN.read_text().splitlines()
        own = TREE / next(line for line in lines if line.startswith("0::")).removeprefix("0::/")
        return next(filter(fertile, (own, *own.parents)))
    return None


def fertile(folder):
    try:
        controllers = (folder / "cgroup.subtree_control").read_text().split()
    except OSError:
        return False
    return {"memory", "pids"} <= {*controllers} and os.access(folder / "cgroup.procs", os.W_OK)


class Share:
    """The share of some processes and of all that they start. Without a ground it does nothing."""

    def __init__(self, pids, memory, processes):
        self.folder = None
        try:
            self.folder = ground() and Path(tempfile.mkdtemp(prefix="worker-", dir=ground()))
            self.take(pids, memory, processes)
        except OSError:  # not ours after all
            self.close()

    def take(self, pids, memory, processes):
        if self.folder:
            (self.folder / "memory.max").write_text(str(memory))
            (self.folder / "memory.oom.group").write_text("1")  # beyond it, none goes on
            (self.folder / "pids.max").write_text(str(processes))
            with contextlib.suppress(OSError):  # there is no swap
                (self.folder / "memory.swap.max").write_text("0")
            for pid in pids:
                (self.folder / "cgroup.procs").write_text(str(pid))

    def is_exceeded(self):
        """Has the kernel ended the processes because the share's memory was used up?"""
        try:
            events = (self.folder / "memory.events").read_text().split() if self.folder else []
        except OSError:
            return False
        return "oom_kill" in events and events[events.index("oom_kill") + 1] != "0"

    def close(self):
        """End what is left in the share, and give it back."""
        if self.folder:
            with contextlib.suppress(OSError):  # Linux before 5.14 has none
                (self.folder / "cgroup.kill").write_text("1")
        for _ in range(250 * bool(self.folder)):
            with contextlib.suppress(OSError):  # its processes are still on their way out
                self.folder.rmdir()
                break
            time.sleep(0.02)
        self.folder = None
