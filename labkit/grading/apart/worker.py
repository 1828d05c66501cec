"""The process in the sandbox: runs what a student handed in, one exercise at a time.

It is started as a script, needs NumPy and SciPy alone, and is sent all that it knows: modules'
texts, names of functions, arrays. What it answers is not trusted, so nothing here protects a mark.
This file protects honest exercises from what else is in their file.

    start      -> ready       with what of the course labs may import. Limits are in force
    open       -> opened      the module is loaded for one exercise. Or missing, or raised
    call       -> returned    its value, the inputs that it changed, what it printed. Or raised
    returned   <- ask         in between: a stand-in of an exercise asks what the reference returns
    close                     the exercise's process ends, and whatever it has left

The first process tells on a second socket how an exercise's process ended: no exercise can.

Every exercise has a process of its own, forked when NumPy is there already: what one exercise
breaks, the next one does not see.
"""
import builtins
import contextlib
import functools
import importlib
import io
import linecache
import os
import shutil
import signal
import sys
import threading
import traceback
import types
import warnings

sys.path.insert(0, os.path.dirname(__file__))  # until they are there: see main
import confine
from finders import Drawing, Given, Packages

PACKAGE = "labs"
MOST_PRINTED = 4000    # characters of an exercise's output that are kept
MOST_FRAMES = 40       # of a traceback


class Printed(io.TextIOBase):
    """Keeps the first MOST_PRINTED characters that are written to it."""

    def __init__(self):
        self.text = ""

    def writable(self):
        return True

    def write(self, text):
        self.text += text[:MOST_PRINTED - len(self.text)]
        return len(text)

    def taken(self):
        text, self.text = self.text, ""
        return text


class Channel:
    """To the grader and back. Values go in the standard form of labkit/contract.py.

    named: the table of the NamedTuples that loaded modules define. What is received has these.
    """

    def __init__(self, wire, stream):
        self.wire = wire
        self.stream = stream
        self.contract = None
        self.named = {}

    def send(self, *message):
        self.write(self.wire.encode(message))

    def receive(self):
        return self.wire.decode(self.read(), self.named)

    def write(self, payload):
        self.stream.write(self.wire.framed(payload))
        self.stream.flush()

    def read(self):
        return self.exactly(int.from_bytes(self.exactly(8), "big"))

    def exactly(self, count):
        content = self.stream.read(count)
        if len(content) < count:
            raise EOFError
        return content


def main():
    stream, control = opened_stream(), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1, 2):
        os.dup2(nowhere, standard)
    sys.meta_path.append(Packages(sys.argv[1]))
    import wire
    sys.path.pop(0)
    channel = Channel(wire, stream)
    with contextlib.suppress(EOFError):
        _, settings, given = channel.receive()
        sys.meta_path += Given(given), Drawing()
        channel.contract = importlib.import_module("labkit.contract")
        channel.send("ready", confine.give_up(settings))
        while True:
            _, modules, preloaded = channel.receive()
            codes = [(topic, compiled(topic, text), stand_ins)
                     for topic, text, stand_ins in modules]
            for name in preloaded:  # the reference imports it: once for all exercises, before fork
                importlib.import_module(name)
            serve_apart(channel, control, codes)


def opened_stream():
    """The grader's socket, which is standard input."""
    return io.BufferedRWPair(*(open(os.dup(0), mode, 0) for mode in ("rb", "wb")))


@functools.cache
def compiled(topic, text):
    """The code of a module's text, or the error that it has."""
    linecache.cache[file_name(topic)] = len(text), None, text.splitlines(True), file_name(topic)
    try:
        return compile(text, file_name(topic), "exec")
    except (Exception, RecursionError) as error:
        return error


def file_name(topic):
    return f"{PACKAGE}/{topic}.py"


def serve_apart(channel, control, codes):
    """Serve one exercise in a process of its own, and end all that it leaves behind."""
    parent = os.getpid()
    child = os.fork()
    if child == 0:
        os.close(control)
        confine.end_with_the_parent()
        if os.getppid() != parent:  # it has ended already
            os._exit(1)
        serve(channel, codes)
        os._exit(0)
    _, status = os.waitpid(child, 0)
    if os.getpid() == 1:  # of a namespace of its own: here this means every process in the sandbox
        with contextlib.suppress(ProcessLookupError):
            os.kill(-1, signal.SIGKILL)
        with contextlib.suppress(ChildProcessError):
            while True:
                os.waitpid(-1, 0)
    is_empty = emptied()
    os.write(control, b"%d" % os.waitstatus_to_exitcode(status) if is_empty else b"files")


def emptied():
    """Remove what the exercise has left in the folder of the worker -> whether all of it went.

    The folder's own mode and times would tell the next exercise something.
    """
    with contextlib.suppress(OSError):  # it may be another user's: then nobody has changed it
        os.chmod(".", 0o1777)
    with contextlib.suppress(OSError, RecursionError):
        for name in os.listdir():
            if os.path.isdir(name) and not os.path.islink(name):
                shutil.rmtree(name)
            else:
                os.unlink(name)
        os.utime(".", (0, 0))
    return not os.listdir()


def serve(channel, codes):
    """Load the modules, then answer calls to their functions until the grader closes."""
    sys.stdout = sys.stderr = printed = Printed()
    warnings.simplefilter("ignore")
    try:
        modules = load(channel, codes)
    except BaseException as error:
        channel.send("raised", *error_parts(error), printed.taken())
    else:
        channel.send("opened", printed.taken())
    while True:
        kind, *call = channel.receive()
        if kind == "close":
            return
        if kind == "relay":  # another worker's question follows, as it came
            call += channel.receive()[3:]
        channel.write(answer(channel, modules, printed, *call))


def answer(channel, modules, printed, topic, name, args, kwargs):
    """Call a function -> the payload that tells what became of it."""
    wire = channel.wire
    function = getattr(modules[topic], name, None)
    if not callable(function):
        return wire.encode(("missing", printed.taken()))
    inputs = list(wire.arrays_in((args, tuple(kwargs.values()))))
    before = [array.tobytes() for array in inputs]
    try:
        returned = channel.contract.standard(function(*args, **kwargs))
        changed = tuple((k, array) for k, (array, old) in
                        enumerate(zip(inputs, before, strict=True)) if array.tobytes() != old)
        return wire.encode(("returned", returned, changed, printed.taken()))
    except BaseException as error:
        return wire.encode(("raised", *error_parts(error), printed.taken()))


def error_parts(error):
    """An error's type, its text, and its lines (topic, line, function) in the labs."""
    try:
        text = str(error)[:MOST_PRINTED]
    except BaseException:
        text = ""
    frames = [(frame.f_code.co_filename, line, frame.f_code.co_name)
              for frame, line in traceback.walk_tb(error.__traceback__)
              if frame.f_code.co_filename.startswith(PACKAGE)]
    if isinstance(error, SyntaxError) and (error.filename or "").startswith(PACKAGE):
        text = str(error.msg)[:MOST_PRINTED]
        frames.append((error.filename, error.lineno or 1, ""))
    kept = frames[:MOST_FRAMES // 2] + frames[MOST_FRAMES // 2:][-MOST_FRAMES // 2:]
    return type(error).__name__, text, tuple(kept)


# --- modules and stand-ins ---------------------------------------------------------------------


def load(channel, codes):
    """-> {topic: module}. In each module, the functions named in its stand_ins are replaced."""
    package = sys.modules[PACKAGE] = types.ModuleType(PACKAGE)
    package.__path__ = []
    ask = Asking(channel)
    modules = {}
    for topic, code, stand_ins in codes:
        if isinstance(code, Exception):
            raise code
        module = types.ModuleType(f"{PACKAGE}.{topic}")
        module.__package__, module.__file__ = PACKAGE, file_name(topic)
        modules[topic] = sys.modules[module.__name__] = module
        setattr(package, topic, module)
        exec(code, vars(module))
        for name in stand_ins:
            own = getattr(module, name, None)
            setattr(module, name, functools.partial(ask, topic, name, own))
        channel.named |= channel.wire.named_tuples([module])
    return modules


class Asking:
    """What a function of the reference returns. The same question is asked once.

    Where the grader says "own", the function that was handed in answers, from then on.
    """

    def __init__(self, channel):
        self.channel = channel
        self.lock = threading.Lock()
        self.known = {}
        self.left = set()  # (topic, name) that the grader answers no more

    def __call__(self, topic, name, own, *args, **kwargs):
        if (topic, name) in self.left:
            return own(*args, **kwargs)
        kind, *answer = self.asked(topic, name, args, kwargs)
        if kind == "returned":
            return answer[0]
        if kind == "own":
            self.left.add((topic, name))
            return own(*args, **kwargs)
        if kind == "missing":
            raise AttributeError(f"{PACKAGE}/{topic}.py has no function {name}")
        raise known_error(answer[0])(answer[1])

    def asked(self, topic, name, args, kwargs):
        """What the grader has answered to this question, or answers now.

        It is kept as bytes, so that nobody changes it.
        """
        wire, standard = self.channel.wire, self.channel.contract.standard
        question = wire.encode(("ask", topic, name, tuple(map(standard, args)),
                                {key: standard(value) for key, value in kwargs.items()}))
        with self.lock:
            if question not in self.known:
                if len(self.known) > 1000:
                    self.known.clear()
                self.channel.write(question)
                self.known[question] = self.channel.read()
            return wire.decode(self.known[question], self.channel.named)


def known_error(name):
    """Python's own error of this name, or else RuntimeError."""
    error = getattr(builtins, name, None)
    return error if isinstance(error, type) and issubclass(error, Exception) else RuntimeError


if __name__ == "__main__":
    builtins.exit = builtins.quit = sys.exit  # as at home, where `site` makes them
    main()
