"""The course's own commands, beside those of labkit."""
import argparse
import os
import signal
import subprocess
import sys

from labkit.cli import main  # noqa: F401  __main__.py starts it, with the commands below
from labkit.commands import LOOK, WORK, command, option, whole_number
from labkit.places import ROOT

WORKS = option("--impl", choices=("reference", "labs"),
               help="whose code does the work: the reference's, or yours in labs/; without, the "
                    "reference's if it is all there")


@command(
    LOOK, "demo [NAME ...]",
    option("names", nargs="*", metavar="NAME",
           help="a scene; after bunny, rounded, simplified or relaxation your own mesh file, "
                "after aliasing your own picture; without a name, all quick scenes"),
    option("--list", action="store_true", help="say which scenes there are"),
    WORKS)
def demo(asked):
    """Render the course's scenes into out/, also of your own mesh or photo."""
    from course.scenes import demo
    if not asked.list:
        return demo.run(asked.names, asked.impl)
    for name in demo.SCENES:
        print(f"{name:15} {demo.title(name)}")
    return 0


@command(
    LOOK, "notebooks [NAME ...]",
    option("names", nargs="*", metavar="NAME",
           help="a topic or a number; without, those that are older than their code"),
    option("--all", action="store_true", help="all of them"))
def notebooks(asked):
    """Run the lectures, and save what they print and draw otherwise."""
    from labkit.upkeep import notebooks
    return notebooks.run(asked.names, everything=asked.all)


@command(
    LOOK, "reconstruct FOLDER",
    WORKS,
    option("--size", type=whole_number(32, 512), default=128, metavar="N",
           help="pixels of a picture's longest side, 32 to 512; without, 128"),
    option("folder", metavar="FOLDER", help="the pictures, and where their cameras were"))
def reconstruct(asked):
    """Find the mesh and the paint of what a folder's pictures show."""
    from apps.reconstruct import command
    return command.run(asked.folder, asked.size, asked.impl)


@command(
    LOOK, "run SCRIPT.py [ARGS]",
    WORKS,
    option("-m", action="store_true", dest="is_module",
           help="SCRIPT.py is the name of a module, as in python -m"),
    option("--strict", action="store_true",
           help="refuse what a graphics card refuses: float64, and tensors that were not moved"),
    option("script", metavar="SCRIPT.py", help="the program"),
    option("args", nargs=argparse.REMAINDER, metavar="ARGS", help="and its own arguments"))
def run(asked):
    """Run a program that uses nvdiffrast or neural_renderer, unchanged."""
    from apps.bridge import program
    return program.run(asked.script, asked.args, asked.impl, asked.is_module, asked.strict)


@command(
    WORK, "site",
    option("--serve", action="store_true", help="show it in the browser, until Ctrl-C"),
    option("--python", metavar="DIR",
           help="a folder with Pyodide, for exercises without a network"),
    option("--stills", action="store_true",
           help="take its figures' stills for the lectures, with Chromium"))
def site(asked):
    """Make the web site in out/site/. Lectures are shown as they are saved."""
    return make_site(*["--serve"] * asked.serve, *["--stills"] * asked.stills,
                     *["--python", asked.python] * bool(asked.python))


def make_site(*wishes):
    return run_python(str(ROOT / "site" / "build.py"), *wishes)


@command(
    WORK, "test",
    option("--all", action="store_true", help="run every lecture, too: twice as long"),
    option("--site", action="store_true",
           help="check the web site instead: make it, and open every page in Chromium"))
def test(asked):
    """Check the project: lint, then every test, with --site the web site."""
    if asked.site:
        return make_site() or run_module("pytest", "-rfEs", "-n", str(os.cpu_count()), "tests/site")
    # labs/ is not for lint: it is made from reference/, or a student's own.
    lint = run_module("ruff", "check", "--quiet", "--extend-exclude", str(ROOT / "labs"), str(ROOT))
    left_out = () if asked.all else ("-m", "not weekly")
    tests = run_module("pytest", "-n", str(os.cpu_count()), "--dist", "worksteal",
                       "--durations=10", *left_out)
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
