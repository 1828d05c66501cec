"""What a worker gives up before it loads what was handed in, and how it ends with the grader.

It needs Python's own library alone, and is seen in the sandbox beside worker.py.
"""
import contextlib
import ctypes
import os
import signal
import sys


def give_up(settings):
    """Give up what the worker does not need -> what the system has for it: names.

    settings: of levels.settings.
    """
    has = []
    with contextlib.suppress(OSError), open("/proc/self/oom_score_adj", "w") as file:
        file.write("1000")  # where memory runs out, it ends before anybody else
    libc = ctypes.CDLL(None, use_errno=True) if sys.platform == "linux" else None
    if libc:
        has += give_up_files(libc, settings)
    limit_itself(settings["memory"], settings["processes"])
    if settings["program"] and filter_calls(libc, bytes.fromhex(settings["program"])):
        has.append("seccomp")
    return tuple(has)


def give_up_files(libc, settings):
    """Give up keys, files, other users' rights -> ["Landlock 4"], or [] where there is none."""
    if settings["keyctl"] is not None:
        libc.syscall(settings["keyctl"], 1, None)  # KEYCTL_JOIN_SESSION_KEYRING: one of its own
    hold_open(settings["doors"])
    rules, version = rules_for_files(libc, settings["readable"], settings["writable"])
    if (uid := settings["uid"]) is not None:
        os.setgroups([])
        os.setgid(uid)
        os.setuid(uid)
    end_with_the_parent()
    libc.prctl(4, 0, 0, 0, 0)  # PR_SET_DUMPABLE: no exercise reads the first process's memory
    libc.prctl(38, 1, 0, 0, 0)  # PR_SET_NO_NEW_PRIVS
    if version and libc.syscall(ENFORCE, rules, 0) == 0:
        os.close(rules)
        return [f"Landlock {version}"]
    return []


def limit_itself(memory, processes):
    """The system's limits for this process and those that it starts. processes None: no limit."""
    with contextlib.suppress(ImportError):
        import resource
        limits = {"RLIMIT_AS": memory, "RLIMIT_NPROC": processes, "RLIMIT_FSIZE": 1 << 24,
                  "RLIMIT_CORE": 0, "RLIMIT_NOFILE": 64}
        for name, most in limits.items():
            with contextlib.suppress(AttributeError, ValueError, OSError):
                if most is not None:
                    resource.setrlimit(getattr(resource, name), (most, most))


def end_with_the_parent():
    """Have the kernel end this process, and none that it forks, when its parent ends (Linux)."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(1, signal.SIGKILL, 0, 0, 0)  # PR_SET_PDEATHSIG


def hold_open(folders):
    """Find modules through open folders: another user may not enter those above them."""
    for folder in folders:
        through = f"/proc/self/fd/{os.open(folder, os.O_PATH)}"
        paths = [sys.path, *(module.__path__ for module in list(sys.modules.values())
                             if isinstance(getattr(module, "__path__", None), list))]
        for path in paths:
            path[:] = [part.replace(folder, through, 1) if part.startswith(folder) else part
                       for part in path]
        for finder in sys.meta_path:
            if getattr(finder, "folder", None) == folder:
                finder.folder = through


def filter_calls(libc, program):
    """Have the kernel refuse the system calls that a program does not allow -> does it?"""
    class Program(ctypes.Structure):  # the kernel's struct sock_fprog
        _fields_ = [("length", ctypes.c_ushort), ("code", ctypes.c_char_p)]

    whole = Program(len(program) // 8, program)
    return libc.prctl(22, 2, ctypes.byref(whole), 0, 0) == 0  # PR_SET_SECCOMP, a filter


CREATE, ADD, ENFORCE = 444, 445, 446  # Landlock's system calls


def rules_for_files(libc, readable, writable):
    """Landlock: nothing but these paths, no TCP, no signals to others -> (rules, its version).

    The version is 0 where there is none.
    """
    version = libc.syscall(CREATE, None, ctypes.c_size_t(0), 1)
    if version < 1:
        return None, 0
    every = (1 << {1: 13, 2: 14, 3: 15, 4: 15}.get(version, 16)) - 1
    execute_read_list = 0b1101
    of_files = 0b111 | every & ~((1 << 14) - 1)  # execute, write, read; truncate, ioctl
    size = 8 if version < 4 else 16 if version < 6 else 24
    rules = libc.syscall(CREATE, (ctypes.c_uint64 * 3)(every, 0b11, 0b11), ctypes.c_size_t(size), 0)
    for path, access in [*((path, execute_read_list) for path in readable),
                         *((path, every) for path in writable)]:
        if not os.path.exists(path):
            continue
        there = os.open(path, os.O_PATH | os.O_CLOEXEC)
        access &= every if os.path.isdir(path) else of_files
        rule = access.to_bytes(8, sys.byteorder) + there.to_bytes(4, sys.byteorder)
        libc.syscall(ADD, rules, 1, rule, 0)
        os.close(there)
    return rules, version
