"""python3 -m course sets itself up: tried in real second processes, on a copy without the network.

The copy's command line is a stand-in that prints where it runs, and exits as it is told to.
"""
import ast
import errno
import os
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import SimpleNamespace

import pytest
from submitted import put

COURSE = Path(__file__).parents[2] / "course"
STAND_IN = """
import sys
def main():
    print(sys.prefix, sys.argv[1:])
    return int(sys.argv[1])
"""


def lay_out(root):
    """A repository of its own at root: the course's start, one requirement, a shelf of packages."""
    put(root, {"course/__init__.py": "", "course/commands.py": STAND_IN,
               "requirements.txt": "pebble>=1.0  # a package that nobody has\n"})
    shutil.copy(COURSE / "__main__.py", root / "course")
    for name in ("pebble", "stone"):
        wheel(root / "shelf", name)
    return root


def wheel(folder, name):
    """The smallest package that pip installs: version 1.2 of name."""
    about = f"{name}-1.2.dist-info"
    put(folder, {f"{name}-1.2-py3-none-any.whl": {
        f"{about}/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.2\n",
        f"{about}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        f"{about}/RECORD": ""}})


def surroundings(root, **more):
    """The environment of a start: pip knows the shelf and no network, uv is nowhere."""
    pip = {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": (root / "shelf").as_uri(),
           "PIP_CONFIG_FILE": os.devnull}
    ours = {key: text for key, text in os.environ.items()
            if not key.startswith(("PIP_", "PYTHON", "UV_"))}
    return {**ours, **pip, "PATH": str(root / "shelf"), **more}


def start(root, *arguments, python=sys.executable, target=("-m", "course"), cwd=None, **more):
    """One start to its end: exit status, what it printed, the sentences that it told."""
    ended = subprocess.run([python, *target, *arguments], cwd=cwd or root, text=True,
                           capture_output=True, timeout=200, env=surroundings(root, **more))
    return SimpleNamespace(status=ended.returncode, printed=ended.stdout,
                           told=ended.stderr.splitlines())


def assert_refused(ended, why):
    """The start did nothing but say why, in one line."""
    assert ended.status == 2
    assert len(ended.told) == 1 and why in ended.told[0]


def venv_python(root):
    return root / ".venv" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def fake(root, module, text):
    """Put a module into root/fakes, to stand for one of the standard library."""
    put(root, {f"fakes/{module}.py": text})


def installed(root):
    return sorted(path.name for path in (root / ".venv").rglob("*.dist-info")
                  if not path.name.startswith(("pip-", "setuptools-")))


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A copy after its first start, and what that start said."""
    root = lay_out(tmp_path_factory.mktemp("first") / "a folder with spaces")
    return root, start(root, "0", "two words", "*")


@pytest.fixture
def ready(first, tmp_path):
    """A copy of its own, set up."""
    return shutil.copytree(first[0], tmp_path / "ready", symlinks=True)


@pytest.fixture
def new(tmp_path):
    """A copy of its own, before its first start."""
    return lay_out(tmp_path / "new")


@pytest.fixture
def module(new):
    """The start of `new` as a module of this process, for what cannot be had for real."""
    spec = spec_from_file_location("start", new / "course" / "__main__.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_first_start_says_one_line_and_runs_the_command_in_a_new_venv(first):
    """The set-up is silent or chatty, the command runs outside, arguments are split at spaces."""
    root, ended = first
    assert ended.status == 0, ended.told
    assert len(ended.told) == 1 and "installing requirements.txt into" in ended.told[0]
    assert ended.printed == f"{root / '.venv'} {['0', 'two words', '*']}\n"
    assert installed(root) == ["pebble-1.2.dist-info"]


@pytest.mark.parametrize("elsewhere", [False, True], ids=["in its folder", "by its path"])
def test_the_second_start_installs_nothing_and_passes_its_status_on(ready, tmp_path, elsewhere):
    """The finished .venv is not recognised, and every start costs a minute; a failed check exits 0,
    and CI sees green. Started as python3 /path/to/course, it does not find itself.
    """
    where = {"target": [ready / "course"], "cwd": tmp_path} if elsewhere else {}
    ended = start(ready, "7", PIP_FIND_LINKS="nowhere", **where)
    assert (ended.status, ended.told) == (7, [])
    assert ended.printed.startswith(str(ready / ".venv"))


@pytest.mark.parametrize("active", [False, True])
def test_changed_requirements_are_installed(ready, active):
    """After an update of the course the old .venv goes on without the new package; with .venv
    active, the start finds itself inside and does not look at requirements.txt.
    """
    (ready / "requirements.txt").write_text("pebble>=1.1\nstone>=1.0\n")
    ended = start(ready, "0", python=venv_python(ready) if active else sys.executable)
    assert (ended.status, len(ended.told)) == (0, 1)
    assert installed(ready) == ["pebble-1.2.dist-info", "stone-1.2.dist-info"]


def test_what_the_site_needs_is_installed_when_the_site_is_asked_for(ready):
    """Every student waits for the site's packages; or the site's first build misses them."""
    put(ready, {"site/requirements.txt": "stone>=1.0\n"})
    assert start(ready, "0").told == [] and "stone-1.2.dist-info" not in installed(ready)
    ended = start(ready, "0", "--site")
    assert (ended.status, len(ended.told)) == (0, 1)
    assert f"site{os.sep}requirements.txt" in ended.told[0]
    assert installed(ready) == ["pebble-1.2.dist-info", "stone-1.2.dist-info"]
    assert start(ready, "0", "--site", PIP_FIND_LINKS="nowhere").told == []


def test_a_set_up_that_was_cut_short_is_made_anew(ready, first):
    """A start that was killed leaves a .venv that fails for ever."""
    (ready / ".venv" / "requirements.txt").write_text("")
    (ready / ".venv" / "half a package").touch()
    pip = next((first[0] / ".venv").rglob("site-packages/pip"))
    fake(ready, "ensurepip",  # quicker than the real one
         "import shutil, sysconfig\n"
         f"shutil.copytree(r'{pip}', sysconfig.get_path('purelib') + '/pip')")
    ended = start(ready, "0", PYTHONPATH=str(ready / "fakes"))
    assert (ended.status, len(ended.told)) == (0, 1)
    assert installed(ready) == ["pebble-1.2.dist-info"]
    assert not (ready / ".venv" / "half a package").exists()


def test_without_network_the_sentence_holds_the_error_and_the_remedy(ready):
    """pip's fifty lines, or a traceback, or nothing; and the next start believes it is ready."""
    (ready / "requirements.txt").write_text("nobody-made-this\n")
    for _ in range(2):
        ended = start(ready, "0", python=venv_python(ready), PIP_NO_INDEX="", PIP_RETRIES="0",
                      PIP_TIMEOUT="1", PIP_INDEX_URL="http://127.0.0.1:9/simple")
        assert (ended.status, len(ended.told)) == (2, 2)
        assert "No matching distribution found for nobody-made-this" in ended.told[1]
        assert "check the network" in ended.told[1]


def test_a_venv_of_somebody_else_is_used_and_left_as_it_is(new):
    """It is deleted, or filled with our packages, or refused although it has everything."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", new / ".venv"], check=True)
    before = sorted((new / ".venv").rglob("*"))
    assert_refused(start(new, "0"), "it lacks pebble>=1.0): delete this folder")
    assert sorted((new / ".venv").rglob("*")) == before

    packages = next((new / ".venv").rglob("site-packages"))
    zipfile.ZipFile(new / "shelf" / "pebble-1.2-py3-none-any.whl").extractall(packages)
    ended = start(new, "0")
    assert (ended.status, ended.told) == (0, [])
    assert ended.printed.startswith(str(new / ".venv"))


def test_a_finished_venv_that_lost_a_package_does_not_start_itself_for_ever(ready):
    """The child finds the package missing, starts a child, which finds the package missing ..."""
    for package in (ready / ".venv").rglob("pebble-*"):
        shutil.rmtree(package)
    assert_refused(start(ready, "0"), "it lacks pebble>=1.0")


def test_a_venv_without_a_python_that_starts_is_not_deleted_unless_it_is_ours(new):
    """Whatever is called .venv is removed."""
    put(new, {".venv/diary.txt": "mine"})
    assert_refused(start(new, "0"), "does not start")
    assert (new / ".venv" / "diary.txt").exists()


@pytest.mark.parametrize("missing", ["venv", "ensurepip"])
def test_without_the_venv_module_the_sentence_names_the_system_package(new, missing):
    """Debian's Python has no ensurepip, and the sentence speaks of the network."""
    fake(new, missing, f"raise ModuleNotFoundError(\"No module named '{missing}'\")")
    ended = start(new, "0", PYTHONPATH=str(new / "fakes"))
    assert (ended.status, len(ended.told)) == (2, 2)
    assert f"No module named '{missing}'" in ended.told[1] and "apt install" in ended.told[1]


def test_an_environment_that_has_everything_just_runs(new):
    """A .venv is made in conda, too; or a version like 10.0 is taken for older than 9.0."""
    (new / "requirements.txt").write_text("pytest>=8.0\npytest-xdist>=3.6\nnumpy\n")
    ended = start(new, "0")
    assert (ended.status, ended.told) == (0, [])
    assert ended.printed.startswith(sys.prefix) and not (new / ".venv").exists()


def test_a_version_is_compared_by_its_numbers(module, monkeypatch):
    """As text, 10.0 comes before 9.0."""
    monkeypatch.setattr("importlib.metadata.version", {"old": "2.9", "new": "10.0rc1"}.get)
    module.REQUIREMENTS.write_text("# why\nnew>=9.1  # why\nnew>=10.0\n\nold>=2.10\nold\nbroken>=1")
    assert module.missing(module.REQUIREMENTS) == ["old>=2.10", "broken>=1"]


def test_an_old_python_gets_a_sentence(module, monkeypatch, capsys):
    """An old Python meets a word of Python 3.8 and shows a SyntaxError."""
    for file in ("__main__.py", "__init__.py"):
        ast.parse((COURSE / file).read_text("utf-8"), feature_version=(3, 6))
    monkeypatch.setattr(module.sys, "version_info", (3, 10, 13))
    assert module.main() == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and "needs Python 3.11 or newer" in told


@pytest.mark.parametrize(("number", "remedy"), [
    (errno.EROFS, "in which you may write"), (errno.EACCES, "in which you may write"),
    (errno.ENOSPC, "free 1 GB")])
def test_a_full_or_locked_disk_gets_a_sentence(module, monkeypatch, capsys, number, remedy):
    """The operating system's error becomes a traceback, or the advice to check the network."""
    def refuse(path):
        raise OSError(number, os.strerror(number), str(path))

    monkeypatch.setattr(module.Path, "mkdir", refuse)
    monkeypatch.setattr(module, "succeeds", lambda *_: False)
    assert module.main() == 2
    told = capsys.readouterr().err.splitlines()
    assert len(told) == 2 and remedy in told[1] and os.strerror(number) in told[1]


def test_uv_is_used_where_it_is_found(module, monkeypatch):
    """With uv there, pip is asked all the same, and takes a minute."""
    commands = []
    monkeypatch.setattr(module, "succeeds", lambda *command: command[0] == "uv")
    monkeypatch.setattr(module, "run_quietly", lambda *command: commands.append(command[:3]))
    module.set_up(module.REQUIREMENTS)
    assert commands == [("uv", "venv", "--allow-existing"), ("uv", "pip", "install")]
    assert module.COPY.read_text() == module.REQUIREMENTS.read_text()


if os.name == "posix":  # Ctrl-C as a terminal sends it: to the start and to what it started
    def interrupt(root, by=lambda child: os.killpg(child.pid, signal.SIGINT), **more):
        """Start, wait until the copy's file `reached` is there, interrupt: exit status, stderr."""
        child = subprocess.Popen([sys.executable, "-m", "course", "0"], cwd=root, text=True,
                                 stderr=subprocess.PIPE, env=surroundings(root, **more),
                                 start_new_session=True)
        patience = time.monotonic() + 60
        while not (root / "reached").exists():
            assert time.monotonic() < patience, "the start does not come so far"
            time.sleep(0.01)
        by(child)
        _, errors = child.communicate(timeout=60)
        return child.returncode, errors

    def test_ctrl_c_during_set_up_is_one_sentence_and_leaves_its_mark(new):
        """A traceback, or a half-made .venv that is taken for somebody else's or for ready."""
        fake(new, "venv", "import signal, time; from pathlib import Path\n"
                          "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
                          "Path('reached').touch(); time.sleep(1); Path('late').touch()")
        status, errors = interrupt(new, PYTHONPATH=str(new / "fakes"))
        assert status == 130
        assert errors.count("\n") == 2 and "interrupted" in errors.splitlines()[1]
        assert (new / ".venv" / "requirements.txt").read_text() == ""
        time.sleep(1.2)
        assert not (new / "late").exists(), "what was started goes on"

    def test_ctrl_c_is_left_to_the_command(ready):
        """The start dies first, and the command goes on printing over the prompt."""
        command(ready, "try: Path('reached').touch(); time.sleep(60)",
                "except KeyboardInterrupt: time.sleep(0.5); return 130")
        assert interrupt(ready) == (130, "")

    def test_a_command_that_was_killed_is_no_success(ready):
        """The child's exit status -9 becomes 0, or 247."""
        command(ready, "os.kill(os.getpid(), 9)")
        assert start(ready, "0").status == 128 + 9

    def test_ending_the_start_ends_the_command(ready):
        """A time limit's SIGTERM ends the start, and the command goes on without it."""
        command(ready, "Path('reached').touch(); time.sleep(60)")
        assert interrupt(ready, by=lambda child: child.terminate()) == (128 + 15, "")

    def command(root, *lines):
        """Let the copy's command do this."""
        body = "".join(f"    {line}\n" for line in lines)
        (root / "course" / "commands.py").write_text(
            f"import os, time\nfrom pathlib import Path\ndef main():\n{body}")
