"""python3 -m course: find or make an environment that has requirements.txt, then run commands.py.

Where everything is there already (conda, an active environment), commands.py is run at once.
Elsewhere it makes .venv, installs there what is missing, and starts itself again inside. The
command run needs apps/bridge/requirements.txt as well, and the web site site/requirements.txt.

A .venv without the file MARK is somebody else's: it is used, never changed. The mark is empty until
the .venv has its pip, so that one whose making was cut short is made anew.
Standard library only, and readable for Python 3.6, so that an old Python gets a sentence, too.
"""
import importlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

OLDEST = (3, 11)
ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
MARK = VENV / "made_by_the_course"
INSIDE = VENV.exists() and VENV.samefile(sys.prefix)


def main():
    if sys.version_info < OLDEST:
        return say(f"this needs Python {OLDEST[0]}.{OLDEST[1]} or newer, and {sys.executable} is "
                   f"{sys.version.split()[0]}: install a newer one (python.org, conda, uv), "
                   "then start with its name, as in: python3.13 -m course")
    try:
        if any(map(missing, asked())):
            if not INSIDE:
                return start_inside()
            for requirements in filter(missing, asked()):
                install(requirements)
    except KeyboardInterrupt:
        return say("set-up was interrupted; the next start goes on with it", status=130)
    except OSError as error:
        return say(f"cannot set up {VENV} ({error}): mend this, or install requirements.txt "
                   "yourself, then start again")
    sys.path[0] = str(ROOT)  # for "python3 /path/to/course" from any folder
    from course import commands
    return commands.main()


def asked():
    """The files of requirements that this command needs."""
    yield ROOT / "requirements.txt"
    if sys.argv[1:2] == ["run"]:
        yield ROOT / "apps" / "bridge" / "requirements.txt"
    if sys.argv[1:2] == ["site"] or "--site" in sys.argv:
        yield ROOT / "site" / "requirements.txt"


def missing(requirements):
    """The lines of this file that this Python does not meet, by name and lower bound."""
    from importlib.metadata import PackageNotFoundError, version

    def met(name, bound):
        try:
            return numbers(version(name)) >= numbers(bound)
        except PackageNotFoundError:
            return False

    importlib.invalidate_caches()
    line = r"^((\w[\w.-]*)(?:>=([\d.]+))?)"
    wanted = re.findall(line, requirements.read_text("utf-8"), re.MULTILINE)
    return [whole for whole, name, bound in wanted if not met(name, bound)]


def numbers(version):
    """'2.1.3' -> (2, 1, 3)."""
    return tuple(int(digits) for digits in re.findall(r"\d+", version or ""))


def start_inside():
    """The same command in .venv's Python, which is made first where there is none."""
    half = MARK.exists() and not (PYTHON.exists() and MARK.read_text("utf-8"))
    if half or not VENV.exists():
        make_venv()
    if not PYTHON.exists():
        raise OSError("it has no Python and is not ours: delete it, if nobody needs it")
    inside = [str(PYTHON), str(ROOT / "course"), *sys.argv[1:]]
    if os.name == "nt":
        return subprocess.call(inside)
    os.execv(str(PYTHON), inside)


def make_venv():
    say(f"making {VENV}, only this once")
    shutil.rmtree(VENV, ignore_errors=True)
    VENV.mkdir()
    MARK.write_text("", "utf-8")
    run("venv", str(VENV))
    MARK.write_text("whole", "utf-8")


def install(requirements):
    """Install what this file asks for, here."""
    if MARK.exists():
        say(f"installing {requirements.relative_to(ROOT)} into {VENV}; about a minute, only once")
        run("pip", "install", "--quiet", "--disable-pip-version-check", "-r", str(requirements))
    if missing(requirements):
        raise OSError("it lacks " + ", ".join(missing(requirements)))


def run(module, *arguments):
    """python -m module. OSError: it failed, and has said why."""
    if subprocess.call([sys.executable, "-m", module, *arguments]):
        raise OSError(f"{module} failed, see above")


def say(sentence, status=2):
    print(f"course: {sentence}", file=sys.stderr, flush=True)
    return status


if __name__ == "__main__":
    sys.exit(main())
