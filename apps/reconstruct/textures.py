"""From colours at the vertices to a texture: charts by xatlas, texels by lab 2 and lab 5."""
import numpy as np
import scipy.ndimage
import trimesh
import xatlas

RESOLUTION = 1024  # texels along a side
GUTTER = 6         # from chart to chart, so that they do not mix in the first mip levels
ROUNDS = 10        # of smoothing, before the mesh is cut into charts


def unwrap(vertices, faces):
    """Cut a mesh into charts that lie flat, and put them side by side.

    -> uv (V, 2) from 0 to 1, v up, faces (F, 3), and origin (V,): which vertex of the mesh before
    each vertex was. A cut gives some of them several uv.

    The slivers of marching tetrahedra would make hundreds of small charts. So xatlas is given a
    smoothed copy. Its charts fit the mesh itself as well, for they only name vertices.
    """
    smooth = trimesh.Trimesh(vertices, faces, process=False)
    trimesh.smoothing.filter_laplacian(smooth, iterations=ROUNDS, volume_constraint=False)
    atlas = xatlas.Atlas()
    atlas.add_mesh(smooth.vertices.astype(np.float32), faces.astype(np.uint32))
    cutting, packing = xatlas.ChartOptions(), xatlas.PackOptions()
    cutting.max_cost = 1.0  # with xatlas's own 2 it takes half as long again
    packing.padding, packing.resolution = GUTTER, RESOLUTION
    atlas.generate(cutting, packing)
    origin, cut, uv = atlas[0]
    return np.clip(uv.astype(float), 0, 1), cut.astype(int), origin.astype(int)


def bake(labs, uv, faces, colours, size=RESOLUTION):
    """The colours (V, 3) of vertices at uv (V, 2), as a texture (size, size, 3).

    The charts are rasterized like a mesh in clip space. A texel between them takes the colour of
    the nearest one on a chart: what a filter mixes in at a border then has the right colour.
    """
    clip = np.pad(2 * uv - 1, ((0, 0), (0, 2)), constant_values=(0, 1))
    clip[:, 2] = 0
    seen = labs.pipeline.visible(clip, faces, size, size)
    texture = labs.interpolation.interpolate(colours, faces, seen.face_index, seen.barycentric)
    nearest = scipy.ndimage.distance_transform_edt(seen.face_index < 0, return_distances=False,
                                                   return_indices=True)
    return texture[tuple(nearest)]
