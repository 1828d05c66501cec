"""Run a program that uses nvdiffrast or neural_renderer, unchanged, on the processor."""
import argparse

from course.given.whose import Lacking

OPTIONS = (
    (("-m",), {"action": "store_true", "dest": "is_module",
               "help": "SCRIPT.py is the name of a module, as in python -m"}),
    (("--strict",), {
        "action": "store_true",
        "help": "refuse what a graphics card refuses: float64, and tensors that were not moved"}),
    (("script",), {"metavar": "SCRIPT.py", "help": "the program"}),
    (("args",), {"nargs": argparse.REMAINDER, "metavar": "ARGS", "help": "and its own arguments"}))


def main():
    """The command line -> its exit status, or the sentence that says what the program lacks."""
    parser = argparse.ArgumentParser(description=__doc__)
    for names, settings in OPTIONS:
        parser.add_argument(*names, **settings)
    asked = parser.parse_args()
    try:
        from . import program
        return program.run(asked.script, asked.args, None, asked.is_module, asked.strict)
    except Lacking as error:
        return f"rasterization-bridge: {error}"
