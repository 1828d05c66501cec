"""Run a program that uses nvdiffrast or neural_renderer, unchanged, on the processor."""
import argparse

from course.given.whose import Lacking


def main():
    """The command line -> its exit status, or the sentence that says what the program lacks."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-m", action="store_true", help="SCRIPT.py names a module, as in python -m")
    parser.add_argument("--strict", action="store_true", help="refuse what a graphics card refuses")
    parser.add_argument("script", metavar="SCRIPT.py", help="the program")
    parser.add_argument("args", nargs=argparse.REMAINDER, help="and its own arguments")
    asked = parser.parse_args()
    try:
        from . import program
        return program.run(asked.script, asked.args, None, asked.m, asked.strict)
    except Lacking as error:
        return f"rasterization-bridge: {error}"
