"""What each command takes, and what it starts. A course adds its own."""
import argparse
from collections.abc import Callable
from typing import NamedTuple

from .table import LABS, TASKS

LOOK, DO = "to look and to read", "to do the labs"
TEACH, WORK = FOR_TEACHERS = "to teach", "to work on the course"  # not in a copy for students


class Command(NamedTuple):
    """What a command does, its options, and where and how the help lists it."""

    function: Callable
    options: tuple
    section: str
    usage: str


COMMANDS = {}  # name -> Command


def command(section, usage, *options):
    """Make a function the command of this usage: "check [TARGET]". Its docstring is its help, and
    the first line of it stands in the list of commands.
    """
    def listed(function):
        COMMANDS[usage.split()[0]] = Command(function, options, section, usage)
        return function

    return listed


def option(*names, **settings):
    """An option of a command, as argparse's add_argument takes it."""
    return names, settings


def whole_number(least, most=None):
    """-> the function that reads an option's whole number, from the least one on."""
    def read(text):
        if not text.isdecimal() or int(text) < least or (most and int(text) > most):
            limits = f"from {least} to {most}" if most else f"from {least} on"
            raise argparse.ArgumentTypeError(f"give a whole number {limits}, not {text}")
        return int(text)

    return read


SEED = option("--seed", type=whole_number(0), default=0, metavar="N",
              help="other random numbers in the checks")
TRIED = option("target", nargs="?", metavar="TARGET", help="a topic or a lab; without, everything")
OPENED = option("target", metavar="TARGET",
                help=f"an exercise (1.1), a lab (1), labs (1-3) or a topic ({LABS[0][0]})")


# --- to do the labs -----------------------------------------------------------------------------


@command(
    DO, "check [TARGET]",
    option("target", nargs="?", metavar="TARGET",
           help=f"a topic ({LABS[0][0]}), a lab (1), an exercise (1.1) or an open task; "
                "without, all labs"),
    option("--impl", default="labs", metavar="labs|reference|FOLDER", help="whose code to check"),
    option("--pictures", action="store_true",
           help="open a page with all that failed, and pictures"),
    SEED,
    option("--extra", action="store_true", help="check extras that are not open as well"))
def check(asked):
    """Show what is right in labs/, what is not, and what to do next.

    Status 0 only if all that was asked for passes.
    """
    from . import board, tasks
    if asked.target in TASKS:
        return tasks.check(asked.target, asked.impl, asked.seed)
    return board.check(asked.target, asked.impl, asked.seed, asked.pictures, asked.extra)


@command(DO, "open TARGET", OPENED)
def open_extra(asked):
    """Empty an extra of labs/, or all extras of a lab, to write them yourself."""
    from .upkeep import extras
    return extras.open_extras(asked.target)


@command(DO, "close TARGET", OPENED,
         option("--core", action="store_true", help="put released solutions into the core, too"))
def close(asked):
    """Put the answers back into extras that are open and untouched."""
    from .upkeep import extras
    return extras.close(asked.target, core=asked.core)


@command(DO, "pack [FILE]",
         option("file", nargs="?", default="labs.zip", metavar="FILE", help="the zip's name"))
def pack(asked):
    """Put the labs into one zip to hand in, and print its hash."""
    from .grading.handing import pack
    return pack.run(asked.file)


# --- to teach -----------------------------------------------------------------------------------


@command(
    TEACH, "handout DIR",
    option("folder", metavar="DIR", help="a new folder"),
    option("--labs", metavar="1-4", help="hand out these labs; without, all of them"),
    option("--solutions", metavar="1-2", help="and the reference of these"),
    option("--after", metavar="1", help="only what these labs add to a hand-out of those"),
    option("--extra", action="store_true", help="with the extras open, too"))
def handout(asked):
    """Write what students get: labs, checks, lectures, and no solutions."""
    from .grading.handing import handout
    return handout.run(asked.folder, asked.labs, asked.solutions, extra=asked.extra,
                       after=asked.after)


@command(TEACH, "solutions LABS FILE",
         option("labs", metavar="LABS", help="of these labs, as in 1-2"),
         option("file", metavar="FILE", help="the zip's name"))
def solutions(asked):
    """Release solutions: a zip that students unpack in their copy."""
    from .grading.handing import handout
    return handout.release(asked.labs, asked.file)


@command(
    TEACH, "grade [SUBMISSIONS]",
    option("submissions", nargs="?", metavar="SUBMISSIONS",
           help="a folder of folders, zips or single files; without, what DIR keeps, again"),
    option("--out", required=True, metavar="DIR", help="where reports and tables are written"),
    option("--labs", metavar="1-4", help="grade these labs; without, all of them"),
    option("--task", metavar="NAME", choices=TASKS, help="grade this open task, and no lab"),
    option("--jobs", type=whole_number(1), metavar="N",
           help="how many at a time; without, one for each core"),
    option("--resume", action="store_true", help="keep results of the same work and checks"),
    option("--seed", type=whole_number(0), metavar="N",
           help="what all random inputs are made from; without, it is drawn, and secret"),
    option("--isolation", choices=("strict", "process"),
           help="strict needs Linux with bubblewrap; process is for work that you trust"),
    option("--seconds", type=float, metavar="S", help="the most that a call may take; without, 10"),
    option("--extra", action="store_true", default=None,
           help="extras count, too: they were handed out open"),
    option("--csv", choices=("canvas", "moodle", ""),
           help="write this platform's import file, from its own export"),
    option("--roster", metavar="FILE", help="that export, as CSV"),
    option("--assignment", metavar="NAME", help="which of its columns takes the points"),
    option("--due", metavar="TIME", help="as in 2026-11-22T23:59, in this machine's time zone, or "
                                         "2026-11-22T23:59+01:00"),
    option("--late", metavar="10%/day", help="what lateness takes off, for each day or hour begun"),
    option("--grace", metavar="1h", help="so late costs nothing: 15min, 1h, 1d"),
    option("--count", choices=("newest", "last-on-time", "best"),
           help="which counts of several hand-ins; without, the newest"),
    option("--overrides", metavar="FILE", help="points by hand: student,exercise,points,reason"),
    option("--people", metavar="FILE",
           help="groups, and due times of single students: student,group,due"),
    option("--all-or-nothing", action=argparse.BooleanOptionalAction,
           help="no points for a part of an exercise's claims"))
def grade(asked):
    """Grade what was handed in, each submission in a sandbox.

    Status 0 if all could be graded. Options that are not given are those of the last run into DIR.
    --due "" forgets one.
    """
    try:
        from .grading import grade
        from .grading.request import Request
        wishes = (getattr(asked, name) for name in Request._fields)
        return grade.run(Request(*wishes))
    except KeyboardInterrupt:
        raise KeyboardInterrupt("stopped; what is graded is kept: the same command with --resume "
                                "goes on") from None


# --- to work on the course ----------------------------------------------------------------------


@command(
    WORK, "skeleton",
    option("--force", action="store_true", help="start afresh the labs that were worked on, too"))
def skeleton(asked):
    """Make labs/ from reference/, each exercise's answer taken out."""
    from .upkeep import skeleton
    return skeleton.run(force=asked.force)


@command(WORK, "mistakes [TARGET]", TRIED)
def mistakes(asked):
    """Try the known mistakes, and make the hints that they give."""
    from .upkeep import mistakes
    return mistakes.run(asked.target)


@command(
    WORK, "mutants [TARGET]",
    option("target", nargs="?", metavar="TARGET",
           help="a topic, a lab or an exercise, as for check; without, everything: an hour"))
def mutants(asked):
    """Count the small mistakes, made by machine, that the checks catch."""
    from .upkeep import mutants
    return mutants.run(asked.target)
