"""The mesh that was found, as a file that other programs open: GLB, with its paint as a texture."""
import numpy as np
import trimesh

from course.given import image, mesh
from labkit import places

from . import textures


def save(labs, surface, path, world_from_grid):
    """A Surface in the world as a binary glTF 2.0 file: one mesh with normals, its albedo as a
    texture, and a dull material of one side.
    """
    vertices, faces, _, normals, albedo = surface
    vertices, normals = in_world(vertices, normals, world_from_grid)
    unwrapped = textures.unwrap(vertices, faces)
    texture = textures.bake(labs, unwrapped, albedo)
    picture = image.as_8_bits(image.to_srgb(np.clip(texture, 0, 1)))
    dull = trimesh.visual.material.PBRMaterial(
        name=path.stem, baseColorTexture=picture, metallicFactor=0.0, roughnessFactor=1.0,
        doubleSided=False)
    # trimesh turns v over: it is 0 at a texture's lower border here, and at the upper one in glTF.
    shape = trimesh.Trimesh(vertices[unwrapped.origin], unwrapped.faces, process=False,
                            vertex_normals=normals[unwrapped.origin],
                            visual=trimesh.visual.TextureVisuals(uv=unwrapped.uv, material=dull))
    places.write_whole(path, shape.export(file_type="glb", include_normals=True))


def in_world(vertices, normals, world_from_grid):
    """Vertices and normals (V, 3) of the grid, moved and turned into the world. Some normals are 0.
    """
    turn = world_from_grid[:3, :3]
    return (vertices @ turn.T + world_from_grid[:3, 3], mesh.unit(normals @ np.linalg.inv(turn)))
