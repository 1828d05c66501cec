"""python3 -m course: find or make an environment that has requirements.txt, then run commands.py.

Where everything is there already (conda, an active environment), commands.py is run at once.
Elsewhere it makes .venv, once, and starts itself again inside, where nothing is started again.

The command run needs apps/bridge/requirements.txt as well, and the web site
site/requirements.txt.

A copy of each of these files in .venv tells how far its set-up came:
    none        of requirements.txt: somebody else made this .venv: it is used, never changed
    empty       set-up was cut short: .venv is made anew
    different   the file has changed since, or was never asked for: install it
    the same    ready
Standard library only, and readable for Python 3.6, so that an old Python gets a sentence, too.
"""
import importlib
import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

OLDEST = (3, 11)
ROOT = Path(__file__).resolve().parent.parent
REQUIREMENTS = ROOT / "requirements.txt"
VENV = ROOT / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
COPY = VENV / "requirements.txt"
TORCH = ROOT / "apps" / "bridge" / "requirements.txt"
SITE = ROOT / "site" / "requirements.txt"
INSIDE = VENV.exists() and VENV.samefile(sys.prefix)

REMEDIES = (  # what an error says, and what helps
    ("lacks|does not start", "delete this folder, or install the requirements in it yourself"),
    ("No module named '?(venv|ensurepip)",
     "install uv, or your system's venv package (Debian, Ubuntu: sudo apt install python3-venv)"),
    ("No space left|not enough space|quota exceeded", "free 1 GB on this disk"),
    ("Read-only|Permission denied|Access is denied|not permitted",
     "copy the course to a folder in which you may write"),
    ("matching distribution|no solution|request failed|connection|timed out|certificate",
     "check the network (proxy, package index)"),
    ("", "mend this"))


def main():
    if sys.version_info < OLDEST:
        return say(f"this needs Python {OLDEST[0]}.{OLDEST[1]} or newer, and {sys.executable} is "
                   f"{sys.version.split()[0]}: install a newer one (python.org, conda, uv), "
                   "then start with its name, as in: python3.13 -m course")
    try:
        for requirements in asked():
            if missing(requirements):
                set_up(requirements)
                if not INSIDE:
                    return start_inside()
                if missing(requirements):
                    raise OSError("it lacks " + ", ".join(missing(requirements)))
    except KeyboardInterrupt:
        return say("set-up was interrupted; the next start begins it again", status=130)
    except OSError as error:
        remedy = next(helps for says, helps in REMEDIES if re.search(says, str(error), re.I))
        return say(f"cannot set up {VENV} ({error}): {remedy}, then start again")

    sys.path[0] = str(ROOT)  # for "python3 /path/to/course" from any folder
    from course import commands
    return commands.main()


def asked():
    """The files of requirements that this command needs."""
    yield REQUIREMENTS
    if sys.argv[1:2] == ["run"]:
        yield TORCH
    if sys.argv[1:2] == ["site"] or "--site" in sys.argv:
        yield SITE


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


def set_up(requirements):
    """Bring .venv in step with this file. OSError says in one line what went wrong."""
    name = requirements.relative_to(ROOT)
    copy = VENV / "-".join(name.parts)
    starts = succeeds(PYTHON, "-c", "import sys; sys.exit(sys.version_info < (3, 11))")
    if VENV.exists() and not COPY.exists():
        if not starts:
            raise OSError("its Python does not start, or is too old")
        return
    wanted = requirements.read_text("utf-8")
    if starts and copy.exists() and copy.read_text("utf-8") == wanted:
        return
    uv = succeeds("uv", "--version")
    say(f"installing {name} into {VENV} with {'uv' if uv else 'pip'}; "
        "about a minute, only this once")
    if not INSIDE and not (starts and COPY.read_text("utf-8")):
        make_venv(uv)
    copy.write_text("", "utf-8")
    pip = ["uv", "pip", "install", "--python", PYTHON] if uv else [
        PYTHON, "-m", "pip", "--disable-pip-version-check", "install"]
    run_quietly(*pip, "-r", requirements)
    copy.write_text(wanted, "utf-8")


def make_venv(uv):
    if VENV.exists():
        shutil.rmtree(VENV)
    VENV.mkdir()
    COPY.write_text("", "utf-8")
    if uv:
        run_quietly("uv", "venv", "--allow-existing", "--python", sys.executable, VENV)
    else:
        run_quietly(sys.executable, "-m", "venv", "--without-pip", VENV)
        run_quietly(PYTHON, "-m", "ensurepip", "--default-pip")


def succeeds(*command):
    try:
        return subprocess.run([str(part) for part in command], capture_output=True).returncode == 0
    except OSError:
        return False


def run_quietly(*command):
    """Run a command. A terminal shows its latest line. If it fails, OSError with its error."""
    said = ["no word of explanation"]
    with subprocess.Popen([str(part) for part in command], stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          encoding="utf-8", errors="replace") as child:
        try:
            for line in filter(None, map(str.strip, child.stdout)):
                said.append(line)
                show(line)
        except KeyboardInterrupt:
            child.kill()
            raise
        finally:
            show("")
    if child.returncode != 0:
        errors = [line for line in said if re.match(r"\w*error", line, re.I)]
        raise OSError("; ".join(dict.fromkeys(errors[-1:] + said[-1:])))


def start_inside():
    """The same command in .venv's Python -> its exit status. Ctrl-C reaches it without our help."""
    signal.signal(signal.SIGINT, lambda *_: None)
    child = subprocess.Popen([str(PYTHON), str(ROOT / "course"), *sys.argv[1:]])
    signal.signal(signal.SIGTERM, lambda *_: child.terminate())
    status = child.wait()
    return status if status >= 0 else 128 - status


def say(sentence, status=2):
    print(f"course: {sentence}", file=sys.stderr, flush=True)
    return status


def show(line):
    if sys.stderr.isatty():
        width = shutil.get_terminal_size().columns - 1
        print(line[:width].ljust(width), end="\r", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
