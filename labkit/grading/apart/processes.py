"""What the system tells of processes: who descends from whom, what they use, who is left over."""
import contextlib
import ctypes
import os
import re
import signal
import sys
from pathlib import Path
from typing import NamedTuple

WORKERS = set()   # their process numbers
ADOPTING = []     # not empty where orphans come to this process


class Use(NamedTuple):
    """What some processes use. asleep: all of them wait for something."""

    memory: int = 0     # bytes, in memory or swapped out
    seconds: float = 0  # of processors, up to now
    asleep: bool = True


def use_of(pids):
    """The Use of these processes. Zeros where there is no /proc."""
    total = Use()
    for pid in pids:
        with contextlib.suppress(OSError, ValueError):
            total = added(total, pid)
    return total


def added(total, pid):
    fields = Path(f"/proc/{pid}/stat").read_text(errors="replace").rpartition(")")[2].split()
    sizes = re.findall(r"^Vm(?:RSS|Swap):\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text(
        errors="replace"), re.MULTILINE)
    ticks = sum(map(int, fields[11:15]))  # its own and its ended children's, user and system
    return Use(total.memory + 1024 * sum(map(int, sizes)),
               total.seconds + ticks / os.sysconf("SC_CLK_TCK"),
               total.asleep and fields[0] not in "RD")


def adopt_orphans():
    """From now on, a process that has lost its parent becomes a child of this one (Linux)."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER
        ADOPTING.append(True)


def end_orphans():
    """End the children that are no workers. Each may leave others behind. See adopt_orphans."""
    while ADOPTING and (orphans := set(children().get(os.getpid(), ())) - WORKERS):
        for pid in orphans:
            with contextlib.suppress(ProcessLookupError, ChildProcessError):
                os.kill(pid, signal.SIGKILL)
                os.waitpid(pid, 0)


def children():
    """{process: its children}. Empty where there is no /proc."""
    found = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            parent = int(path.read_text(errors="replace").rpartition(")")[2].split()[1])
            found.setdefault(parent, []).append(int(path.parent.name))
    return found


def family(pid):
    """A process and all that descend from it."""
    below, members = children(), [pid]
    for member in members:
        members += below.get(member, ())
    return members


def offer_to_the_kernel(score):
    """Where memory runs out, let this process be ended before those with a lower score (Linux)."""
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text(str(score))
