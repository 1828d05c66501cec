"""neural_renderer's interface (Kato et al. 2018, its port to PyTorch) on lab 10.

    cameras     look_at, look, perspective, projection, get_points_from_angles
    rasterize   rasterize and its kin: pictures of faces, and Kato's gradient
    renderer    Renderer: lighting, a camera and rasterize
    files       load_obj, save_obj, Mesh

Faces are (N, F, 3) of vertices (N, V, 3), textures (N, F, T, T, T, 3). Pictures are (N, 3, H, W) or
(N, H, W), row 0 at the top. Where this differs from the original, the functions say so.
"""
import sys

from .cameras import get_points_from_angles, look, look_at, perspective, projection
from .files import Mesh, load_obj, save_obj
from .rasterize import (
    Rasterize,
    rasterize,
    rasterize_depth,
    rasterize_rgbad,
    rasterize_silhouettes,
)
from .renderer import Renderer, lighting, vertices_to_faces

__all__ = ["Mesh", "Rasterize", "Renderer", "get_points_from_angles", "lighting", "load_obj",
           "look", "look_at", "perspective", "projection", "rasterize", "rasterize_depth",
           "rasterize_rgbad", "rasterize_silhouettes", "save_obj", "vertices_to_faces"]
__version__ = "1.1.3"  # the interface that is answered
for name in (*__all__, "mesh"):  # most are in files of their names in the original
    sys.modules.setdefault(f"{__name__}.{name}", sys.modules[__name__])
