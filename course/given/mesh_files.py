"""Triangle meshes from OBJ and PLY files, and into them.

trimesh reads the numbers. Left alone, it splits vertices at the seams of uv and normals, changes
the order of faces that have four corners, and takes many broken files for other meshes. So each
file goes through a door first: `_plain_obj` and `_plain_ply` refuse what is not whole, and hand on
its positions and triangles alone, as they stand there.

OBJ: Wavefront, "Advanced Visualizer Manual", appendix B1. PLY: Turk 1994, "The PLY polygon file
format".
"""
import io
import itertools
import re
import struct
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh

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
        plain = _plain_obj(content) if ending == "obj" else _plain_ply(content)
        vertices, faces = _parse(plain, ending)
        inputs.require_mesh(vertices, faces)
    except ValueError as error:
        raise ValueError(f"cannot read {path} as a mesh: {error}") from None
    return vertices, faces


def write(path, vertices, faces):
    """vertices, faces -> an OBJ file or a binary PLY file. `read` gives them back to the bit.

    trimesh would round: it writes float32 into a PLY and a fixed number of decimals into an OBJ.
    ValueError for a broken mesh or an unknown ending, OSError where the file cannot be written.
    """
    ending = _ending(path)
    inputs.require_mesh(vertices, faces)
    vertices, faces = np.asarray(vertices, np.float64), np.asarray(faces, np.int64)
    if ending == "obj":
        content = _obj(vertices.tolist(), (faces + 1).tolist())
    else:
        vertex = Element(len(vertices), [Property(axis, "double", None) for axis in "xyz"])
        content = _ply("binary_little_endian", vertex, vertices.astype("<f8").tobytes(), faces)
    places.write_whole(path, content)


def _ending(path):
    ending = Path(path).suffix.lower()
    if ending not in (".obj", ".ply"):
        raise ValueError(f"meshes are read and written as .obj or .ply, got {str(path)!r}: "
                         "give it one of these endings, or convert it")
    return ending[1:]


def _parse(plain, ending):
    """A plain file's content -> vertices, faces."""
    try:
        with np.errstate(over="ignore"):  # of a float, it is infinity, which `check` refuses
            whole = trimesh.load_mesh(io.BytesIO(plain), file_type=ending, process=False,
                                      maintain_order=True)
        return np.array(whole.vertices, np.float64), np.array(whole.faces, np.int64)
    except Exception:  # whatever the parser stumbles over
        raise ValueError(f"it is broken or of a rare kind, {AGAIN} as triangles") from None


def _fans(polygons):
    """The corners of each face, three or more -> triangles (F, 3) around the first of them."""
    lengths = set(map(len, polygons))
    if not lengths:
        raise ValueError(f"a mesh needs at least one face, got none: {AGAIN}, with its faces")
    if min(lengths) < 3:
        raise ValueError(f"expected faces of three or more corners, got {min(lengths)}: {AGAIN}")
    if lengths == {3}:
        return np.array(polygons)
    return np.array([(first, *pair) for first, *others in polygons
                     for pair in itertools.pairwise(others)])


# OBJ


def _plain_obj(content):
    """An OBJ's content -> the same with nothing but positions and triangles, counted from 1."""
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
    return _obj(positions, triangles.tolist())


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


def _obj(positions, triangles):
    """Rows of three numbers, rows of three corners counted from 1 -> an OBJ's content."""
    lines = [f"v {x} {y} {z}" for x, y, z in positions]
    lines += [f"f {a} {b} {c}" for a, b, c in triangles]
    return ("\n".join(lines) + "\n").encode()


# PLY


def _plain_ply(content):
    """A PLY's content -> the same with nothing but vertices and triangles."""
    form, elements, body = _header(content)
    rows = _ascii_rows if form == "ascii" else _binary_rows
    vertices, polygons = rows(elements, body, form)
    triangles = _fans(polygons)
    inputs.require_faces(triangles, elements["vertex"].count)
    return _ply(form, elements["vertex"], vertices, triangles)


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


def _ascii_rows(elements, body, form):
    """An ASCII PLY's rows -> those of its vertices, as they stand; the corners of its faces."""
    lines = re.split(r"[\r\n]+", body.decode("ascii", errors="replace"))
    rows = [line.strip() for line in lines if line.strip()]
    announced = sum(element.count for element in elements.values())
    if len(rows) != announced:
        raise ValueError(f"its header announces {announced} rows, but {len(rows)} follow: {AGAIN}")
    start = 0
    for name, (count, properties) in elements.items():
        block = rows[start:start + count]
        corners = [_ascii_corners(row, properties) for row in block]
        if name == "vertex":
            vertices = "".join(f"{row}\n" for row in block).encode()
        elif name == "face":
            polygons = corners
        start += count
    return vertices, polygons


def _ascii_corners(row, properties):
    """A row, which must have the numbers that are announced -> its corners, if it has any."""
    words, start, corners = row.split(), 0, []
    try:
        for p in properties:
            length = 1
            if p.length:
                length = int(words[start])
                start += 1
            if p.name in CORNERS:
                corners = [int(word) for word in words[start:start + length]]
            start += max(length, 0)
    except (ValueError, IndexError):
        start = None
    if start != len(words) or not all(map(REAL.fullmatch, words)):
        raise ValueError(f"the row {row[:60]!r} does not have the numbers that the header and the "
                         f"lengths of lists announce: {AGAIN}")
    return corners


def _binary_rows(elements, body, form):
    """A binary PLY's rows -> those of its vertices, as they stand; the corners of its faces."""
    start = 0
    try:
        for name, element in elements.items():
            corners, end = (_alike_corners(element, body, start, _order(form))
                            or _binary_corners(element, body, start, _order(form)))
            if name == "vertex":
                vertices = body[start:end]
            elif name == "face":
                polygons = corners
            start = end
    except struct.error:
        raise ValueError(f"it is cut short, or a list's length is wrong: {AGAIN}") from None
    if start > len(body) or body[start:].strip():
        raise ValueError(f"its header announces {start} bytes, but {len(body)} follow: {AGAIN}")
    return vertices, polygons


def _alike_corners(element, body, start, order):
    """`_binary_corners`, at once, of rows that are one list each, all of one length. Else None."""
    p = element.properties[0]
    if len(element.properties) > 1 or p.length not in ("uchar", "uint8") or start >= len(body):
        return None
    length, size = body[start], struct.calcsize(order + TYPES[p.type])
    step = 1 + length * size
    end = start + element.count * step
    if end > len(body) or set(body[start:end:step]) != {length}:
        return None
    corners = np.ndarray((element.count, length), order + TYPES[p.type], body, start + 1,
                         (step, size))
    return corners, end


def _binary_corners(element, body, start, order):
    """An element's rows, from start on -> the corners in each that has any, where the rows end."""
    codes = [TYPES[p.type] for p in element.properties]
    if not any(p.length for p in element.properties):
        return [], start + element.count * struct.calcsize(order + "".join(codes))
    polygons = []
    for _ in range(element.count):
        for p, code in zip(element.properties, codes, strict=True):
            length = 1
            if p.length:
                (length,) = struct.unpack_from(order + TYPES[p.length], body, start)
                start += struct.calcsize(order + TYPES[p.length])
            numbers = f"{order}{length}{code}"
            if p.name in CORNERS:
                polygons.append(struct.unpack_from(numbers, body, start))
            start += struct.calcsize(numbers)
    return polygons, start


def _order(form):
    return ">" if form == "binary_big_endian" else "<"


def _ply(form, vertex, rows, triangles):
    """A PLY's format, its vertex Element and its rows, triangles -> the PLY's content.

    Only x, y and z keep their names: trimesh would look at uv, normals and colours.
    """
    lines = ["ply", f"format {form} 1.0", f"element vertex {vertex.count}"]
    for k, (name, kind, _) in enumerate(vertex.properties):
        kind = "double" if form == "ascii" and kind in WHOLE else kind
        lines.append(f"property {kind} {name if name in ('x', 'y', 'z') else f'other_{k}'}")
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices"]
    if form == "ascii":
        corners = "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles.tolist()).encode()
    else:
        table = np.empty(len(triangles), [("length", "u1"), ("corners", f"{_order(form)}i4", 3)])
        table["length"] = 3
        table["corners"] = triangles
        corners = table.tobytes()
    return "\n".join([*lines, "end_header\n"]).encode() + rows + corners
