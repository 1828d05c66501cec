"""Returns tuples of a class that claims to be another one, by a name that is no text."""
from typing import NamedTuple


class Forged(NamedTuple):
    command: str


Forged.__name__, Forged.__module__ = "system", "os"


def double(x):
    channel = CHANNEL
    of_class = channel.wire.name_of
    channel.wire.name_of = lambda named_tuple: [of_class(named_tuple)]
    return Forged("touch COURSE/forged"), Forged(Forged("exit"))
