"""NamedTuples as JSON between our own processes, and back with the types that they declare.

What comes from a submission never goes this way: that is wire.py's.
"""
import json
import typing


def dumps(value) -> str:
    return json.dumps(plain(value))


def plain(value):
    """NamedTuples as {field: value}, at every depth."""
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    return [plain(part) for part in value] if isinstance(value, tuple | list) else value


def loads(kind: type, text):
    """A value of this type. ValueError: the text is no JSON, or the JSON of something else."""
    try:
        return typed(kind, json.loads(text))
    except (TypeError, AttributeError, KeyError) as error:
        raise ValueError(f"this is no {kind.__name__}: {error}") from None


def typed(kind, value):
    """What `plain` made of a value of this type -> that value."""
    if hasattr(kind, "_fields"):
        types = typing.get_type_hints(kind)
        return kind(**{name: typed(types[name], part) for name, part in value.items()})
    inner = typing.get_args(kind)
    if type(None) in inner:
        return None if value is None else typed(inner[0], value)
    if typing.get_origin(kind) is dict:
        return {key: typed(inner[1], part) for key, part in value.items()}
    if typing.get_origin(kind) in (list, tuple):
        return typing.get_origin(kind)(typed(inner[0], part) for part in value)
    return kind(value) if kind in (list, tuple) else value
