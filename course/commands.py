"""What each command takes, and what it starts. Their list, with a line for each, is in cli.py."""
import argparse
import os
import signal
import subprocess
import sys

from labkit.places import ROOT

COMMANDS = {}  # name -> (function, options), in the order below


def command(*options):
    """Make a function a command with these options. Its docstring is what --help says."""
    def listed(function):
        COMMANDS[function.__name__.rstrip("_")] = function, options
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


GRADED = option("--labs", metavar="1-4", help="grade these labs; without, all of them")
SEED = option("--seed", type=whole_number(0), default=0, metavar="N",
              help="other random numbers in the checks")
TRIED = option("target", nargs="?", metavar="TARGET", help="a topic or a lab; without, everything")
WORKS = option("--impl", choices=("reference", "labs"),
               help="whose code does the work: the reference's, or yours in labs/; without, the "
                    "reference's if it is all there")
OPENED = option("target", metavar="TARGET",
                help="an exercise (2.14), a lab (2), labs (1-3) or a topic (scanline)")


# --- to look and to read ------------------------------------------------------------------------


@command(
    option("names", nargs="*", metavar="NAME",
           help="a scene; after bunny, rounded, simplified or relaxation your own mesh file, "
                "after aliasing your own picture; without a name, all quick scenes"),
    option("--list", action="store_true", help="say which scenes there are"),
    WORKS)
def demo(asked):
    """Render the course's scenes and say where the pictures are."""
    from course.scenes import demo
    if not asked.list:
        return demo.run(asked.names, asked.impl)
    for name in demo.SCENES:
        print(f"{name:15} {demo.title(name)}")
    return 0


@command(
    option("names", nargs="*", metavar="NAME",
           help="a topic or a number; without, those that are older than their code"),
    option("--all", action="store_true", help="all of them"))
def notebooks(asked):
    """Run notebooks from a clean kernel, and save what they print and draw otherwise."""
    import labkit.upkeep.notebooks
    return labkit.upkeep.notebooks.run(asked.names, everything=asked.all)


@command(
    WORKS,
    option("--size", type=whole_number(32, 512), default=128, metavar="N",
           help="pixels of a picture's longest side, 32 to 512; without, 128"),
    option("folder", metavar="FOLDER", help="the pictures, and where their cameras were"))
def reconstruct(asked):
    """Find the mesh and the paint of what a folder's pictures show."""
    from apps.reconstruct import command
    return command.run(asked.folder, asked.size, asked.impl)


@command(
    WORKS,
    option("script", metavar="SCRIPT.py", help="the program"),
    option("args", nargs=argparse.REMAINDER, metavar="ARGS", help="and its own arguments"))
def run(asked):
    """Run a program that uses nvdiffrast or neural_renderer, unchanged, on the course's code."""
    import apps.bridge.program
    return apps.bridge.program.run(asked.script, asked.args, asked.impl)


# --- to do the labs -----------------------------------------------------------------------------


@command(
    option("target", nargs="?", metavar="TARGET",
           help="a topic (rasterization), a lab (2) or an exercise (2.3); without, everything"),
    option("--impl", default="labs", metavar="labs|reference|FOLDER", help="whose code to check"),
    option("--watch", action="store_true", help="check again whenever a file is saved"),
    option("--pictures", action="store_true",
           help="open a page with all that failed, and pictures"),
    option("--json", metavar="FILE", help="write the board to this file as well"),
    SEED,
    option("--extra", action="store_true", help="check extras that are not open as well"),
    option("--spine", action="store_true", help="check the spine alone: the exercises for a week"))
def check(asked):
    """Check the labs and show the board. Status 0 only if all that was asked for passes."""
    import labkit.board
    run = labkit.board.watch if asked.watch else labkit.board.check
    return run(asked.target, asked.impl, json_file=asked.json, seed=asked.seed,
               pictures=asked.pictures, extra=asked.extra, spine=asked.spine)


@command(OPENED)
def open_(asked):
    """Empty an extra of labs/, or all extras of a lab, to write them yourself."""
    import labkit.upkeep.extras
    return labkit.upkeep.extras.open_extras(asked.target)


@command(OPENED, option("--core", action="store_true",
                        help="put released solutions into the core, too"))
def close(asked):
    """Put the answers back into extras that are open and untouched."""
    import labkit.upkeep.extras
    return labkit.upkeep.extras.close(asked.target, core=asked.core)


@command(option("file", nargs="?", default="labs.zip", metavar="FILE", help="the zip's name"))
def pack(asked):
    """Put the labs into one zip, check what is in it, and print its hash."""
    import labkit.grading.handing.pack
    return labkit.grading.handing.pack.run(asked.file)


# --- to teach -----------------------------------------------------------------------------------


@command(
    option("folder", metavar="DIR", help="a new folder"),
    option("--labs", metavar="1-4", help="hand out these labs; without, all of them"),
    option("--solutions", metavar="1-2", help="and the reference of these"),
    option("--after", metavar="1", help="only what these labs add to a hand-out of those"),
    option("--extra", action="store_true", help="with the extras open, too"),
    option("--spine", action="store_true",
           help="the spine alone: what a week holds, the rest complete"))
def handout(asked):
    """Write what students get to a folder: no solutions but those released."""
    import labkit.grading.handing.handout
    return labkit.grading.handing.handout.run(asked.folder, asked.labs, asked.solutions,
                                              extra=asked.extra, spine=asked.spine,
                                              after=asked.after)


@command(option("labs", metavar="LABS", help="of these labs, as in 1-2"),
         option("file", metavar="FILE", help="the zip's name"))
def solutions(asked):
    """Write a zip of solutions, for students to unpack in their copy of the course."""
    import labkit.grading.handing.handout
    return labkit.grading.handing.handout.release(asked.labs, asked.file)


@command(
    option("file", metavar="FILE", help="the zip's name"),
    GRADED)
def autograder(asked):
    """Write the zip that Gradescope takes as an assignment's autograder."""
    import labkit.grading.autograder
    return labkit.grading.autograder.gradescope(asked.file, asked.labs)


@command(
    option("submissions", metavar="SUBMISSIONS", help="a folder of folders, zips or single files"),
    option("--out", required=True, metavar="DIR", help="where reports and tables are written"),
    GRADED,
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
    option("--overrides", metavar="FILE", help="points by hand: student,exercise,points,reason"),
    option("--people", metavar="FILE",
           help="groups, and due times of single students: student,group,due"))
def grade(asked):
    """Grade submissions: reports and grades.csv. Status 0 if all could be graded.

    Options that are not given are those of the last run into DIR. --due "" forgets one.
    """
    try:
        import labkit.grading.grade
        from labkit.grading.request import Request
        return labkit.grading.grade.run(
            Request(*(getattr(asked, name) for name in Request._fields)))
    except KeyboardInterrupt:
        raise KeyboardInterrupt("stopped; what is graded is kept: the same command with --resume "
                                "goes on") from None


# --- to work on the course ----------------------------------------------------------------------


@command(
    option("--check", action="store_true", help="write nothing; fail if labs/ is out of step"),
    option("--force", action="store_true", help="start afresh the labs that were worked on, too"))
def skeleton(asked):
    """Make labs/ from reference/, each exercise's answer taken out."""
    import labkit.upkeep.skeleton
    return labkit.upkeep.skeleton.run(check=asked.check, force=asked.force)


@command(TRIED)
def mistakes(asked):
    """Try the mistakes in tests/mistakes/: each must be caught. Makes labkit/checks/hints.json."""
    import labkit.upkeep.mistakes
    return labkit.upkeep.mistakes.run(asked.target)


@command(option("target", nargs="?", metavar="TARGET",
                help="a topic, a lab or an exercise, as for check; without, everything: an hour"))
def mutants(asked):
    """Put small mistakes into the reference's exercises, and count those that the checks catch."""
    import labkit.upkeep.mutants
    return labkit.upkeep.mutants.run(asked.target)


@command(
    option("--serve", action="store_true", help="show it in the browser, until Ctrl-C"),
    option("--lite", action="store_true", help="and with JupyterLite, the labs in the browser"))
def site(asked):
    """Make the web site in out/site/. Lectures are shown as they are saved."""
    return make_site(*(f"--{name}" for name in ("serve", "lite") if getattr(asked, name)))


def make_site(*wishes):
    return run_python(str(ROOT / "site" / "build.py"), *wishes)


@command(
    option("--all", action="store_true", help="run every lecture, too: twice as long"),
    option("--site", action="store_true",
           help="check the web site instead: make it, and open every page in Chromium"))
def test(asked):
    """Check the whole project: lint, then every test, on all cores. Or the web site."""
    if asked.site:
        return make_site() or run_module("pytest", "-rfEs", "-n", str(os.cpu_count()), "tests/site")
    # labs/ is not for lint: it is made from reference/, or a student's own.
    lint = run_module("ruff", "check", "--quiet", "--extend-exclude", str(ROOT / "labs"), str(ROOT))
    left_out = () if asked.all else ("-m", "not weekly")
    tests = run_module("pytest", "-n", str(os.cpu_count()), "--dist", "worksteal", *left_out)
    import labkit.upkeep.notebooks
    if older := labkit.upkeep.notebooks.older():
        print(f"{len(older)} lectures are older than their code, which is no mistake; "
              "python3 -m course notebooks runs them")
    if lint:
        print("course: ruff found what it prints above the tests", file=sys.stderr)
    return tests or lint


def run_module(*command):
    return run_python("-m", *command)


def run_python(*command):
    """python command, in the course's folder, without anybody's own settings for pytest."""
    settings = {**os.environ, "PYTEST_ADDOPTS": "", "OMP_NUM_THREADS": "1"}  # one core, one worker
    with subprocess.Popen([sys.executable, *command], cwd=ROOT, env=settings) as child:
        signal.signal(signal.SIGTERM, lambda *_: child.terminate())
        try:
            return child.wait()
        except KeyboardInterrupt:
            child.wait()  # Ctrl-C reaches it, too: let it end in order
            raise
