"""Triangle meshes from OBJ and PLY files, and into them.

Libraries split vertices at the seams of uv and normals, change the order of faces that have four
corners, round, or take a broken file for another mesh. Here a mesh is read as it stands in its
file, and a file that is not whole is refused.

OBJ: Wavefront, "Advanced Visualizer Manual", appendix B1. PLY: Turk 1994, "The PLY polygon file
format".
"""
import itertools
import re
import struct
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import inputs, places

REAL = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)(e[-+]?\d+)?|[-+]?(nan|inf|infinity)",
                  re.IGNORECASE | re.ASCII)
CORNER = re.compile(r"[-+]?[1-9]\d{0,17}(/\S*)?", re.ASCII)  # an OBJ's, of a face

WHOLE = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
         "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I"}
TYPES = WHOLE | {"float": "f", "double": "d", "float32": "f", "float64": "d"}  # PLY's and struct's
CORNERS = ("vertex_indices", "vertex_index")  # either may be the name of a face's list
HEADER = re.compile(rb"ply[ \t]*\r?\n(.*?)^end_header[ \t]*(\r?\n|\Z)", re.DOTALL | re.MULTILINE)
HEADER_LINE = re.compile(
    r"format (?P<form>ascii|binary_little_endian|binary_big_endian) 1\.0|"
    r"element (?P<element>\S+) (?P<count>\d{1,18})|"
    rf"property (list (?P<length>{'|'.join(WHOLE)}) )?(?P<type>{'|'.join(TYPES)}) (?P<name>\S+)|"
    r"((comment|obj_info)\b.*)?", re.ASCII)
AGAIN = "export the file again"


class Property(NamedTuple):
    """A number in each row of a PLY's element, or a list of numbers. The types are PLY's."""

    name: str
    type: str
    length: str | None  # the type of a list's length


class Element(NamedTuple):
    """A PLY's table: its vertices, its faces."""

    count: int
    properties: list


def read(path):
    """An OBJ or PLY file -> vertices (V, 3) float64, faces (F, 3) int64.

    Vertices and faces keep the file's order. Its uv, normals and colours are left out. A face of
    more than three corners becomes a fan of triangles around its first, right for convex faces.
    FileNotFoundError or OSError for a file that cannot be opened, ValueError for one that is no
    whole mesh.
    """
    ending = _ending(path)
    content = places.read_whole(path)
    try:
        vertices, faces = _read_obj(content) if ending == "obj" else _read_ply(content)
        inputs.require_mesh(vertices, faces)
    except ValueError as error:
        raise ValueError(f"cannot read {path} as a mesh: {error}") from None
    return vertices, faces


def write(path, vertices, faces):
    """vertices, faces -> an OBJ file or a binary PLY file. `read` gives them back to the bit.

    ValueError for a broken mesh or an unknown ending, OSError where the file cannot be written.
    """
    ending = _ending(path)
    inputs.require_mesh(vertices, faces)
    vertices, faces = np.asarray(vertices, np.float64), np.asarray(faces, np.intp)
    content = _obj(vertices, faces) if ending == "obj" else _ply(vertices, faces)
    places.write_whole(path, content)


def _ending(path):
    ending = Path(path).suffix.lower()
    if ending not in (".obj", ".ply"):
        raise ValueError(f"meshes are read and written as .obj or .ply, got {str(path)!r}: "
                         "give it one of these endings, or convert it")
    return ending[1:]


def _fans(polygons):
    """The corners of each face, three or more -> triangles (F, 3) around the first of them."""
    if len(polygons) == 0:
        raise ValueError(f"a mesh needs at least one face, got none: {AGAIN}, with its faces")
    if isinstance(polygons, np.ndarray):
        lengths = {polygons.shape[1]}
    else:
        lengths = set(map(len, polygons))
    if min(lengths) < 3:
        raise ValueError(f"expected faces of three or more corners, got {min(lengths)}: {AGAIN}")
    if lengths == {3}:
        return np.array(polygons)
    return np.array([(first, *pair) for first, *others in polygons
                     for pair in itertools.pairwise(others)])


# OBJ


def _read_obj(content):
    """An OBJ's content -> vertices, faces."""
    text = re.sub(r"\\\r?\n", " ", content.decode("utf-8-sig", errors="replace"))
    positions, polygons = [], []
    for line in re.split(r"[\r\n]+", text):
        kind, *words = line.partition("#")[0].split() or [""]
        if kind in ("v", "f"):
            _require_words(line, words, REAL if kind == "v" else CORNER)
        if kind == "v":
            positions.append(words[:3])
        elif kind == "f":
            polygons.append([_vertex(word, len(positions)) for word in words])
    triangles = _fans(polygons)
    highest = triangles.max()
    if highest > len(positions):
        raise ValueError(f"a face names vertex {highest}, but the file has {len(positions)}: "
                         f"{AGAIN}")
    return np.array(positions, np.float64), triangles - 1


def _require_words(line, words, pattern):
    if len(words) < 3 or not all(map(pattern.fullmatch, words)):
        raise ValueError(f"the line {line.strip()[:60]!r} is neither v and three coordinates nor "
                         "f and three or more vertex indices, which count from 1 or back from -1: "
                         f"mend it, or {AGAIN}")


def _vertex(corner, vertex_count):
    """A corner such as 3/1/2 -> its vertex, here 3. -1 is the last vertex so far."""
    vertex = int(corner.partition("/")[0])
    if vertex < -vertex_count:
        raise ValueError(f"a face names vertex {vertex}, but only {vertex_count} stand before it: "
                         f"{AGAIN}")
    return vertex if vertex > 0 else vertex_count + 1 + vertex


def _obj(vertices, faces):
    """vertices, faces -> an OBJ's content."""
    lines = [f"v {x} {y} {z}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
    return ("\n".join(lines) + "\n").encode()


# PLY


def _read_ply(content):
    """A PLY's content -> vertices, faces."""
    form, elements, body = _header(content)
    if form == "ascii":
        tables = _ascii_tables(elements, body)
    else:
        tables = _binary_tables(elements, body, ">" if form == "binary_big_endian" else "<")
    axes = [_reals(tables["vertex"][p.name], p.type) for axis in "xyz"
            for p in elements["vertex"].properties if p.name == axis]
    polygons = next(tables["face"][name] for name in CORNERS if name in tables["face"])
    triangles = _fans(polygons)
    inputs.require_faces(triangles, elements["vertex"].count)
    return np.stack(axes, axis=1), triangles.astype(np.intp)


def _reals(column, type):
    """A column of numbers or words -> float64. A float's digits beyond float32 are dropped."""
    with np.errstate(over="ignore"):  # infinity, which `read` refuses
        return np.ravel(column).astype("f4" if TYPES[type] == "f" else "f8").astype(np.float64)


def _header(content):
    """A PLY's content -> its format, its elements by name, and the bytes that follow."""
    header = HEADER.match(content)
    if not header:
        raise ValueError("expected a PLY, which begins with the line ply and a header up to the "
                         f"line end_header, got neither: {AGAIN}")
    forms, elements = [], {}
    for line in header[1].decode("ascii", errors="replace").split("\n"):
        part = HEADER_LINE.fullmatch(" ".join(line.split()))
        if not part or part["element"] in elements or (part["name"] and not elements):
            raise ValueError(f"the line {line.strip()[:60]!r} does not belong in the header of a "
                             f"PLY 1.0, or not there: {AGAIN}")
        if part["form"]:
            forms.append(part["form"])
        elif part["element"]:
            properties = []
            elements[part["element"]] = Element(int(part["count"]), properties)
        elif part["name"]:
            properties.append(Property(part["name"], part["type"], part["length"]))
    _require_mesh(forms, elements)
    return forms[0], elements, content[header.end():]


def _require_mesh(forms, elements):
    """Does a PLY's header announce what a mesh needs, each of it once?"""
    vertex, face = (elements.get(name, Element(0, [])).properties for name in ("vertex", "face"))
    corners = [p for p in face if p.name in CORNERS]
    fits = [len(forms) == 1,
            sum(p.name in ("x", "y", "z") for p in vertex) == 3,
            not any(p.length for p in vertex),
            len(corners) == 1 and corners[0].length and corners[0].type in WHOLE]
    for _, properties in elements.values():
        fits.append(0 < len(properties) == len({p.name for p in properties}))
    if not all(fits):
        raise ValueError("its header must name one format, a vertex of single numbers with x, y "
                         "and z, a face with a list vertex_indices of integers, and no property "
                         f"twice: {AGAIN}")


def _ascii_tables(elements, body):
    """An ASCII PLY's rows -> for each element, its columns by name. A number is a list of one."""
    lines = re.split(r"[\r\n]+", body.decode("ascii", errors="replace"))
    rows = [line.strip() for line in lines if line.strip()]
    announced = sum(element.count for element in elements.values())
    if len(rows) != announced:
        raise ValueError(f"its header announces {announced} rows, but {len(rows)} follow: {AGAIN}")
    tables, rows = {}, iter(rows)
    for name, (count, properties) in elements.items():
        fields = [_fields(row, properties) for row in itertools.islice(rows, count)]
        columns = zip(*fields, strict=True) if fields else [[]] * len(properties)
        tables[name] = {p.name: column for p, column in zip(properties, columns, strict=True)}
    return tables


def _fields(row, properties):
    """A row, which must have the numbers that are announced -> for each property a list of them."""
    words, start, fields = row.split(), 0, []
    try:
        for p in properties:
            length = 1
            if p.length:
                length = int(words[start])
                start += 1
            field = words[start:start + length]
            fields.append([int(word) for word in field] if p.name in CORNERS else field)
            start += max(length, 0)
    except (ValueError, IndexError):
        start = None
    if start != len(words) or not all(map(REAL.fullmatch, words)):
        raise ValueError(f"the row {row[:60]!r} does not have the numbers that the header and the "
                         f"lengths of lists announce: {AGAIN}")
    return fields


def _binary_tables(elements, body, order):
    """A binary PLY's rows -> for each element, its columns by name."""
    tables, start = {}, 0
    try:
        for name, element in elements.items():
            tables[name], start = _columns(element, body, start, order)
    except struct.error:
        raise ValueError(f"it is cut short, or a list's length is wrong: {AGAIN}") from None
    if body[start:].strip():
        raise ValueError(f"its header announces {start} bytes, but {len(body)} follow: {AGAIN}")
    return tables


def _columns(element, body, start, order):
    """An element's rows, from start on -> its columns by name, where the rows end."""
    columns = {p.name: [] for p in element.properties}
    for _ in range(element.count):
        for name, type, length_type in element.properties:
            length = 1
            if length_type:
                length, = struct.unpack_from(order + TYPES[length_type], body, start)
                start += struct.calcsize(order + TYPES[length_type])
            numbers = f"{order}{length}{TYPES[type]}"
            columns[name].append(struct.unpack_from(numbers, body, start))
            start += struct.calcsize(numbers)
    return columns, start


def _ply(vertices, faces):
    """vertices, faces -> a binary PLY's content."""
    axes = "".join(f"property double {axis}\n" for axis in "xyz")
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n{axes}"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    rows = np.empty(len(faces), [("length", "u1"), ("corners", "<i4", 3)])
    rows["length"] = 3
    rows["corners"] = faces
    return header.encode() + vertices.astype("<f8").tobytes() + rows.tobytes()
