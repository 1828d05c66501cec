"""Differentiable rasterization in plain NumPy: labs, their checks, and the code to compare with.

to look and to read
  demo [NAME ...]       render the course's scenes into out/, also of your own mesh or photo
  notebooks [NAME ...]  run the lectures in notebooks/ and save them with their figures
  reconstruct FOLDER    find the mesh of what your own pictures show
  run SCRIPT.py [ARGS]  run a program that uses nvdiffrast or neural_renderer, unchanged

to do the labs
  check [TARGET]        what is right in labs/, what is not, and what to do next
  open TARGET           empty an extra, or all extras of a lab, to write them
  close TARGET          put the answers back where nothing was written
  pack [FILE]           put the labs into one zip to hand in

to teach
  handout DIR           what students get: labs, checks, lectures, and no solutions
  solutions LABS FILE   release solutions later: a zip that students unpack in their copy
  grade SUBMISSIONS     grade what was handed in, each submission in a sandbox
  autograder FILE       the zip that Gradescope takes as an autograder

to work on the course
  skeleton              make labs/ from reference/, but for labs that were worked on
  mistakes [TARGET]     try the known mistakes, and make the hints that they give
  mutants [TARGET]      how many small mistakes, made by machine, the checks catch
  site                  make the web site in out/site/ of all this
  test                  check the project: lint, then every test; with --site the web site

examples
  python3 -m course demo                     all scenes that take seconds
  python3 -m course demo rounded cow.obj     a scene with your own mesh
  python3 -m course check                    the board of all labs
  python3 -m course check rasterization      one lab, by its topic
  python3 -m course check 2.3                one exercise
  python3 -m course check 2 --watch          again whenever you save
  python3 -m course check 2 --pictures       expected, got and difference as pictures
  python3 -m course check --impl reference   what a finished course looks like
  python3 -m course COMMAND --help           more about one command
"""
import argparse
import dis
import os
import re
import sys
from pathlib import Path

from course.commands import COMMANDS
from labkit import memory
from labkit.places import ROOT, is_handout

FOR_TEACHERS = ("handout", "solutions", "grade", "autograder", "skeleton", "mistakes", "mutants",
                "site", "test")  # commands that a copy for students withholds


def main(argv: list[str] | None = None) -> int:
    """Run one command -> its exit status: 0 well, 1 something failed, 2 cannot be done, 130 Ctrl-C.

    What the user can mend is said in one line. Everything else is a defect: traceback.
    """
    memory.hold()
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")  # for consoles that lack a character
    asked = arguments(sys.argv[1:] if argv is None else argv)
    try:
        return asked.command(asked)
    except KeyboardInterrupt as stopped:
        if str(stopped):
            print(f"course: {stopped}", file=sys.stderr)
        return 130
    except BrokenPipeError:  # whoever reads along has seen enough, as in: check | head
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (OSError, ValueError, NotImplementedError) as error:
        if not can_be_mended(error):
            raise
        unwritten = isinstance(error, NotImplementedError)
        print(f"course: {error}{' is not written yet' if unwritten else ''}", file=sys.stderr)
        return 2


def can_be_mended(error):
    """Can the user mend it? Yes: a file that fails, or what our own code or labs/ raise themselves.

    What Python or a library raises in between is a defect of the code that called it.
    """
    cause = error.__traceback__
    while cause.tb_next:
        cause = cause.tb_next
    code = cause.tb_frame.f_code
    ours = any(Path(code.co_filename).resolve().is_relative_to(ROOT / folder)
               for folder in ("course", "apps", "labs"))
    raised = code.co_code[cause.tb_lasti] == dis.opmap["RAISE_VARARGS"]
    return isinstance(error, OSError) or (ours and raised)


def withheld():
    """The names of teachers' commands, in a copy for students."""
    return FOR_TEACHERS if is_handout() else ()


def page():
    """This module's docstring. In a copy for students, what is for students."""
    if not is_handout():
        return __doc__
    parts = [part for part in __doc__.split("\n\n")
             if not any(f"\n  {name} " in part for name in FOR_TEACHERS)]
    return re.sub(r".*--impl reference.*\n", "", "\n\n".join(parts))


class Parser(argparse.ArgumentParser):
    """Tells a mistake in one line, without the usage."""

    def error(self, message):
        self.exit(2, f"course: {message}; {self.prog} --help says more\n")


def arguments(argv):
    """What was asked for, out of the commands that this copy has. Without a command, the page."""
    parser = Parser(prog="python3 -m course", usage="%(prog)s COMMAND ...", description=page(),
                    formatter_class=argparse.RawDescriptionHelpFormatter)

    def show_help(_):
        parser.print_help()
        return 0

    parser.set_defaults(command=show_help)
    commands = parser.add_subparsers(prog=parser.prog, metavar="COMMAND", help=argparse.SUPPRESS)
    for name, (function, options) in COMMANDS.items():
        if name not in withheld():
            made = commands.add_parser(name, description=function.__doc__)
            made.set_defaults(command=function)
            for names, settings in options:
                made.add_argument(*names, **settings)
    if argv and argv[0] in withheld():
        parser.error(f"{argv[0]} is for teachers, and this is a copy for students")
    return parser.parse_args(argv)
