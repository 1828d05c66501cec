"""Where things lie: the course's folder, its data, its output. Files are read and written whole."""
import contextlib
import functools
import os
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
OUT = "out"  # in ROOT, or the path of another folder


def is_handout():
    """Whether this copy of the course is a student's: one that cannot be handed out again."""
    return not (ROOT / "labkit" / "grading" / "handing" / "handout.py").exists()


def out(*parts):
    """out("demo", "bunny.png") -> the path ROOT/out/demo/bunny.png, its folder made.

    OSError where that folder cannot be written.
    """
    path = ROOT.joinpath(OUT, *parts)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        writable = os.access(path.parent, os.W_OK)
    except OSError:
        writable = False
    if not writable:
        raise OSError(f"cannot write into the folder {path.parent}: "
                      "allow writing there, or copy the course to a folder of your own")
    return path


def check_picture(name):
    """The path for a picture of the check that runs now, or of this name where none runs.

    Pytest tells which check it is: out/checks/rasterization_one_triangle_on_paper.png.
    """
    running = os.environ.get("PYTEST_CURRENT_TEST", "").removesuffix(" (call)")
    file, _, test = running.rpartition("::")
    words = f"{Path(file).stem}_{test}".replace("test_", "", 2) if running else name
    return out("checks", f"{re.sub(r'[^0-9A-Za-z]+', '_', words).strip('_')[:120]}.png")


def shown_path(path):
    """A path as seen from the course's folder, if it lies there."""
    path = Path(path).resolve()
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)


def read_whole(path):
    """The file's bytes. FileNotFoundError or OSError, in one sentence."""
    try:
        return Path(path).read_bytes()
    except ValueError:
        raise OSError(f"cannot read {str(path)!r}: no file can have such a name") from None
    except FileNotFoundError:
        raise FileNotFoundError(f"there is no file {path}: check its name, and the folder "
                                f"you are in ({Path.cwd()})") from None
    except OSError as error:
        raise OSError(f"cannot read {path} ({error.strerror}): "
                      "give the name of a file that you may read") from None


def write_whole(path, content, mode=0o666):
    """Bytes -> the file, all or nothing: written beside it, then moved there. OSError if not.

    mode: who may read and write it, as in open, less what the system keeps back.
    """
    path = Path(path)
    neighbour = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with open(neighbour, "wb", opener=functools.partial(os.open, mode=mode)) as file:
            file.write(content)
        os.replace(neighbour, path)
    except OSError as error:
        raise OSError(f"cannot write {path} ({error.strerror}): "
                      "name a file in a folder that is there and that you may write to") from None
    finally:
        with contextlib.suppress(OSError):
            neighbour.unlink()
