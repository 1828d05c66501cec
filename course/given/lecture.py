"""How a lecture begins: figures of one style, and cells that wait for what is not written yet.

    import sys; sys.path.append("..")  # finds the course from the folder notebooks/
    from reference import antialiasing, outlines  # "labs": your own work
    from course.given import lecture, mesh, plot

    lecture.begin()

A student reads a lecture before all its exercises are written. A cell that calls such an exercise
prints a sentence that names it, and no traceback. What the cell makes is then not there, and a
later cell that uses it says so, too. Jupyter takes neither for a failure and goes on with the next
cell. All other errors are shown as always, those inside an exercise as well. A waiting cell shows
the picture that it came with, pale.
"""
import ast
import contextlib
import functools
import traceback
import types

import matplotlib.pyplot as plt
from IPython import get_ipython

from labkit import memory
from labkit.contract import UNFINISHED

from . import pale, plot
from .whose import Lacking, exercises_named

SCOPES = ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp


def begin():
    """Call this at the end of the first code cell. Outside of Jupyter it only sets the style."""
    memory.hold()
    plot.style()
    shell = get_ipython()
    if shell:
        let_cells_wait(shell)
        missing = [f"{', '.join(numbers)} in {file_of(value.__name__)}"
                   for value in shell.user_ns.values()
                   if isinstance(value, types.ModuleType) and (numbers := unfinished(value))]
        if missing:
            print(f"Still to be written: {'; '.join(missing)}.\n"
                  "A cell that needs what is missing waits and says so.")
            pale.came_with()  # before Jupyter saves over them


@contextlib.contextmanager
def when_written():
    """A block that needs what is not there or not written says so.

    The cell shows the picture that it came with, pale.
    """
    try:
        with exercises_named():
            yield
    except Lacking as error:
        print(f"Nothing of yours to see yet: {error}")
        if shell := get_ipython():
            pale.show(shell.history_manager.input_hist_raw[-1], after="that")


def unfinished(module):
    """The numbers of a module's exercises that are not written yet, from top to bottom."""
    texts = [text for value in vars(module).values()
             if isinstance(value, types.FunctionType) and value.__module__ == module.__name__
             for text in value.__code__.co_consts if isinstance(text, str)]
    return [found[1] for found in map(UNFINISHED.fullmatch, texts) if found]


def file_of(module):
    """labs.antialiasing -> labs/antialiasing.py."""
    return module.replace(".", "/") + ".py"


@functools.cache
def let_cells_wait(shell):
    """Once for each kernel, however often the first cell is run."""
    waiting = Waiting(shell)
    shell.set_custom_exc((NotImplementedError, NameError), waiting.show)
    shell.events.register("post_run_cell", waiting.end)


class Waiting:
    """What a notebook waits for. missing: {name that a cell did not make: exercise it needs}."""

    def __init__(self, shell):
        self.shell = shell
        self.missing = {}

    def reason(self, error):
        """-> the exercise that a cell waits for, the sentence that says so. None: a real error."""
        *_, (frame, _) = traceback.walk_tb(error.__traceback__)
        found = UNFINISHED.fullmatch(str(error))
        if isinstance(error, NotImplementedError) and found:
            number, name = found.groups()
            file = file_of(frame.f_globals["__name__"])
            return number, (f"This cell waits for exercise {number}, {name}, in {file}: write it, "
                            "restart the kernel and run all cells.")
        is_here = isinstance(error, NameError) and frame.f_globals is self.shell.user_ns
        if is_here and error.name in self.missing:
            number = self.missing[error.name]
            return number, (f"This cell waits, too, for exercise {number}: it uses "
                            f"`{error.name}`, which is made above.")

    def show(self, shell, kind, error, trace, tb_offset=None):
        """In place of IPython's traceback, before open figures are shown."""
        if self.reason(error):
            plt.close("all")
        else:
            shell.showtraceback((kind, error, trace), tb_offset=tb_offset)

    def end(self, result):
        """After every cell. One that waits has not failed, and leaves no old values behind."""
        error = result and result.error_in_exec
        reason = error and self.reason(error)
        if reason:
            number, sentence = reason
            print(sentence)
            pale.show(result.info.raw_cell, number)
            result.error_in_exec = None
            for name, is_value in made(ast.parse(self.shell.transform_cell(result.info.raw_cell))):
                self.missing[name] = number
                if is_value:
                    self.shell.user_ns.pop(name, None)


def made(node):
    """Yield name, is_value for all that a cell makes: values, and functions and classes."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Name) and isinstance(child.ctx, ast.Store):
            yield child.id, True
        elif isinstance(child, ast.FunctionDef | ast.ClassDef):
            yield child.name, False
        elif not isinstance(child, SCOPES):
            yield from made(child)
