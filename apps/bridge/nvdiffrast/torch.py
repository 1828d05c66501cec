"""What `import nvdiffrast.torch as dr` finds, and nvdiffrast.torch.ops."""
import sys

from .attributes import interpolate
from .outlines import antialias, antialias_construct_topology_hash
from .pixels import DepthPeeler, RasterizeCudaContext, RasterizeGLContext, rasterize
from .textures import texture, texture_construct_mip

__all__ = ["DepthPeeler", "RasterizeCudaContext", "RasterizeGLContext", "antialias",
           "antialias_construct_topology_hash", "get_log_level", "interpolate", "rasterize",
           "set_log_level", "texture", "texture_construct_mip"]
LEVEL = [1]
ops = sys.modules[f"{__name__}.ops"] = sys.modules[__name__]  # a file of nvdiffrast's own


def get_log_level():
    """The least severity of messages that would be printed; there are none."""
    return LEVEL[0]


def set_log_level(level):
    """0 to 3: of what severity messages are printed. There are none."""
    LEVEL[0] = level
