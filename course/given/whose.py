"""Whose code does the work: the reference's, or a student's own in labs/."""
import contextlib
import importlib

from labkit import places
from labkit.contract import UNFINISHED


class Lacking(ValueError):
    """A module cannot be imported, an exercise is not written, or a program of others needs more
    than there is: what, in one sentence.
    """


class Labs:
    """The labs' modules of one package, loaded when first used. Lacking: one cannot be.

    package: labs or reference; without, reference if it has all that labs/ has.
    """

    def __init__(self, package=None):
        self.package = package or preferred()

    def __getattr__(self, topic):
        if topic.startswith("_"):
            raise AttributeError(topic)
        try:
            module = vars(self)[topic] = importlib.import_module(f"{self.package}.{topic}")
            return module
        except (ImportError, SyntaxError) as error:
            raise Lacking(lacking(self.package, topic, error)) from None


def lacking(package, topic, error):
    """What is wrong with a topic's module, or with one that it imports."""
    if isinstance(error, SyntaxError) and error.filename:  # a zero byte has no place
        return (f"{places.shown_path(error.filename)}, line {error.lineno}: this is not Python "
                f"({error.msg}); mend it first")
    if isinstance(error, ModuleNotFoundError) and error.name.partition(".")[0] == package:
        module = error.name.partition(".")[2] or topic
        return f"{package}/{module}.py is not in this copy of the course"
    return f"{package}/{topic}.py, or what it imports, cannot be imported: {error}"


def preferred():
    """reference, if it has all that labs/ has, as in all copies but a hand-out; else labs."""
    labs, reference = ({path.name for path in places.ROOT.glob(f"{package}/*.py")}
                       for package in ("labs", "reference"))
    whole = labs <= reference or not places.is_handout()  # the rest is one's own
    return "reference" if reference and whole else "labs"


@contextlib.contextmanager
def exercises_named():
    """What an exercise that is not written raises becomes Lacking."""
    try:
        yield
    except NotImplementedError as error:
        match = UNFINISHED.fullmatch(str(error))
        if not match:
            raise
        raise Lacking(f"exercise {match[1]}, {match[2]}, is not written yet; "
                      f"python3 -m course check {match[1]} shows where its question is") from None
