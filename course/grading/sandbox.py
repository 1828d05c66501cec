"""Workers from outside: what shuts them in, how long they may take, how they end.

    strict    Linux with bubblewrap: no network, no files but the interpreter's, NumPy's and an
              empty folder, no other process in sight, another user, Landlock where there is one
    process   anywhere: a process of its own with a clean environment and the limits that the system
              has. No protection against malice
"""
import contextlib
import ctypes
import functools
import os
import secrets
import select
import shutil
import signal
import socket
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy

from ..exercises import GIVEN
from ..given import places
from . import wire

LEVELS = ("strict", "process")
WORKER = Path(__file__).with_name("worker.py")
PACKAGES = Path(np.__file__).parent.parent
PATIENCE = 0.2         # seconds between two looks at a worker's memory
SYSTEM = ("/lib", "/lib64", "/usr/lib", "/usr/lib64", "/usr/local/lib", "/etc/ld.so.cache")
OTHER_USERS = 2_000_000_000  # from here on, numbers that belong to nobody


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

    def __init__(self, level, limits=Limits()):  # noqa: B008, a NamedTuple does not change
        self.limits = limits
        self.folder = tempfile.mkdtemp(prefix="worker-")
        os.chmod(self.folder, 0o1777)
        command, settings = (strict if level == "strict" else plain)(self.folder, limits)
        self.socket, theirs = socket.socketpair()
        self.control, its_control = socket.socketpair()
        self.buffer = bytearray()
        with theirs, its_control:
            self.process = subprocess.Popen(
                command, stdin=theirs if os.name != "nt" else subprocess.PIPE,
                stdout=its_control if os.name != "nt" else subprocess.DEVNULL,
                stderr=subprocess.PIPE, cwd=self.folder, env=environment(), start_new_session=True)
            WORKERS.add(self.process.pid)
            if os.name == "nt":
                self.process.stdin.write(theirs.share(self.process.pid))
                self.process.stdin.close()
        try:
            _, self.landlock, self.user = self.exchange(("start", settings, given()), 30)
        except Lost as lost:
            said = self.process.stderr.read1(2000).decode("utf-8", "replace").strip()
            raise Lost(said.splitlines()[-1] if said else str(lost)) from None

    def exchange(self, message, seconds):
        """Send a message -> the one that comes back, in at most these seconds."""
        return self.decoded(self.relay(seconds, wire.encode(message)))

    def decoded(self, payload):
        try:
            message = wire.decode(payload)
        except wire.Garbled as error:
            self.lose(f"what it sent cannot be read: {error}")
        if not (isinstance(message, tuple) and message and isinstance(message[0], str)):
            self.lose("what it sent is no message")
        return message

    def relay(self, seconds, *payloads):
        """Send payloads -> the one that comes back, as it came."""
        end = time.monotonic() + seconds
        if self.buffer:
            self.lose("it sent more than it was asked for")
        try:
            self.socket.settimeout(seconds)
            self.socket.sendall(b"".join(map(wire.framed, payloads)))
            while not (length := wire.complete(self.buffer)):
                self.buffer += self.received(end, seconds)
        except TimeoutError:
            self.lose(f"no answer within {seconds:.3g} s; it was stopped")
        except OSError:
            self.lose(f"the process ended{self.cause()}")
        except wire.Garbled as error:
            self.lose(f"what it sent cannot be read: {error}")
        answer = bytes(self.buffer[8:length])
        del self.buffer[:length]
        return answer

    def received(self, end, seconds):
        """Some bytes. The memory is watched every PATIENCE seconds. OSError: no more will come."""
        while (left := end - time.monotonic()) > 0:
            ready, _, _ = select.select([self.socket, self.control], [], [], min(PATIENCE, left))
            if self.socket in ready:
                if part := self.socket.recv(1 << 18):
                    return part
                raise ConnectionError
            if ready:
                self.lose(f"the process ended{ended_by(self.status())}")
            if memory_of(family(self.process.pid)) > self.limits.memory:
                self.lose(f"it took more than {self.limits.memory >> 20} MB of memory")
        raise TimeoutError

    def finish(self, seconds=3):
        """End the exercise: its process must go, and must have said no more than it was asked."""
        try:
            self.socket.sendall(wire.framed(wire.encode(("close",))))
            self.control.settimeout(seconds)
            if (status := self.status()) != 0:
                self.lose(f"the process ended{ended_by(status)}")
        except OSError:
            self.lose("the process did not end when it should")
        if self.buffer or select.select([self.socket], [], [], 0)[0]:
            self.lose("it sent more than it was asked for")

    def status(self):
        """How the exercise's process has ended, as the worker's first process tells."""
        with contextlib.suppress(ValueError):
            return int(self.control.recv(64))
        return -signal.SIGKILL

    def lose(self, why):
        self.close()
        raise Lost(why)

    def cause(self):
        """' by signal 11', or the like."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            return ended_by(self.process.wait(1))
        return ""

    def close(self):
        """End all of its processes, and remove its folder. A second call does nothing."""
        if self.process.returncode is not None and not os.path.exists(self.folder):
            return
        self.socket.close()
        self.control.close()
        with contextlib.suppress(ProcessLookupError, PermissionError):
            for pid in family(self.process.pid):
                os.kill(pid, signal.SIGKILL if os.name != "nt" else signal.SIGTERM)
            if hasattr(os, "killpg"):
                os.killpg(self.process.pid, signal.SIGKILL)
        self.process.kill()
        self.process.wait()
        WORKERS.discard(self.process.pid)
        end_orphans()
        shutil.rmtree(self.folder, ignore_errors=True)


def ended_by(status):
    return f" by signal {-status}" if status < 0 else f" with exit status {status}"


def environment():
    """A worker gets none of our variables. Windows starts no Python without its own folder."""
    kept = {name: os.environ[name] for name in ("SYSTEMROOT",) if name in os.environ}
    return {**kept, "LANG": "C.UTF-8", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
            "MKL_NUM_THREADS": "1"}


# --- levels -----------------------------------------------------------------------------------


def interpreter():
    """The Python that a virtual environment was made from."""
    return os.path.realpath(sys.executable) if os.name != "nt" else sys.executable


@functools.cache
def given():
    """{module of the course that labs may import: its text}."""
    folder = places.ROOT / "course" / "given"
    return {"course": "", "course.given": ""} | {
        f"course.given.{name}": (folder / f"{name}.py").read_text("utf-8") for name in GIVEN}


def python(worker, packages):
    return [interpreter(), "-I", "-S", "-B", str(worker), str(packages)]


def plain(folder, limits):
    """The command and the settings of a worker at the level `process`."""
    code = [interpreter(), *library(), *packages().values(), WORKER.parent]
    uid = other_user() if all(map(open_to_all, map(Path, code))) else None
    return python(WORKER, PACKAGES), {
        "memory": limits.memory, "processes": limits.processes if uid else None, "uid": uid,
        "readable": [*map(str, code), *SYSTEM, "/dev/urandom"], "writable": [folder, os.devnull]}


def strict(folder, limits):
    """The command and the settings of a worker at the level `strict`."""
    user = other_user()
    shut_in = (["--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts",
                "--cap-drop", "ALL", "--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"]
               if user else
               ["--unshare-all", "--unshare-user", "--disable-userns", "--uid", "65534",
                "--gid", "65534"])
    there = {path: path for path in (*SYSTEM, interpreter(), *map(str, library()))
             if os.path.exists(path)}
    there |= {f"/packages/{name}": path for name, path in packages().items()}
    there |= {f"/worker/{name}": WORKER.with_name(name) for name in ("worker.py", "wire.py")}
    seen = [option for place, path in there.items() for option in shown(place, str(path))]
    hidden = ["--tmpfs", str(places.ROOT)] * any(places.ROOT.is_relative_to(path)
                                                 for path in there.values())
    empty = ["--proc", "/proc", "--dev", "/dev", "--remount-ro", "/dev",
             "--size", str(1 << 24), "--perms", "1777", "--tmpfs", "/tmp", "--chdir", "/tmp"]
    return ["bwrap", *shut_in, "--die-with-parent", "--as-pid-1", *seen, *hidden, *empty,
            *python("/worker/worker.py", "/packages")], {
        "memory": limits.memory, "processes": limits.processes, "uid": user,
        "readable": ["/"], "writable": ["/tmp", "/dev/null"]}


def shown(place, path):
    """The options that show a path, read-only, at a place. All may enter the folders above it."""
    for folder in reversed(Path(place).parents[:-1]):
        yield from ("--perms", "0755", "--dir", str(folder))
    link = os.path.islink(path) and place == path
    yield from ("--symlink", os.readlink(path), place) if link else ("--ro-bind", path, place)


def other_user():
    """A number that no user has, if this is root. Each worker has another one.

    The system counts processes by user. With a common number, workers would share one count.
    """
    if getattr(os, "getuid", lambda: None)() != 0:
        return None
    return OTHER_USERS + secrets.randbelow(100_000_000)


def library():
    """The folders with Python's own modules: the whole installation, unless that is the system."""
    own = {Path(sys.base_prefix), Path(sys.base_exec_prefix)}
    if own & {Path("/usr"), Path("/usr/local"), Path("/")}:
        own = {Path(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib")}
    return sorted(own)


def packages():
    """{name: folder} of NumPy, SciPy and the libraries that their wheels bring."""
    folders = [Path(np.__file__).parent, Path(scipy.__file__).parent]
    folders += [folder.with_name(f"{folder.name}.libs") for folder in folders]
    return {folder.name: folder for folder in folders if folder.exists()}


def open_to_all(path):
    """Whether any user may read it."""
    return path.stat().st_mode & 0o5 and all(parent.stat().st_mode & 0o1
                                             for parent in path.parents)


# --- all processes of a worker ------------------------------------------------------------------

WORKERS = set()   # their process numbers
ADOPTING = []     # not empty where orphans come to this process


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


def memory_of(pids):
    """Bytes in use by these processes, as far as this can be seen."""
    total = 0
    for pid in pids:
        with contextlib.suppress(OSError):
            pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
            total += pages * os.sysconf("SC_PAGESIZE")
    return total


# --- what this machine can do -------------------------------------------------------------------

PROBE = """
import os
import socket


def open_ways(port, course, file):
    ways = []
    try:
        socket.create_connection(("127.0.0.1", port), 1).close()
        ways.append("the network")
    except OSError:
        pass
    if os.path.exists(course) or os.path.exists(file):
        ways.append("the course's files")
    for folder in ("/", "/packages/numpy", os.path.dirname(os.__file__)):
        try:
            open(os.path.join(folder, "written"), "w").close()
            ways.append(f"writing to {folder}")
        except OSError:
            pass
    if sum(name.isdigit() for name in os.listdir("/proc")) > 2:
        ways.append("other processes")
    if os.getuid() == 0:
        ways.append("the superuser")
    return tuple(ways)
"""


def available():
    """-> (the strictest level that was seen to work, a sentence on it)."""
    if sys.platform != "linux":
        return "process", "strict needs Linux"
    if not shutil.which("bwrap"):
        return "process", "strict needs bubblewrap: install it (sudo apt install bubblewrap)"
    try:
        ways, landlock = open_ways("strict")
    except Lost as lost:
        return "process", f"bubblewrap does not work here: {lost}"
    if ways:
        return "process", f"bubblewrap leaves open: {', '.join(ways)}"
    return "strict", f"bubblewrap, {f'Landlock {landlock}' if landlock else 'no Landlock'}"


def open_ways(level):
    """Try from inside what a worker at this level must not be able to do -> what it could."""
    with socket.create_server(("127.0.0.1", 0)) as server, tempfile.NamedTemporaryFile() as file, \
            contextlib.closing(Worker(level)) as worker:
        worker.exchange(("open", (("probe", PROBE, ()),), ()), 10)
        given = server.getsockname()[1], str(places.ROOT), file.name
        _, ways, *_ = worker.exchange(("call", "probe", "open_ways", given, {}), 10)
        return ways, worker.landlock
