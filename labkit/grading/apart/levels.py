"""How a worker is started at each level: the command, and the settings that it gets.

    strict    Linux with bubblewrap: no network, no files but the interpreter's, NumPy's and an
              empty folder, no other process in sight, another user
    process   on macOS, too: a process of its own with a clean environment

Both are limited by what the system has besides: seccomp and Landlock on Linux, and its limits.
"""
import functools
import os
import secrets
import shutil
import sys
from pathlib import Path

import numpy as np
import scipy

from ... import places
from ...imports import GIVEN_PACKAGES
from ...table import GIVEN
from . import seccomp

LEVELS = ("strict", "process")
WORKER = Path(__file__).with_name("worker.py")
NEIGHBOURS = "worker.py", "confine.py", "finders.py", "wire.py"
PACKAGES = Path(np.__file__).parent.parent
STANDARD = Path(os.__file__).parent.resolve()  # Python's own modules
SYSTEM = ("/lib", "/lib64", "/usr/lib", "/usr/lib64", "/usr/local/lib", "/etc/ld.so.cache",
          "/etc/alternatives")  # Debian links libblas through it
OTHER_USERS = 2_000_000_000  # from here on, numbers that belong to nobody


def environment() -> dict:
    """A worker gets none of our variables."""
    return {"LANG": "C.UTF-8", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
            "MKL_NUM_THREADS": "1"}


def interpreter():
    """The Python that a virtual environment was made from."""
    return os.path.realpath(sys.executable)


@functools.cache
def given() -> dict:
    """{module: its text} for the worker: what labs may import, and what of labkit they stand on."""
    return dict.fromkeys((*GIVEN_PACKAGES, "labkit"), "") | {
        name: places.ROOT.joinpath(*name.split(".")).with_suffix(".py").read_text("utf-8")
        for name in (*GIVEN, "labkit.contract")}


def python(worker, packages):
    return [interpreter(), "-I", "-S", "-B", str(worker), str(packages)]


def settings(limits, **more) -> dict:
    """What a worker does to itself before it loads what was handed in: see confine.give_up."""
    program, keyctl = "", None
    if sys.platform == "linux" and seccomp.is_there():
        program, keyctl = seccomp.program().hex(), seccomp.number("keyctl")
    return {"memory": limits.memory, "program": program, "keyctl": keyctl, **more}


def plain(folder, limits) -> tuple[list, dict]:
    """The command and the settings of a worker at the level `process`."""
    code = [interpreter(), *library(), *packages().values(), WORKER.parent]
    uid = other_user()
    return python(WORKER, PACKAGES), settings(
        limits, processes=limits.processes if uid else None, uid=uid,
        doors=[str(STANDARD), str(PACKAGES)] if uid else [],
        readable=[*map(str, code), *SYSTEM, "/dev/urandom"], writable=[folder, os.devnull])


def strict(folder, limits) -> tuple[list, dict]:
    """The command and the settings of a worker at the level `strict`."""
    user = other_user()
    shut_in = (["--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts",
                "--cap-drop", "ALL", "--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"]
               if user else ["--unshare-user", "--unshare-all", "--disable-userns",
                             "--uid", "65534", "--gid", "65534"])
    there = {path: path for path in (*SYSTEM, interpreter(), *map(str, library()))
             if os.path.exists(path)}
    there |= {f"/packages/{name}": path for name, path in packages().items()}
    there |= {f"/worker/{name}": WORKER.with_name(name) for name in NEIGHBOURS}
    seen = [option for place, path in there.items() for option in mounted(place, str(path))]
    hidden = [option for path in not_for_workers(there)
              for option in ("--ro-bind", folder, str(path))]  # it is empty
    empty = ["--proc", "/proc", "--dev", "/dev", "--remount-ro", "/dev", "--size", str(1 << 24),
             "--perms", "1777", "--tmpfs", "/tmp", "--remount-ro", "/", "--chdir", "/tmp"]
    bwrap = shutil.which("bwrap") or "bwrap"
    return [bwrap, *shut_in, "--die-with-parent", "--as-pid-1", *seen, *hidden, *empty,
            *python("/worker/worker.py", "/packages")], settings(
        limits, processes=limits.processes, uid=user, doors=[], readable=["/"],
        writable=["/tmp", "/dev/null"])


def mounted(place, path):
    """The options that show a path, read-only, at a place. All may enter the folders above it."""
    for folder in reversed(Path(place).parents[:-1]):
        yield from ("--perms", "0755", "--dir", str(folder))
    link = os.path.islink(path) and place == path
    yield from ("--symlink", os.readlink(path), place) if link else ("--ro-bind", path, place)


def not_for_workers(there):
    """The folders in what is there that a worker must not see: the course, and others' packages."""
    packages = [path for place in there if not os.path.islink(place)
                for path in Path(place).glob("python*/*-packages")]
    return [path for path in (places.ROOT, *packages) if any(map(path.is_relative_to, there))]


def other_user():
    """A number that no user has, if this is root on Linux. Each worker has another one.

    The system counts processes by user. With a common number, workers would share one count.
    """
    if sys.platform != "linux" or os.getuid() != 0:
        return None
    return OTHER_USERS + secrets.randbelow(100_000_000)


def library():
    """The folders of Python's own modules and libraries, as they are called and where they are."""
    prefix = Path(sys.base_prefix)
    if prefix in map(Path, ("/", "/usr", "/usr/local")):
        return [STANDARD]  # what else it needs is in SYSTEM
    named = {prefix / name for name in ("lib", sys.platlibdir)}
    return sorted(path for path in named | {*map(Path.resolve, named)} if path.exists())


def packages():
    """{name: folder} of NumPy, SciPy and the libraries that their wheels bring."""
    folders = [Path(np.__file__).parent, Path(scipy.__file__).parent]
    folders += [folder.with_name(f"{folder.name}.libs") for folder in folders]
    return {folder.name: folder for folder in folders if folder.exists()}
