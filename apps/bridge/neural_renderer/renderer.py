"""Renderer: meshes in the world, with light and a camera, as pictures."""
import math

import torch
from torch.nn.functional import normalize

from apps.bridge.tensors import require

from . import cameras
from .rasterize import rasterize_depth, rasterize_rgbad, rasterize_silhouettes


def vertices_to_faces(vertices, faces):
    """The corners (N, F, 3, 3) of faces (N, F, 3) with vertices (N, V, 3)."""
    require(vertices.ndim == faces.ndim == 3, "vertices must have the shape (n, v, 3) and faces "
            f"(n, f, 3); they have {tuple(vertices.shape)} and {tuple(faces.shape)}")
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


class Renderer(torch.nn.Module):
    """Pictures of vertices (N, V, 3), faces (N, F, 3) and textures (N, F, T, T, T, 3).

    Its arguments are its attributes. fill_back: faces are seen from behind, too. camera_mode:
    projection, with K to orig_size as `cameras.projection` takes them, if they do not follow the
    mesh; look_at, from the attribute eye to 0; look, from there in camera_direction. The last two
    are in perspective or not, with viewing_angle degrees from the middle of the picture to its
    border. (The original heeds near and far for colours alone, and no camera_direction given here.)
    """

    def __init__(self, image_size=256, anti_aliasing=True, background_color=(0, 0, 0),
                 fill_back=True, camera_mode="projection", K=None, R=None, t=None,
                 dist_coeffs=None, orig_size=1024, perspective=True, viewing_angle=30,
                 camera_direction=(0, 0, 1), near=0.1, far=100, light_intensity_ambient=0.5,
                 light_intensity_directional=0.5, light_color_ambient=(1, 1, 1),
                 light_color_directional=(1, 1, 1), light_direction=(0, 1, 0)):
        given = {name: value for name, value in locals().items() if name != "self"}
        torch.nn.Module.__init__(self)
        for name, value in given.items():
            setattr(self, name, value)
        if camera_mode not in ("projection", "look", "look_at"):
            raise ValueError(f"camera_mode must be projection, look or look_at, not {camera_mode}")
        if dist_coeffs is None:
            self.dist_coeffs = torch.zeros(1, 5)
        self.eye = 0, 0, -(1 / math.tan(math.radians(viewing_angle)) + 1)
        self.rasterizer_eps = 1e-3

    def forward(self, vertices, faces, textures=None, mode=None, *camera, **named):
        """What `render` returns, or the picture of mode rgb, silhouettes or depth."""
        if mode not in (None, "rgb", "silhouettes", "depth"):
            raise ValueError(f"mode must be None, rgb, silhouettes or depth, not {mode}")
        draw = getattr(self, f"render_{mode}") if mode else self.render
        painted = (textures,) if mode in (None, "rgb") else ()
        return draw(vertices, faces, *painted, *camera, **named)

    def render(self, vertices, faces, textures, *camera, **named):
        """rgb (N, 3, H, W), depth (N, H, W), alpha (N, H, W)."""
        pictures = rasterize_rgbad(
            self.corners(vertices, faces, *camera, **named), self.lit(vertices, faces, textures),
            *self.screen(), self.rasterizer_eps, self.background_color)
        return pictures["rgb"], pictures["depth"], pictures["alpha"]

    def render_rgb(self, vertices, faces, textures, *camera, **named):
        """rgb (N, 3, H, W)."""
        return self.render(vertices, faces, textures, *camera, **named)[0]

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
            own = self.K, self.R, self.t, self.dist_coeffs, self.orig_size
            camera = [mine if given is None else given for mine, given in zip(
                own, (K, R, t, dist_coeffs, orig_size), strict=True)]
            require(all(part is not None for part in camera), "the camera mode projection needs K, "
                    "R and t: give them to Renderer, or after the mesh")
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
