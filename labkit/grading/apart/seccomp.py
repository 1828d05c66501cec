"""The system calls that a worker may make. The kernel refuses all others (Linux).

libseccomp makes the filter here. A worker puts it in force before it loads what was handed in.
"""
import ctypes
import functools
import signal
import tempfile

LIBRARY = "libseccomp.so.2"
# What Python, NumPy and SciPy need with their files, threads and children. Not here: sockets, keys,
# shared memory, message queues, memory files, namespaces, other programs, tracing, locks on files
# (two workers would see each other's), and whatever is newer than this list.
ALLOWED = """
    access brk chdir chmod clock_getres clock_gettime clock_nanosleep close close_range creat dup
    dup2 dup3 exit exit_group faccessat faccessat2 fallocate fchdir fchmod fchmodat fdatasync fork
    fstat fstatfs fsync ftruncate futex getcpu getcwd getdents getdents64 getegid geteuid getgid
    getgroups getitimer getpgid getpgrp getpid getppid getpriority getrandom getresgid getresuid
    getrlimit getrusage getsid gettid gettimeofday getuid kill link linkat lseek lstat madvise mkdir
    mkdirat mprotect mremap munmap nanosleep newfstatat open openat pause pipe pipe2 poll ppoll
    pread64 preadv pselect6 pwrite64 pwritev read readlink readlinkat readv rename
    renameat renameat2 restart_syscall rmdir rseq rt_sigaction rt_sigpending rt_sigprocmask
    rt_sigreturn rt_sigsuspend rt_sigtimedwait sched_getaffinity sched_yield select set_robust_list
    set_tid_address setitimer setpgid setrlimit setsid sigaltstack stat statfs statx symlink
    symlinkat sysinfo tgkill time times truncate umask uname unlink unlinkat utimensat vfork wait4
    waitid write writev""".split()
NOT_BELOW = 0x7E028080            # clone's flags for new namespaces, and for a child as a sibling
SHARED = 0x01                     # mmap's flag for memory that stays when no process maps it
DESCRIPTORS = 0, 1, 2, 3, 4, 1030  # fcntl's commands for copies and flags, and not for locks
TERMINALS = 0x5401, 0x5421, 0x5450, 0x5451  # ioctl's: is it one; wait or not; close at exec or not
NAME, WITH_PARENT = 15, 1         # prctl's: a thread's name; the signal when the parent ends
ALLOW, REFUSE = 0x7FFF0000, 0x00050000 + 38  # with ENOSYS, as an older kernel would
EQUAL, MASKED = 4, 7


class Comparison(ctypes.Structure):
    """libseccomp's scmp_arg_cmp. EQUAL: argument == first. MASKED: argument & first == second."""

    _fields_ = [("argument", ctypes.c_uint), ("operator", ctypes.c_int),
                ("first", ctypes.c_uint64), ("second", ctypes.c_uint64)]


def rules():
    """Yield (system call, what its arguments must be). Several rules of one call add up."""
    for name in ALLOWED:
        yield name, ()
    yield "clone", (Comparison(0, MASKED, NOT_BELOW, 0),)
    yield "mmap", (Comparison(3, MASKED, SHARED, 0),)
    yield "prctl", (Comparison(0, EQUAL, NAME, 0),)
    yield "prctl", (Comparison(0, EQUAL, WITH_PARENT, 0), Comparison(1, EQUAL, signal.SIGKILL, 0))
    yield "prlimit64", (Comparison(0, EQUAL, 0, 0),)  # its own
    for name, commands in (("fcntl", DESCRIPTORS), ("ioctl", TERMINALS)):
        for command in commands:
            yield name, (Comparison(1, EQUAL, command, 0),)


@functools.cache
def is_there():
    try:
        return bool(program())
    except OSError:
        return False


@functools.cache
def program():
    """The filter as the kernel takes it, 8 bytes an instruction. OSError: no libseccomp."""
    library = ctypes.CDLL(LIBRARY)
    library.seccomp_init.restype = ctypes.c_void_p
    context = ctypes.c_void_p(library.seccomp_init(REFUSE))
    for name, arguments in rules():
        if (number := library.seccomp_syscall_resolve_name(name.encode())) >= 0:
            library.seccomp_rule_add_array(context, ALLOW, number, len(arguments),
                                           (Comparison * len(arguments))(*arguments))
    with tempfile.TemporaryFile() as file:
        library.seccomp_export_bpf(context, file.fileno())
        library.seccomp_release(context)
        file.seek(0)
        return file.read()


def number(name):
    """A system call's number on this machine. OSError: there is no libseccomp."""
    return ctypes.CDLL(LIBRARY).seccomp_syscall_resolve_name(name.encode())
