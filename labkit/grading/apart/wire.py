"""Values as bytes between the grader and a worker: numbers, strings, arrays, and what holds them.

A frame is the payload's length in 8 bytes, then the payload: the header's length in 4 bytes, the
header in JSON, then the arrays' numbers one after another, little-endian. Nothing is pickled, and
`decode` believes nothing: whatever the bytes are, it returns plain values or raises Garbled. A
NamedTuple is made anew from `named_tuples`, the table of those that the receiver itself has, where
name and fields are the same. Else it comes as a plain tuple.

    None, True, 1, 0.5, "a", [...]      as in JSON
    (...)                               {"tuple": [...]}
    pipeline.Colours(colours=...)       {"named": ["pipeline.Colours", {"colours": ...}]}
    {"a": 1}                            {"dict": {"a": 1}}
    1j                                  {"complex": [0.0, 1.0]}
    array (2, 3) of float64             {"array": ["<f8", [2, 3]]}
    np.float64(0.5)                     {"number": ["<f8", []]}
    anything else                       {"other": "generator"}, the name of its type
"""
import json
import math

import numpy as np

MOST_BYTES = 1 << 24   # of a payload: twice what any exercise returns
MOST_HEADER = 1 << 22  # of it
MOST_ANSWER = 1 << 17  # of the header of a worker's answer, where numbers are in arrays
MOST_NUMBERS = 1 << 21  # of all arrays in a payload: twice what any exercise takes or returns
MOST_AXES = 8           # of an array: twice as many
MOST_EMPTY = 1 << 16    # rows of an array without numbers
USUAL = 300            # bytes of a header that holds no numbers
DTYPES = {name: np.dtype(name) for name in
          "|b1 |i1 |u1 <i2 <u2 <f2 <i4 <u4 <f4 <i8 <u8 <f8 <c8 <c16".split()}


class Garbled(ValueError):
    """Bytes that no honest worker sends."""


class Other:
    """What stands for a value that cannot be sent: all that is known is the name of its type."""

    def __repr__(self):
        return f"<{type(self).__name__}>"


def named_tuples(modules):
    """{"pipeline.Colours": the class}: the NamedTuples that are defined in these modules."""
    return {name_of(found): found for module in modules for found in vars(module).values()
            if isinstance(found, type) and issubclass(found, tuple) and hasattr(found, "_fields")
            and found.__module__ == module.__name__}


def name_of(named_tuple):
    """reference.pipeline.Colours, or that of labs -> "pipeline.Colours"."""
    return f"{named_tuple.__module__.rpartition('.')[2]}.{named_tuple.__name__}"


def framed(payload) -> bytes:
    return len(payload).to_bytes(8, "big") + payload


def complete(buffer) -> int:
    """The length of the frame that a buffer begins with, or 0 where it is not all there yet."""
    length = 8 + int.from_bytes(buffer[:8], "big")
    if len(buffer) >= 8 and length > MOST_BYTES:
        raise Garbled(f"a frame of {length} bytes; {MOST_BYTES} are allowed")
    return length if 8 <= length <= len(buffer) else 0


def encode(value) -> bytes:
    """A value -> its payload. ValueError: it is too large."""
    arrays = []
    header = json.dumps(described(value, arrays)).encode("ascii")
    payload = b"".join([len(header).to_bytes(4, "big"), header, *arrays])
    if len(header) > MOST_HEADER or len(payload) > MOST_BYTES:
        raise ValueError(f"the values take {len(payload)} bytes; {MOST_BYTES} are allowed, "
                         f"{MOST_HEADER} of them outside of arrays")
    return payload


def described(value, arrays):
    """What stands for a value in the header. Its numbers go to the end of arrays."""
    if isinstance(value, np.ndarray | np.generic):
        return described_array(value, arrays)
    if value is None:
        return None
    for plain in bool, int, float, str:
        if isinstance(value, plain):
            return plain(value)  # without what a subclass adds
    if isinstance(value, complex):
        return {"complex": [value.real, value.imag]}
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        parts = [described(part, arrays) for part in value]
        return {"named": [name_of(type(value)), dict(zip(value._fields, parts, strict=True))]}
    if isinstance(value, tuple):
        return {"tuple": [described(part, arrays) for part in value]}
    if isinstance(value, list | range):
        return [described(part, arrays) for part in value]
    if isinstance(value, dict) and all(isinstance(key, str) for key in value):
        return {"dict": {str(key): described(part, arrays) for key, part in value.items()}}
    return {"other": type(value).__name__}


def described_array(value, arrays):
    array = np.asarray(value)
    if array.dtype.kind == "U":
        return described(array.tolist(), arrays)
    name = array.dtype.str.replace(">", "<")
    if name not in DTYPES:
        return {"other": f"{type(value).__name__} of {array.dtype.name}"}
    arrays.append(array.astype(name, copy=False).tobytes())
    return {"array" if isinstance(value, np.ndarray) else "number": [name, array.shape]}


def size(payload) -> int:
    """The bytes of the numbers in a payload, and 8 for itself. Numbers in its header count, too."""
    header = min(int.from_bytes(payload[:4], "big"), len(payload) - 4)
    return 8 + len(payload) - 4 - header + max(0, header - USUAL)


def decode(payload, named=None, most_header=MOST_HEADER):
    """A payload -> the value, its arrays' numbers copied. Garbled: it is not one.

    named: the table of `named_tuples`. Without one, all tuples are plain.
    """
    try:
        start = 4 + int.from_bytes(payload[:4], "big")
        if start > 4 + most_header:
            raise Garbled(f"a header of {start} bytes")
        header, rest = json.loads(payload[4:start]), [memoryview(payload)[start:], MOST_NUMBERS]
        value = built(header, rest, named or {})
    except Garbled:
        raise
    except (ValueError, TypeError, AttributeError, RecursionError, MemoryError,
            OverflowError) as error:  # its text can hold what was sent
        raise Garbled(type(error).__name__) from None
    if rest[0]:
        raise Garbled(f"{len(rest[0])} bytes too many")
    return value


def built(header, rest, named):
    """The value that a header describes. Its numbers are taken from the front of rest[0], no more
    than rest[1] of them.
    """
    if isinstance(header, str):
        return header.encode("utf-8", "replace").decode("utf-8")  # no lone surrogates
    if isinstance(header, list):
        return [built(part, rest, named) for part in header]
    if not isinstance(header, dict):
        return header
    (kind, content), = header.items()
    return built_kind(kind, content, rest, named)


def built_kind(kind, content, rest, named):
    """A value that is none of JSON's own."""
    if kind == "tuple":
        return tuple(built(list(content), rest, named))
    if kind == "named":
        return built_named(*content, rest, named)
    if kind == "dict":
        return {built(key, rest, named): built(part, rest, named) for key, part in content.items()}
    if kind == "complex":
        return complex(*map(float, content))
    if kind == "array":
        return built_array(*content, rest)
    if kind == "number":
        return built_array(*content, rest)[()]
    if kind == "other":
        return built_other(content)
    raise Garbled("a value of an unknown kind")


def built_named(name, fields, rest, named):
    """One of the table, if it has that name and these fields. Else a plain tuple."""
    parts = built(list(fields.values()), rest, named)
    known = named.get(name)
    return known(*parts) if known and known._fields == tuple(fields) else tuple(parts)


def built_other(name):
    """What stands for a value that could not be sent."""
    printable = "".join(c for c in str(name)[:60] if c.isprintable())
    return type(printable or "object", (Other,), {})()


def built_array(name, shape, rest):
    """The shape is believed only if the bytes are there."""
    dtype = DTYPES.get(name)
    if dtype is None or not all(type(n) is int and 0 <= n <= MOST_BYTES for n in shape):
        raise Garbled("an array of a wrong type or shape")
    if math.prod(max(n, 1) for n in shape) > max(math.prod(shape), MOST_EMPTY):
        raise Garbled("an array of too many rows without numbers")
    if len(shape) > MOST_AXES:
        raise Garbled(f"an array of {len(shape)} axes; {MOST_AXES} are allowed")
    size = dtype.itemsize * math.prod(shape)
    if size > len(rest[0]):
        raise Garbled("an array with fewer bytes than its shape says")
    rest[1] -= math.prod(shape)
    if rest[1] < 0:
        raise Garbled(f"more than {MOST_NUMBERS:,} numbers")
    content, rest[0] = rest[0][:size], rest[0][size:]
    if name == "|b1":  # any byte but 0 is True
        return np.frombuffer(content, np.uint8).astype(bool).reshape(shape)
    return np.frombuffer(content, dtype).astype(dtype.newbyteorder("=")).reshape(shape)


def arrays_in(value):
    """The arrays of a value, in order: those that a function could change in place."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple | list):
        for part in value:
            yield from arrays_in(part)
