"""What of a student's is behind a program's calls, and which of it is not right."""
import importlib.util
import re
import sys
from pathlib import Path

from labkit import exercises, verdicts
from labkit.checks.runner import run_checks
from labkit.table import COMMAND

TABLE = Path(__file__).with_name("README.md")  # a row of it is an operation


def behind(program):
    """The numbers of the exercises behind the operations that a program's text names. Where it
    names none, modules of its own do: those behind all operations.
    """
    rows = dict(re.findall(r"^\| `(?:dr|nr)\.(\w+)` (.*)$", TABLE.read_text("utf-8"), re.MULTILINE))
    named = [rows[name] for name in rows if re.search(rf"\.{name}|import.*{name}", program)]
    return set(re.findall(r"\d+\.\d+", "".join(named or rows.values())))


def tell(program):
    """Print which of them in labs/ are not written or fail their checks, in a line if any."""
    code, = importlib.util.find_spec("labs").submodule_search_locations
    labs, _ = exercises.asked_for(None)
    asked = behind(program) - verdicts.closed_extras(labs, Path(code))
    checks, _ = run_checks(labs, asked, code, seed=0)
    found = dict.fromkeys((check.verdict, check.exercise) for check in checks
                          if not check.fine_print)
    wrong = {said: [number for verdict, number in found if verdict == kind]
             for kind, said in (("not started", "not written"), ("failed", "failing"))}
    if any(wrong.values()):
        listed = " and ".join(f"{said}: {', '.join(wrong[said])}" for said in wrong if wrong[said])
        print(f"course: of what it may call, {listed}; {COMMAND} check "
              f"{[*wrong['failing'], *wrong['not written']][0]} says more", file=sys.stderr, flush=True)
