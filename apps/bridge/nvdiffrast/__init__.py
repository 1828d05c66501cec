"""nvdiffrast's interface (Laine et al. 2020) on labs 2, 5, 6, 7 and 8.

    pixels       contexts, rasterize, DepthPeeler
    attributes   interpolate
    textures     texture, texture_construct_mip
    outlines     antialias, antialias_construct_topology_hash
    torch        all of these, as `import nvdiffrast.torch` finds them

Arguments and results are those of its documentation, https://nvlabs.github.io/nvdiffrast: pictures
(N, H, W, C), row 0 at the bottom. Its backward passes have an epsilon in two places, and so have
these.
"""
__version__ = "0.4.0"  # the interface that is answered
