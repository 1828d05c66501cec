"""Values to bytes and back, and bytes that no honest worker sends."""
import json
import sys
from typing import NamedTuple

import numpy as np
import pytest

from labkit.grading.apart import wire


class Paint(NamedTuple):
    colours: np.ndarray
    name: str = "white"


KNOWN = wire.named_tuples([sys.modules[__name__]])


@pytest.mark.parametrize("value", [
    None, True, -3, 10**20, 0.1, np.pi, float("inf"), "", "é\n", 1 + 2j, (), (1, (2.0,)), [],
    [1, [2]], {"eps": 0.5}, np.float64(0.1), np.int32(-7), np.bool_(True), np.zeros((0, 3)),
    np.arange(6.0).reshape(2, 3), np.arange(6, dtype=">i4")[::-1], np.ones((2, 2), bool),
    np.array(1.5), np.array([np.nan, -0.0]), np.ones(2, np.float32), np.ones((2, 2), complex).T,
    (np.zeros(2), [np.ones(1)], {"a": np.int8(1)}),
    Paint(np.eye(2)), (1, [Paint(Paint(None), ("a", Paint(1.0)))]),
], ids=repr)
def test_what_is_sent_arrives_to_the_bit(value):
    """A shape, a kind or a sign is lost; a tuple comes as a list, a NamedTuple without names."""
    with np.printoptions(floatmode="unique"):
        came = repr(wire.decode(wire.encode(value), KNOWN))
        assert came == repr(value).replace("dtype='>i4'", "dtype=int32")


def test_numbers_count_wherever_they_are_sent():
    """Numbers in the header are free, or a header that claims to be longer than it is gives some
    back: a submission asks the reference without end.
    """
    numbers = np.arange(1000.0)
    assert wire.size(wire.encode(numbers)) == 8 + numbers.nbytes
    assert wire.size(wire.encode(numbers.tolist())) > 3 * numbers.size
    assert wire.size(b"\xff" * 4 + bytes(100)) >= 8


@pytest.mark.parametrize(("value", "name"), [
    ((x for x in ()), "generator"), (object(), "object"), ({1: 2}, "dict"), ({1}, "set"),
    (np.array([None]), "ndarray of object"), (np.zeros(1, "f8,i4"), "ndarray of void96")])
def test_what_cannot_be_sent_arrives_as_its_type_s_name(value, name):
    """An object is sent as it is, as a pickle, or its repr runs."""
    came = wire.decode(wire.encode((value,)))[0]
    assert type(came).__name__ == name and isinstance(came, wire.Other)


def test_arrays_that_arrive_are_plain_and_can_be_changed():
    """A subclass comes back, or the numbers belong to the message."""
    class Mine(np.ndarray):
        pass

    came = wire.decode(wire.encode(np.zeros(3).view(Mine)))
    came += 1
    assert type(came) is np.ndarray and came.tolist() == [1, 1, 1]


def frame(header, rest=b""):
    content = header if isinstance(header, bytes) else json.dumps(header).encode()
    return len(content).to_bytes(4, "big") + content + rest


@pytest.mark.parametrize("payload", [
    b"", b"\0", b"\0\0\0\x02", frame(b"["), frame(b"\xff"), frame(b"1") + b"more",
    (1 << 31).to_bytes(4, "big") + b"1",
    frame(b"[" * 100_000), frame(b"9" * 5000),
    frame({}), frame({"a": 1, "b": 2}), frame({"unknown": 1}), frame({"tuple": 3}),
    frame({"array": 3}), frame({"array": ["<f8"]}), frame({"array": ["<f8", [2]]}, bytes(8)),
    frame({"array": ["<f8", [1]]}, bytes(16)), frame({"array": ["|O", [1]]}, bytes(8)),
    frame({"array": ["<f8", [-1]]}, bytes(8)), frame({"array": ["<f8", [True]]}, bytes(8)),
    frame({"array": ["<f8", [1.0]]}, bytes(8)), frame({"array": ["<f8", "1"]}, bytes(8)),
    frame({"array": ["<f8", [10**6] * 3]}), frame({"array": ["<f8", [0, 10**30]]}),
    frame({"array": ["<f8", [1 << 23, 0]]}), frame({"array": ["<f8", [0, 1 << 12, 1 << 12]]}),
    frame({"array": ["<f8", [1] * 100]}, bytes(8)), frame({"array": [["<f8"], [1]]}, bytes(8)),
    frame({"complex": "ab"}), frame({"dict": [1]}),
    frame({"named": 3}), frame({"named": []}), frame({"named": ["test_wire.Paint"]}),
    frame({"named": ["test_wire.Paint", [1, 2]]}), frame({"named": ["test_wire.Paint", "ab"]}),
    frame({"named": [["test_wire.Paint"], {"a": 1}]}), frame({"named": [{}, {}]}),
    frame({"named": ["a", {}, {}]}), frame({"named": ["a", {"b": {"unknown": 1}}]}),
], ids=lambda payload: repr(payload[:40]))
def test_other_bytes_are_garbled(payload):
    """Bytes from outside end in another error, in much memory, or in an array that is none."""
    with pytest.raises(wire.Garbled):
        wire.decode(payload, KNOWN)


@pytest.mark.parametrize(("name", "fields"), [
    ("test_wire.Paint", ["colours"]), ("test_wire.Paint", ["colours", "name", "more"]),
    ("test_wire.Paint", ["name", "colours"]), ("test_wire.Paint", ["colours", "__class__"]),
    ("test_wire.Paint", []), ("other.Paint", ["colours", "name"]), ("Paint", ["colours", "name"]),
    ("test_wire.NamedTuple", ["typename"]), ("builtins.eval", ["source"]), ("__class__", []),
    ("subprocess.Popen", ["args"]), ("\ud800", ["a"]), (None, ["a"]), (1, ["a"])])
def test_what_the_receiver_does_not_know_is_a_plain_tuple(name, fields):
    """A class that a submission names, or whose fields it changed, is made here: too few values
    break the grader, another class runs.
    """
    sent = frame({"named": [name, {field: place for place, field in enumerate(fields)}]})
    came = wire.decode(sent, KNOWN)
    assert type(came) is tuple and came == tuple(range(len(fields)))


def test_the_table_has_a_module_s_own_named_tuples_alone():
    """What a module imports can be made, too, or any class that it has."""
    assert KNOWN == {"test_wire.Paint": Paint}
    assert type(wire.decode(wire.encode(Paint(1)))) is tuple, "without a table nothing is made"


def test_random_bytes_give_values_or_garbled():
    """A parser that stumbles over one byte of an honest payload."""
    rng = np.random.default_rng(0)
    value = "returned", np.arange(4.0), [True], {"a": "b"}, 1j, Paint(0)
    payload = bytearray(wire.encode(value))
    for _ in range(3000):
        changed = payload.copy()
        for place in rng.integers(0, len(payload), rng.integers(1, 4)):
            changed[place] = rng.integers(0, 256)
        try:
            wire.decode(bytes(changed), KNOWN)
        except wire.Garbled:
            pass


@pytest.mark.parametrize(("payload", "came"), [
    (wire.encode(np.array([["a", "b"]])), [["a", "b"]]), (frame(b'"\\ud800"'), "?"),
    (frame({"array": ["|b1", [3]]}, b"\0\1\2"), np.array([False, True, True]))],
    ids=["an array of strings", "a lone surrogate", "a byte 2"])
def test_what_arrives_is_of_use(payload, came):
    """Names that an exercise returns are lost on their way; every report fails that holds a lone
    surrogate; a byte 2 makes a boolean that is neither, and comparisons go wrong.
    """
    found = wire.decode(payload)
    assert repr(found) == repr(came) and np.asarray(found).tobytes() == np.asarray(came).tobytes()


def test_frames_end_where_they_say():
    """A frame that is not all there is read, or one that is too large is waited for."""
    framed = wire.framed(b"abc")
    assert [wire.complete(bytearray(framed[:n])) for n in (0, 7, 8, 10)] == [0] * 4
    assert wire.complete(bytearray(framed + b"more")) == len(framed) == 11
    with pytest.raises(wire.Garbled):
        wire.complete(bytearray((1 << 62).to_bytes(8, "big")))


def test_what_is_too_large_is_not_sent():
    """A worker sends a gigabyte, or the grader does."""
    with pytest.raises(ValueError, match="allowed"):
        wire.encode(np.zeros(wire.MOST_BYTES // 8 + 1))
    with pytest.raises(ValueError, match="allowed"):
        wire.encode("x" * (wire.MOST_HEADER + 1))
