"""The mesh that was found, as a file that other programs open: GLB, with its paint as a texture."""
import numpy as np
import trimesh

from course.given import image
from labkit import places

from . import textures


def save(labs, surface, path, world_from_grid):
    """A Surface in the world as a binary glTF 2.0 file: one mesh with normals, its albedo as a
    texture, and a dull material of one side.
    """
    vertices, faces, _, normals, albedo = surface
    placed = trimesh.Trimesh(vertices, faces, process=False, vertex_normals=normals)
    placed.apply_transform(world_from_grid)
    uv, cut, origin = textures.unwrap(placed.vertices, faces)
    texture = textures.bake(labs, uv, cut, albedo[origin])
    picture = image.as_8_bits(image.to_srgb(np.clip(texture, 0, 1)))
    dull = trimesh.visual.material.PBRMaterial(
        name=path.stem, baseColorTexture=picture, metallicFactor=0.0, roughnessFactor=1.0,
        doubleSided=False)
    # trimesh turns v over: it is 0 at a texture's lower border here, and at the upper one in glTF.
    shape = trimesh.Trimesh(placed.vertices[origin], cut, process=False,
                            vertex_normals=placed.vertex_normals[origin],
                            visual=trimesh.visual.TextureVisuals(uv=uv, material=dull))
    places.write_whole(path, shape.export(file_type="glb", include_normals=True))
