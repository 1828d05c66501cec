"""Meshes with texture cubes from Wavefront's .obj files, and back.

Vertices and faces are numbered as in the file, so trimesh, which numbers anew, does not read them.
"""
import itertools
import math
from pathlib import Path

import numpy as np
import torch

from apps.bridge import tensors
from apps.bridge.card import put
from apps.bridge.tensors import array, require
from course.given import image, inputs
from labkit import places

from .rasterize import with_pairs

INTEGERS = torch.int32, torch.int64
BOUNDARIES = {"REPEAT": "wrap", "MIRRORED_REPEAT": "clamp", "CLAMP_TO_EDGE": "clamp",
              "CLAMP_TO_BORDER": "zero"}


class Mesh:
    """vertices (V, 3), faces (F, 3) and textures (F, T, T, T, 3), random ones to learn if None."""

    def __init__(self, vertices, faces, textures=None, texture_size=4):
        self.vertices, self.faces = vertices, faces
        self.num_vertices, self.num_faces = len(vertices), len(faces)
        if textures is None:
            textures = 0.05 * torch.randn(len(faces), *3 * [texture_size], 3)
            textures = torch.nn.Parameter(textures)
        self.textures, self.texture_size = textures, textures.shape[1]

    @classmethod
    def fromobj(cls, filename_obj, normalization=True, load_texture=False, texture_size=4):
        """The mesh of a file, as `load_obj` takes its arguments."""
        return cls(*load_obj(filename_obj, normalization, texture_size, load_texture),
                   texture_size=texture_size)


def load_obj(filename_obj, normalization=True, texture_size=4, load_texture=False,
             texture_wrapping="REPEAT", use_bilinear=True):
    """vertices (V, 3), faces (F, 3) and, with load_texture, textures (F, T, T, T, 3).

    normalization: centred at 0, the longest side from -1 to 1. Unlike the original, each texel
    reads the picture where OpenGL would, and wraps on its own.
    FileNotFoundError or OSError for a file that cannot be opened, ValueError for a broken one.
    """
    path = Path(filename_obj)
    vertices, faces, uv, used, library = read(path)
    if normalization:
        low, high = vertices.min(0), vertices.max(0)
        require((low < high).any(), f"all of {path} is in one place: load it as it is")
        vertices = (2 * vertices - low - high) / (high - low).max()
    mesh = put((torch.from_numpy(vertices).float(), torch.from_numpy(faces).int()))
    if not load_texture:
        return mesh
    require(library, f"{path} names no file of materials (mtllib): load it without textures")
    require(texture_size > 1, f"texture_size must be 2 or more, not {texture_size}")
    textures = np.full((len(faces), *3 * [texture_size], 3), 0.5)
    at = tensors.labs.texture_cubes.texel_barycentrics(texture_size) @ uv[:, None, None]
    for name, look in materials(path.parent / library).items():
        of = np.flatnonzero(np.array(used) == name)
        textures[of] = look if look.ndim == 1 else looked_up(look, at[of], texture_wrapping,
                                                             use_bilinear)
    return *mesh, put(torch.from_numpy(textures).float())


def read(path):
    """A file -> vertices (V, 3), faces (F, 3), uv of their corners (F, 3, 2), the names of their
    materials and of the file of materials, "" for none.

    Polygons are cut into triangles, from their first corner.
    """
    rows = {"v": [("0", "0", "0")], "vt": [("0", "0")]}  # numbers start at 1; 0 means none
    named, corners, used = {"usemtl": "", "mtllib": ""}, [], []
    try:
        for word, *others in statements(path):
            if word in rows:
                rows[word].append(others[:len(rows[word][0])])
            elif word in named:
                named[word] = " ".join(others)
            elif word == "f":
                first, *rest = ([int(number or 0) for number in f"{corner}/".split("/")[:2]]
                                for corner in others)
                corners += [(first, *pair) for pair in itertools.pairwise(rest)]
                used += [named["usemtl"]] * (len(corners) - len(used))
        vertices, uv = (np.array(each, float) for each in rows.values())
        faces, uv_faces = np.moveaxis(np.array(corners, int).reshape(-1, 3, 2), -1, 0)
        inputs.require_mesh(vertices[1:], faces - 1)
        return vertices[1:], faces - 1, uv[uv_faces], used, named["mtllib"]
    except (ValueError, IndexError) as error:
        raise ValueError(f"cannot read {path} as a mesh: it is broken, cut short or something else "
                         f"({error})") from None


def statements(path):
    """The words of each line of a file, without comments."""
    text = places.read_whole(path).decode("utf-8", "replace")
    return filter(None, (line.partition("#")[0].split() for line in text.splitlines()))


def materials(path):
    """A file of materials -> {name: a colour (3,), or a picture (h, w, 3) for all that has one}."""
    looks, name = {}, ""
    for word, *others in statements(path):
        if word == "newmtl":
            name = " ".join(others)
        elif word == "Kd":
            looks.setdefault(name, np.array(others[:3], float))
        elif word == "map_Kd":
            looks[name] = image.read(path.parent / " ".join(others))[..., :3]
    return looks


def looked_up(picture, uv, wrapping, is_bilinear):
    """A picture's colours at uv (..., 2)."""
    require(wrapping in BOUNDARIES, f"texture_wrapping must be one of {', '.join(BOUNDARIES)}, not "
            f"{wrapping}")
    if wrapping == "MIRRORED_REPEAT":
        uv = 1 - np.abs(uv % 2 - 1)
    return tensors.labs.mipmapping.texture(picture, uv, boundary=BOUNDARIES[wrapping],
                                           filter_mode="linear" if is_bilinear else "nearest")


def save_obj(filename, vertices, faces, textures=None):
    """vertices (V, 3), faces (F, 3) -> filename, an .obj file.

    With textures (F, T, T, T, 3) also a .mtl and a .png file of its name, a picture with a tile
    for each face. It shows what pixels would see of the face.
    """
    path = Path(filename)
    vertices = array("vertices", vertices.contiguous(), "v 3")
    faces = array("faces", faces.contiguous(), "f 3", INTEGERS) + 1
    with path.open("w", encoding="utf-8") as file:
        if textures is not None:
            picture, uv = atlas(array("textures", with_pairs(textures), f"{len(faces)} t t t 3"))
            image.write(path.with_suffix(".png"), picture)
            path.with_suffix(".mtl").write_text(
                f"newmtl faces\nKd 1 1 1\nmap_Kd {path.stem}.png\n", encoding="utf-8")
            file.write(f"mtllib {path.stem}.mtl\nusemtl faces\n")
            np.savetxt(file, uv.reshape(-1, 2), "vt %.8f %.8f")
            corners = np.arange(faces.size).reshape(faces.shape) + 1
            faces = np.stack([faces, corners], -1).reshape(-1, 6)
        np.savetxt(file, vertices, "v %.8f %.8f %.8f")
        np.savetxt(file, faces, "f %d %d %d" if textures is None else "f %d/%d %d/%d %d/%d")


def atlas(textures):
    """textures (F, T, T, T, 3) -> a picture with a tile for each face, and where in it the faces'
    corners are: uv (F, 3, 2).
    """
    count, tiles = math.ceil(math.sqrt(len(textures))), face_tiles(textures)
    side = tiles.shape[1]
    picture = np.zeros((count, count, side, side, 3))
    picture.reshape(-1, side, side, 3)[:len(tiles)] = tiles
    row, column = np.divmod(np.arange(len(tiles)), count)
    corners = np.array([[1, 1], [side - 1, 1], [1, side - 1]]) + 0.5
    uv = (np.stack([column, row], -1)[:, None] + corners / side) / count
    return picture.swapaxes(1, 2).reshape(count * side, count * side, 3), uv


def face_tiles(textures):
    """textures (F, T, T, T, 3) -> a picture of each face (F, side, side, 3), its half below the
    diagonal.

    There are 3 (T - 1) texels along a face's side, and one more around. So what a face's cube asks
    for, `texel_barycentrics`, is in the middle of a texel.
    """
    size = textures.shape[1]
    share = np.arange(-1, 3 * size - 2) / (3 * size - 3)
    x, y = np.meshgrid(share, share)
    weight = np.stack([1 - x - y, x, y], -1).reshape(-1, 3)
    # A place beside the face shows the texel beside the plane that stands for it, along (1, 1, 1).
    weight = np.clip(weight - np.minimum(weight.min(-1, keepdims=True), 0), 0, 1)
    taps = tensors.labs.texture_cubes.cube_taps(weight, np.ones(len(weight)), np.ones(1), size)
    tiles = tensors.labs.texturing.look_up(np.moveaxis(textures, 0, -2).reshape(size**3, -1), *taps)
    return np.moveaxis(tiles.reshape(len(share), len(share), -1, 3), 2, 0)
