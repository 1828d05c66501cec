"""Workers from outside: how long they may take, what they may use, how they end.

What shuts them in is in levels.py. Here it is also tried, before the level `strict` is claimed.
"""
import contextlib
import math
import os
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import NamedTuple

from ... import places
from . import seccomp, wire
from .levels import environment, given, plain, strict
from .processes import WORKERS, Use, end_orphans, family, use_of

PROBE = Path(__file__).with_name("probe.py")
PATIENCE = 0.2         # seconds between two looks at a worker
CLOCK = 5              # so many times its limit may a worker take on the clock, on a busy machine
FILES_LEFT = "files"
MOST_FILES = 1000      # of a worker's folder: the system counts their bytes, and not their number


class Limits(NamedTuple):
    """Seconds and bytes."""

    call: float = 10.0        # one call of a function
    exercise: float = 120.0   # all calls of an exercise; on a busy machine they take long
    submission: float = 1800.0
    memory: int = 1 << 31     # of a worker's processes, each and together
    processes: int = 16


class Lost(Exception):
    """A worker that can't be used any longer, and why."""


class Worker:
    """A worker process. send a message, receive one. Lost where that fails or takes too long."""

    def __init__(self, level, limits=Limits(), more=()):  # noqa: B008, it does not change
        """more {name: text}: modules to be found beside what labs import of the course."""
        self.level = level
        self.limits = limits
        self.spent = 0.0  # seconds that the last answer took: see Meter
        self.folder = tempfile.mkdtemp(prefix="worker-")
        os.chmod(self.folder, 0o1777)
        command, settings = (strict if level == "strict" else plain)(self.folder, limits)
        self.socket, theirs = socket.socketpair()
        self.control, its_control = socket.socketpair()
        self.buffer = bytearray()
        with theirs, its_control:
            self.process = started(command, self.folder, theirs, its_control)
        self.guard = Guard(self.process.pid, limits.memory, level == "strict")
        try:
            self.begin(settings, given() | dict(more))
        except BaseException:  # such as Ctrl-C
            self.close()
            raise

    def begin(self, settings, modules):
        """Have it shut in, and watched from now on."""
        try:
            _, self.has = self.exchange(("start", settings, modules), 30)
        except Lost as lost:
            said = self.process.stderr.read1(2000).decode("utf-8", "replace").strip()
            raise Lost(said.splitlines()[-1] if said else str(lost)) from None
        self.guard.start()

    def exchange(self, message, seconds):
        """Send a message -> the one that comes back, in at most these seconds."""
        return self.decoded(self.relay(seconds, wire.encode(message)))

    def decoded(self, payload, named=None):
        """The message in a payload. named: the table of NamedTuples that it may hold."""
        try:
            message = wire.decode(payload, named, wire.MOST_ANSWER)
        except wire.Garbled as error:
            self.lose(f"what it sent cannot be read: {error}")
        if not (isinstance(message, tuple) and message and isinstance(message[0], str)):
            self.lose("what it sent is no message")
        return message

    def relay(self, seconds, *payloads):
        """Send payloads -> the one that comes back, as it came."""
        meter = Meter()
        if self.buffer:
            self.lose("it sent more than it was asked for")
        try:
            self.socket.settimeout(CLOCK * seconds)
            self.socket.sendall(b"".join(map(wire.framed, payloads)))
            while not (length := wire.complete(self.buffer)):
                self.watch(meter, seconds)
                self.buffer += self.received()
        except TimeoutError:
            self.lose(f"no answer within {seconds:.3g} s; it was stopped")
        except OSError:
            self.lose(f"the process ended{self.cause()}")
        except wire.Garbled as error:
            self.lose(f"what it sent cannot be read: {error}")
        self.spent = meter.total()
        answer = bytes(self.buffer[8:length])
        del self.buffer[:length]
        return answer

    def received(self):
        """Some bytes, b"" if none come for now. OSError: no more will come."""
        ready, _, _ = select.select([self.socket, self.control], [], [], PATIENCE)
        if self.socket in ready:
            if part := self.socket.recv(1 << 18):
                return part
            raise ConnectionError
        if ready:
            self.lose(f"the process ended{self.cause(self.status())}")
        return b""

    def watch(self, meter, seconds):
        """TimeoutError: it took too long."""
        meter.add(self.guard.look)
        if meter.spent > seconds or meter.clock() > CLOCK * seconds:
            raise TimeoutError

    def finish(self, seconds=10):
        """End the exercise: its process must go, and must have said no more than it was asked."""
        try:
            self.socket.sendall(wire.framed(wire.encode(("close",))))
            self.control.settimeout(seconds)
            status = self.status()
        except OSError:
            self.lose("the process did not end when it should")
        if status == FILES_LEFT:
            self.lose("it left files that cannot be removed")
        if status != 0:
            self.lose(f"the process ended{self.cause(status)}")
        if self.buffer or select.select([self.socket], [], [], 0)[0]:
            self.lose("it sent more than it was asked for")

    def status(self):
        """How the exercise's process has ended, as the worker's first process tells."""
        said = self.control.recv(64)
        with contextlib.suppress(ValueError):
            return FILES_LEFT if said == b"files" else int(said)
        return -signal.SIGKILL

    def lose(self, why):
        self.close()
        raise Lost(why)

    def cause(self, status=None):
        """' by signal 11', or the like."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            status = self.process.wait(1) if status is None else status
        if self.guard.excess:
            return f": {self.guard.excess}"
        if status is None:
            return ""
        return f" by signal {-status}" if status < 0 else f" with exit status {status}"

    def close(self):
        """End all of its processes, and remove its folder. A second call does nothing."""
        if self.process.returncode is not None and not os.path.exists(self.folder):
            return
        self.guard.close()
        self.socket.close()
        self.control.close()
        with contextlib.suppress(ProcessLookupError, PermissionError):
            for pid in family(self.process.pid):
                os.kill(pid, signal.SIGKILL)
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.kill()
        self.process.wait()
        WORKERS.discard(self.process.pid)
        end_orphans()
        shutil.rmtree(self.folder, ignore_errors=True)


def started(command, folder, its_socket, its_control):
    """The process of a worker."""
    process = subprocess.Popen(command, stdin=its_socket, stdout=its_control,
                               stderr=subprocess.PIPE, cwd=folder, env=environment(),
                               start_new_session=True)
    WORKERS.add(process.pid)
    return process


class Look(NamedTuple):
    """What a worker's processes used at a time."""

    time: float = -math.inf
    use: Use = Use()


class Guard(threading.Thread):
    """Looks at a worker every PATIENCE seconds, whatever else is done. Ends what takes too much."""

    def __init__(self, pid, memory, counts_files):
        super().__init__(daemon=True)
        self.pid, self.memory, self.counts_files = pid, memory, counts_files
        self.look = Look()
        self.excess = None  # a sentence, when it took too much
        self.over = threading.Event()

    def run(self):
        rest = PATIENCE
        while not self.excess and not self.over.wait(rest):
            began = time.monotonic()
            pids = family(self.pid)
            self.look = Look(began, use_of(pids))
            if self.look.use.memory > self.memory:
                self.end(pids, f"it took more than {self.memory >> 20} MB of memory")
            elif self.counts_files and files_of(pids) > MOST_FILES:
                self.end(pids, f"it made more than {MOST_FILES} files")
            rest = max(PATIENCE, 10 * (time.monotonic() - began))  # a tenth of a processor at most

    def end(self, pids, why):
        self.excess = why
        for pid in pids:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.kill(pid, signal.SIGKILL)

    def close(self):
        """Its process may not be waited for before: another one could get the number."""
        self.over.set()
        if self.is_alive():
            self.join()


class Meter:
    """The time that a worker takes: its processors' seconds, and those for which it sleeps.

    So a machine that is busy with other things costs no student a point. What seems to be busy and
    is not, as work that no process is seen to do, counts as a CLOCK-th of its time on the clock.
    """

    def __init__(self):
        self.began = self.seen = time.monotonic()
        self.spent = 0.0
        self.use = None

    def clock(self):
        return time.monotonic() - self.began

    def total(self):
        return max(self.spent + time.monotonic() - self.seen, self.clock() / CLOCK)

    def add(self, look):
        """look: the last one at what the worker uses."""
        if look.time <= self.seen:
            return
        since = look.time - self.seen
        worked = look.use.seconds - self.use.seconds if self.use else 0.0
        self.spent += max(worked, since if look.use.asleep or self.use is None else 0.0)
        self.seen, self.use = look


def files_of(pids):
    """How many files are in the folder of a sandbox. 0 where that cannot be seen."""
    try:
        there = os.statvfs(f"/proc/{pids[1]}/root/tmp")  # its first process: others come and go
    except (OSError, AttributeError, IndexError):
        return 0
    return there.f_files - there.f_ffree


# --- what this machine can do -------------------------------------------------------------------


def available() -> tuple[str, str]:
    """-> (the strictest level that was seen to work, a sentence on it)."""
    if sys.platform != "linux":
        return "process", "strict needs Linux"
    if not shutil.which("bwrap"):
        return "process", "strict needs bubblewrap: install it (sudo apt install bubblewrap)"
    if not seccomp.is_there():
        return "process", "strict needs libseccomp: install it (sudo apt install libseccomp2)"
    try:
        ways, has = open_ways("strict")
    except Lost as lost:
        return "process", f"bubblewrap does not work here: {lost}"
    if ways:
        return "process", f"bubblewrap leaves open: {', '.join(ways)}"
    return "strict", ", ".join(["bubblewrap", *has])


def open_ways(level):
    """Try from inside what a worker at this level must not be able to do -> what it could."""
    with socket.create_server(("127.0.0.1", 0)) as server, tempfile.NamedTemporaryFile() as file, \
            contextlib.closing(Worker(level)) as worker:
        worker.exchange(("open", (("probe", PROBE.read_text("utf-8"), ()),), ()), 10)
        given = (server.getsockname()[1], str(places.ROOT), file.name, seccomp.number("keyctl"))
        _, ways, *_ = worker.exchange(("call", "probe", "open_ways", given, {}), 10)
        return ways, worker.has
