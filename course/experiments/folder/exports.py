"""The mesh that lab 16 found, as files that other programs open: GLB and OBJ.

While the search goes on, `save` writes colours at the vertices, for that is quick. At its end,
`save_textured` writes a texture: see textures.py.
"""
import io
import math
import re

import numpy as np
import trimesh
from PIL import Image

from ...given import image, mesh, places
from . import textures


def save(labs, x, path, world_from_grid):
    """The mesh of x in the world, its albedo as vertex colours, as path.glb and path.obj."""
    vertices, faces, _, normals, albedo = labs.multi_view_fit.surface(x)
    vertices, normals = in_world(vertices, normals, world_from_grid)
    places.write_whole(path.with_suffix(".glb"), glb(vertices, faces, normals, albedo))
    places.write_whole(path.with_suffix(".obj"), obj(vertices, faces, albedo))


def in_world(vertices, normals, world_from_grid):
    """Vertices and normals (V, 3) of the grid, moved and turned into the world. Some normals are 0.
    """
    turn = world_from_grid[:3, :3]
    return (vertices @ turn.T + world_from_grid[:3, 3], mesh.unit(normals @ np.linalg.inv(turn)))


def decimals(vertices):
    """How many decimals an OBJ file needs: trimesh writes no exponents.

    The largest coordinate has 17 digits, which are all that a float has. Normals, colours and
    (u, v) have 9 decimals or more.
    """
    largest = np.abs(vertices).max(initial=1e-300)
    return max(17 - math.ceil(math.log10(largest)), 9)


def obj(vertices, faces, albedo):
    """An OBJ file's bytes. Colours, in sRGB, follow a vertex's position: most viewers read that."""
    coloured = trimesh.Trimesh(vertices, faces, vertex_colors=eight_bits(image.to_srgb(albedo)),
                               process=False)
    return coloured.export(file_type="obj", digits=decimals(vertices), header=None).encode()


def glb(vertices, faces, normals, albedo):
    """A binary glTF 2.0 file's bytes: one mesh, y up, linear vertex colours, a dull material."""
    dull = trimesh.visual.TextureVisuals(material=trimesh.visual.material.PBRMaterial(
        metallicFactor=0.0, roughnessFactor=1.0))
    coloured = trimesh.Trimesh(vertices, faces, vertex_normals=normals, visual=dull, process=False)
    coloured.visual.vertex_attributes["color"] = eight_bits(albedo)
    return coloured.export(file_type="glb", include_normals=True)


def eight_bits(colours):
    """Colours (V, 3) of 0 to 1 -> (V, 4) bytes, opaque."""
    return np.rint(255 * np.pad(np.clip(colours, 0, 1), ((0, 0), (0, 1)), constant_values=1)
                   ).astype(np.uint8)


# --- with a texture -----------------------------------------------------------------------------


def save_textured(labs, surface, count, path, world_from_grid):
    """A Surface in the world, its albedo as a texture: path.glb; path.obj, .mtl and .png.

    The GLB file has one attribute more, _PIXELS (V,): how many pixels tell of a vertex, the count.
    """
    vertices, faces, _, normals, albedo = surface
    vertices, normals = in_world(vertices, normals, world_from_grid)
    unwrapped = textures.unwrap(vertices, faces)
    texture = textures.bake(labs, unwrapped, albedo)
    shape = trimesh.Trimesh(vertices[unwrapped.origin], unwrapped.faces, process=False,
                            vertex_normals=normals[unwrapped.origin],
                            vertex_attributes={"_PIXELS": count[unwrapped.origin]})
    picture = as_picture(texture)
    files = {".glb": textured_glb(shape, unwrapped.uv, picture, path.stem),
             **textured_obj(shape, unwrapped.uv, picture, path.stem)}
    for ending, content in files.items():
        places.write_whole(path.with_suffix(ending), content)


def as_picture(texture):
    """A linear texture (H, W, 3), row 0 at the bottom, as PIL's picture in sRGB."""
    content = np.rint(255 * image.to_srgb(np.clip(texture[::-1], 0, 1))).astype(np.uint8)
    return Image.fromarray(content)


def textured_glb(shape, uv, picture, name):
    """A binary glTF 2.0 file's bytes: one mesh with normals, and a dull material of one side.

    trimesh turns v over: it is 0 at a texture's lower border here, and at the upper one in glTF.
    """
    dull = trimesh.visual.material.PBRMaterial(
        name=name, baseColorTexture=picture, metallicFactor=0.0, roughnessFactor=1.0,
        doubleSided=False)
    shape.visual = trimesh.visual.TextureVisuals(uv=uv, material=dull)
    return shape.export(file_type="glb", include_normals=True)


def textured_obj(shape, uv, picture, name):
    """{ending: bytes} of an OBJ file, its material, and its texture."""
    dull = trimesh.visual.material.SimpleMaterial(
        image=picture, name=name, diffuse=[255, 255, 255, 255], specular=[0, 0, 0, 255],
        ambient=[0, 0, 0, 255])
    shape.visual = trimesh.visual.TextureVisuals(uv=uv, material=dull)
    text, others = trimesh.exchange.obj.export_obj(
        shape, include_normals=True, include_texture=True, return_texture=True,
        digits=decimals(shape.vertices), header=None, mtl_name=f"{name}.mtl")
    material = re.sub(r"(?m)^map_Kd .*", f"map_Kd {name}.png", others[f"{name}.mtl"].decode())
    content = io.BytesIO()
    picture.save(content, "PNG")
    return {".png": content.getvalue(), ".mtl": material.encode(), ".obj": text.encode()}
