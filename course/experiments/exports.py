"""The mesh that lab 16 found, as files that other programs open: GLB and OBJ."""
import numpy as np
import trimesh

from ..given import image, places


def save(labs, x, path, world_from_grid):
    """The mesh of x in the world, its albedo as vertex colours, as path.glb and path.obj."""
    vertices, faces, _, normals, albedo = labs.multi_view_fit.surface(x)
    vertices = vertices @ world_from_grid[:3, :3].T + world_from_grid[:3, 3]
    places.write_whole(path.with_suffix(".glb"), glb(vertices, faces, normals, albedo))
    places.write_whole(path.with_suffix(".obj"), obj(vertices, faces, albedo))


def obj(vertices, faces, albedo):
    """An OBJ file's bytes. Colours, in sRGB, follow a vertex's position: most viewers read that."""
    coloured = trimesh.Trimesh(vertices, faces, vertex_colors=eight_bits(image.to_srgb(albedo)),
                               process=False)
    return coloured.export(file_type="obj", digits=7, header=None).encode()


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
