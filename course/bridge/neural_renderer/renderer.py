"""Renderer: meshes in the world, with light and a camera, as pictures."""
import math
from typing import NamedTuple

import torch
from torch.nn.functional import normalize

from ..tensors import require
from . import cameras
from .rasterize import rasterize, rasterize_depth, rasterize_rgbad, rasterize_silhouettes


def vertices_to_faces(vertices, faces):
    """The corners (N, F, 3, 3) of faces (N, F, 3) with vertices (N, V, 3)."""
    cameras.require_vertices(vertices)
    require(faces.shape == (len(vertices), faces.shape[1], 3), f"faces must have the shape "
            f"({len(vertices)}, f, 3), give those of one mesh as faces[None]; they have "
            f"{tuple(faces.shape)}")
    return vertices[torch.arange(len(vertices))[:, None, None], faces.long()]


def lighting(faces, textures, intensity_ambient=0.5, intensity_directional=0.5,
             color_ambient=(1, 1, 1), color_directional=(1, 1, 1), direction=(0, 1, 0)):
    """textures (N, F, T, T, T, 3) in the light that falls on faces (N, F, 3, 3).

    Colours and direction, towards the light: (3,) or (N, 3). The light is on the side that sees the
    corners clockwise.
    """
    a, b, c = faces.unbind(2)
    normal = normalize(torch.linalg.cross(c - a, b - a), dim=-1, eps=cameras.SHORTEST)
    cosine = (normal * cameras.as_vectors(direction, faces)).sum(-1, keepdim=True)
    light = (intensity_ambient * cameras.as_vectors(color_ambient, faces) + torch.relu(cosine)
             * intensity_directional * cameras.as_vectors(color_directional, faces))
    return textures * light[:, :, None, None, None]


class Settings(NamedTuple):
    """The arguments of Renderer, in their order; they are its attributes.

    camera_mode: projection, with K to orig_size as `cameras.projection` takes them; look_at, from
    eye to 0; look, from eye in camera_direction. The last two are in perspective or not, with
    viewing_angle degrees from the middle of the picture to its border.
    """

    image_size: int = 256
    anti_aliasing: bool = True
    background_color: object = (0, 0, 0)
    fill_back: bool = True
    camera_mode: str = "projection"
    K: object = None
    R: object = None
    t: object = None
    dist_coeffs: object = None
    orig_size: float = 1024
    perspective: bool = True
    viewing_angle: float = 30
    camera_direction: object = (0, 0, 1)
    near: float = 0.1
    far: float = 100
    light_intensity_ambient: float = 0.5
    light_intensity_directional: float = 0.5
    light_color_ambient: object = (1, 1, 1)
    light_color_directional: object = (1, 1, 1)
    light_direction: object = (0, 1, 0)


class Renderer(torch.nn.Module):
    """Pictures of vertices (N, V, 3), faces (N, F, 3) and textures (N, F, T, T, T, 3).

    Its arguments are Settings. After the mesh, K, R, t, dist_coeffs and orig_size may follow, else
    they are the Renderer's own. (The original heeds near and far for colours alone, and looks along
    z until camera_direction is set as an attribute.)
    """

    def __init__(self, *settings, **named):
        super().__init__()
        for name, value in Settings(*settings, **named)._asdict().items():
            setattr(self, name, value)
        if self.camera_mode not in ("projection", "look", "look_at"):
            raise ValueError("camera_mode must be projection, look or look_at, not "
                             f"{self.camera_mode!r}")
        if self.dist_coeffs is None:
            self.dist_coeffs = torch.zeros(1, 5)
        self.eye = 0, 0, -(1 / math.tan(math.radians(self.viewing_angle)) + 1)
        self.rasterizer_eps = 1e-3

    def forward(self, vertices, faces, textures=None, mode=None, *camera, **named):
        """What `render` returns, or the picture of mode rgb, silhouettes or depth."""
        if mode is None:
            return self.render(vertices, faces, textures, *camera, **named)
        if mode == "rgb":
            return self.render_rgb(vertices, faces, textures, *camera, **named)
        if mode in ("silhouettes", "depth"):
            return getattr(self, f"render_{mode}")(vertices, faces, *camera, **named)
        raise ValueError(f"mode must be None, rgb, silhouettes or depth, not {mode!r}")

    def render(self, vertices, faces, textures, *camera, **named):
        """rgb (N, 3, H, W), depth (N, H, W), alpha (N, H, W)."""
        corners = self.corners(vertices, faces, *camera, **named)
        pictures = rasterize_rgbad(corners, self.lit(vertices, faces, textures), *self.screen(),
                                   self.rasterizer_eps, self.background_color)
        return pictures["rgb"], pictures["depth"], pictures["alpha"]

    def render_rgb(self, vertices, faces, textures, *camera, **named):
        """rgb (N, 3, H, W)."""
        corners = self.corners(vertices, faces, *camera, **named)
        return rasterize(corners, self.lit(vertices, faces, textures), *self.screen(),
                         self.rasterizer_eps, self.background_color)

    def render_silhouettes(self, vertices, faces, *camera, **named):
        """alpha (N, H, W)."""
        return rasterize_silhouettes(self.corners(vertices, faces, *camera, **named),
                                     *self.screen())

    def render_depth(self, vertices, faces, *camera, **named):
        """depth (N, H, W), far where nothing is seen."""
        return rasterize_depth(self.corners(vertices, faces, *camera, **named), *self.screen())

    def screen(self):
        """What all pictures have in common."""
        return self.image_size, self.anti_aliasing, self.near, self.far

    def corners(self, vertices, faces, *camera, **named):
        """The faces' corners (N, F or 2 F, 3, 3) as the camera sees them."""
        return vertices_to_faces(self.seen(vertices, *camera, **named), self.both_sides(faces))

    def seen(self, vertices, K=None, R=None, t=None, dist_coeffs=None, orig_size=None):
        """The vertices as the camera sees them."""
        if self.camera_mode == "projection":
            given = {"K": K, "R": R, "t": t, "dist_coeffs": dist_coeffs, "orig_size": orig_size}
            camera = [getattr(self, name) if value is None else value
                      for name, value in given.items()]
            require(all(value is not None for value in camera), "the camera mode projection needs "
                    "K, R and t: give them to Renderer, or with the mesh")
            return cameras.projection(vertices, *camera)
        if self.camera_mode == "look_at":
            vertices = cameras.look_at(vertices, self.eye)
        elif self.camera_mode == "look":
            vertices = cameras.look(vertices, self.eye, self.camera_direction)
        else:  # a program may say later that its vertices are as a camera sees them
            return vertices
        return cameras.perspective(vertices, self.viewing_angle) if self.perspective else vertices

    def lit(self, vertices, faces, textures):
        """The textures of all faces, in the light."""
        if self.fill_back:
            textures = torch.cat([textures, textures.transpose(2, 4)], 1)
        return lighting(vertices_to_faces(vertices, self.both_sides(faces)), textures,
                        self.light_intensity_ambient, self.light_intensity_directional,
                        self.light_color_ambient, self.light_color_directional,
                        self.light_direction)

    def both_sides(self, faces):
        """The faces and, if they are to be seen from behind, too, the same turned round."""
        return torch.cat([faces, faces.flip(-1)], 1) if self.fill_back else faces
