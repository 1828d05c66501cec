"""python3 -m course sets itself up: tried in real second processes, on a copy without the network.

The copy's command line is a stand-in that prints where it runs, and exits as it is told to.
"""
import ast
import os
import shutil
import signal
import subprocess
import sys
import zipfile
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import SimpleNamespace

import pytest
from afresh import wait_until
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


def surroundings(root):
    """The environment of a start: pip knows the shelf and no network."""
    ours = {key: text for key, text in os.environ.items() if not key.startswith(("PIP_", "PYTHON"))}
    return {**ours, "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": (root / "shelf").as_uri(),
            "PIP_CONFIG_FILE": os.devnull, "PYTHONPATH": str(root / "fakes")}


def start(root, *arguments, python=sys.executable, target=("-m", "course"), cwd=None):
    """One start to its end: exit status, what it printed, the course's own sentences."""
    ended = subprocess.run([python, *target, *arguments], cwd=cwd or root, text=True,
                           capture_output=True, timeout=200, env=surroundings(root))
    told = [line for line in ended.stderr.splitlines() if line.startswith("course: ")]
    return SimpleNamespace(status=ended.returncode, printed=ended.stdout, told=told,
                           errors=ended.stderr)


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


def test_the_first_start_says_two_lines_and_runs_the_command_in_a_new_venv(first):
    """The set-up is silent or chatty, the command runs outside, arguments are split at spaces."""
    root, ended = first
    assert ended.status == 0, ended.errors
    assert len(ended.told) == 2 and "installing requirements.txt into" in ended.told[1]
    assert ended.printed == f"{root / '.venv'} {['0', 'two words', '*']}\n"
    assert installed(root) == ["pebble-1.2.dist-info"]


@pytest.mark.parametrize("elsewhere", [False, True], ids=["in its folder", "by its path"])
def test_the_second_start_installs_nothing_and_passes_its_status_on(ready, tmp_path, elsewhere):
    """The finished .venv is not recognised, and every start costs a minute; a failed check exits 0,
    and CI sees green. Started as python3 /path/to/course, it does not find itself.
    """
    shutil.rmtree(ready / "shelf")
    where = {"target": [ready / "course"], "cwd": tmp_path} if elsewhere else {}
    ended = start(ready, "7", **where)
    assert (ended.status, ended.errors) == (7, "")
    assert ended.printed.startswith(str(ready / ".venv"))


@pytest.mark.parametrize("active", [False, True])
def test_changed_requirements_are_installed(ready, active):
    """After an update of the course the old .venv goes on without the new package; with .venv
    active, the start finds itself inside and does not look at requirements.txt.
    """
    (ready / "requirements.txt").write_text("pebble>=1.1\nstone>=1.0\n")
    ended = start(ready, "0", python=module(ready).PYTHON if active else sys.executable)
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


def test_a_venv_that_was_cut_short_is_made_anew(ready):
    """A start that was killed leaves a .venv that fails for ever."""
    (ready / ".venv" / "made_by_the_course").write_text("")
    (ready / ".venv" / "half a package").touch()
    ended = start(ready, "0")
    assert (ended.status, len(ended.told)) == (0, 2)
    assert installed(ready) == ["pebble-1.2.dist-info"]
    assert not (ready / ".venv" / "half a package").exists()


def test_what_cannot_be_installed_is_one_sentence_below_pips(ready):
    """A traceback, or nothing; and the next start believes it is ready."""
    (ready / "requirements.txt").write_text("nobody-made-this\n")
    for _ in range(2):
        ended = start(ready, "0")
        assert (ended.status, len(ended.told)) == (2, 2)
        assert "No matching distribution found for nobody-made-this" in ended.errors
        assert "pip failed, see above" in ended.told[1]


def test_a_venv_of_somebody_else_is_used_and_left_as_it_is(new):
    """It is deleted, or filled with our packages, or refused although it has everything."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", new / ".venv"], check=True)
    before = sorted((new / ".venv").rglob("*"))
    ended = start(new, "0")
    assert ended.status == 2 and len(ended.told) == 1 and "it lacks pebble>=1.0)" in ended.told[0]
    assert sorted((new / ".venv").rglob("*")) == before

    packages = next((new / ".venv").rglob("site-packages"))
    zipfile.ZipFile(new / "shelf" / "pebble-1.2-py3-none-any.whl").extractall(packages)
    ended = start(new, "0")
    assert (ended.status, ended.errors) == (0, "")
    assert ended.printed.startswith(str(new / ".venv"))


def test_a_folder_without_a_python_is_not_deleted_unless_it_is_ours(new):
    """Whatever is called .venv is removed."""
    put(new, {".venv/diary.txt": "mine"})
    ended = start(new, "0")
    assert ended.status == 2 and len(ended.told) == 1 and "is not ours" in ended.told[0]
    assert (new / ".venv" / "diary.txt").exists()


def test_an_environment_that_has_everything_just_runs(new):
    """A .venv is made in conda, too; or a version like 10.0 is taken for older than 9.0."""
    (new / "requirements.txt").write_text("pytest>=8.0\npytest-xdist>=3.6\nnumpy\n")
    ended = start(new, "0")
    assert (ended.status, ended.errors) == (0, "")
    assert ended.printed.startswith(sys.prefix) and not (new / ".venv").exists()


def module(root):
    """The start of a copy as a module of this process, for what cannot be had for real."""
    spec = spec_from_file_location("start", root / "course" / "__main__.py")
    made = module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


def test_a_version_is_compared_by_its_numbers(new, monkeypatch):
    """As text, 10.0 comes before 9.0."""
    monkeypatch.setattr("importlib.metadata.version", {"old": "2.9", "new": "10.0rc1"}.get)
    file = new / "requirements.txt"
    file.write_text("# why\nnew>=9.1  # why\nnew>=10.0\n\nold>=2.10\nold\nbroken>=1")
    assert module(new).missing(file) == ["old>=2.10", "broken>=1"]


def test_an_old_python_gets_a_sentence(new, monkeypatch, capsys):
    """An old Python meets a word of Python 3.8 and shows a SyntaxError."""
    for file in ("__main__.py", "__init__.py"):
        ast.parse((COURSE / file).read_text("utf-8"), feature_version=(3, 6))
    monkeypatch.setattr(sys, "version_info", (3, 10, 13))
    assert module(new).main() == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and "needs Python 3.11 or newer" in told


@pytest.mark.skipif(os.name != "posix", reason="Ctrl-C is sent as a terminal of POSIX sends it")
def test_ctrl_c_during_set_up_is_one_sentence_and_the_next_start_makes_the_venv_anew(new):
    """A traceback, or a half-made .venv that is taken for somebody else's or for ready."""
    put(new, {"fakes/venv.py": "import time; from pathlib import Path\n"
                               "Path('reached').touch(); time.sleep(60)"})
    child = subprocess.Popen([sys.executable, "-m", "course", "0"], cwd=new, text=True,
                             stderr=subprocess.PIPE, env=surroundings(new), start_new_session=True)
    wait_until((new / "reached").exists, "the start does not come so far")
    os.killpg(child.pid, signal.SIGINT)
    errors = child.communicate(timeout=60)[1]
    assert child.returncode == 130 and "interrupted" in errors.splitlines()[-1]
    assert (new / ".venv" / "made_by_the_course").read_text() == ""
