"""What a worker must not be able to do: tried from inside, before the level `strict` is claimed.

It runs in a worker, as a submission would. See sandbox.available.
"""
import ctypes
import fcntl
import mmap
import os
import socket

CALLS = {  # of the C library
    "System V shared memory": ("shmget", 0, 4096, 0o1600),
    "System V queues": ("msgget", 0, 0o1600),
    "System V semaphores": ("semget", 0, 1, 0o1600),
    "POSIX queues": ("mq_open", b"/written", 0o102, 0o600, None),
    "files in memory": ("memfd_create", b"written", 0),
    "namespaces": ("unshare", 0x10000000),  # CLONE_NEWUSER
    "tracing": ("ptrace", 0, 0, None, None)}


def open_ways(port, course, file, keyctl):
    """The ways out that are open. port: one that listens, file: one that is there, outside."""
    tried = {way: lambda call=call: called(*call) for way, call in CALLS.items()} | {
        "the network": lambda: socket.create_connection(("127.0.0.1", port), 1),
        "sockets to the host": lambda: socket.socket(40, socket.SOCK_STREAM),  # AF_VSOCK
        "local sockets": lambda: socket.socket(socket.AF_UNIX),
        "the kernel's sockets": lambda: socket.socket(16, socket.SOCK_RAW),  # AF_NETLINK
        "the course's files": lambda: os.stat(course),
        "files outside": lambda: os.stat(file),
        "the first process's memory": lambda: open("/proc/1/mem", "rb"),
        "the first process's files": lambda: os.listdir("/proc/1/fd"),
        "keyrings": lambda: called("syscall", keyctl, 0, -3, 0),  # KEYCTL_GET_KEYRING_ID, session
        "POSIX shared memory": lambda: open("/dev/shm/written", "w"),
        "memory that is shared": lambda: mmap.mmap(-1, 4096, flags=mmap.MAP_SHARED),
        "other programs": lambda: os.posix_spawn("/proc/self/exe", ["python"], {}),
        "locks on files": lambda: os.lockf(os.open(os.__file__, os.O_RDONLY), os.F_TEST, 1),
        "shared locks on files": lambda: fcntl.flock(os.open(os.__file__, 0), fcntl.LOCK_SH)}
    for folder in ("/", "/packages/numpy", os.path.dirname(os.__file__)):
        tried[f"writing to {folder}"] = lambda folder=folder: open(f"{folder}/written", "w")
    ways = [way for way, attempt in tried.items() if succeeds(attempt)]
    others = sum(name.isdigit() for name in os.listdir("/proc")) > 2
    return (*ways, *["other processes"] * others, *["the superuser"] * (os.getuid() == 0))


def succeeds(attempt):
    try:
        attempt()
    except OSError:
        return False
    return True


def called(name, *arguments):
    """A function of the C library. OSError: it failed."""
    if getattr(ctypes.CDLL(None, use_errno=True), name)(*arguments) == -1:
        raise OSError(ctypes.get_errno(), name)
