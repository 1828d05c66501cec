"""One silhouette, three gradients (lab 10): the same Adam, start and goal for each of them.

An outline is a function (labs, clip, faces, size) -> picture (size, size), and its backward pass, a
function grad_picture -> grad_clip (V, 4).
"""
import numpy as np

from ..given import image, mesh
from . import fit_triangle
from .drawing import descended, seen_mask
from .viewing import clip_from_world


def sweep_outline(labs, clip, faces, size, eps=1e-4):
    """neural_renderer's: 1 where a face is seen, and its sweep."""
    lab10 = labs.neural_renderer
    corners = lab10.corners_of(clip, faces)
    face_index, *_ = lab10.rasterize(corners, size, size)
    picture = (face_index >= 0).astype(float)

    def backward(grad_picture):
        grad_corners = labs.sweep_gradient.sweep_backward(
            grad_picture[..., None], picture[..., None], face_index, corners, eps)
        return lab10.corners_backward(grad_corners, clip, faces)

    return picture, backward


def soft_outline(labs, clip, faces, size, sigma=0.05):
    """SoftRas's: a probability, sigma in pixels^2."""
    lab10, soft = labs.neural_renderer, labs.soft_rasterizer
    corners = lab10.corners_of(clip, faces)
    screen = lab10.on_screen(corners, size, size)

    def backward(grad_picture):
        grad_corners = np.zeros(corners.shape)
        grad_screen = soft.soft_silhouette_backward(grad_picture, screen, sigma)
        grad_corners[..., :2] = grad_screen * size / 2
        return lab10.corners_backward(grad_corners, clip, faces)

    return soft.soft_silhouette(screen, size, size, sigma), backward


def blend_outline(labs, clip, faces, size):
    """Lab 8's: white faces on black, antialiased."""
    lab8 = labs.antialiasing
    face_index, depth = labs.rasterization.rasterize(clip, faces, size, size)
    pairs = labs.outline_walk.walked_pairs(face_index, depth, clip, faces,
                                           lab8.opposite_corners(faces))
    colour = (face_index >= 0)[..., None].astype(float)

    def backward(grad_picture):
        return lab8.blend_pairs_backward(grad_picture[..., None], colour, pairs, clip)[1]

    return lab8.blend_pairs(colour, pairs)[..., 0], backward


OUTLINES = {"sweep": sweep_outline, "soft": soft_outline, "blend": blend_outline}


def triangle(labs, outline, steps=300, start=fit_triangle.START):
    """`fit_triangle` by an outline, from start (3, 2) -> vertices (steps + 1, 3, 2) in pixels."""
    lab9, goal = labs.inverse_rendering, fit_triangle.template(labs)[..., 0]
    shape, _, view = fit_triangle.scene(labs)
    side = fit_triangle.SIDE

    def gradient(x):
        positions = fit_triangle.in_space(x)
        clip = labs.pipeline.to_clip(positions, view.clip_from_model)
        picture, backward = outline(labs, clip, shape.faces, side)
        loss, grad_picture = lab9.squared_error(picture, goal)
        grad_x, _ = labs.pipeline.to_clip_backward(backward(grad_picture), positions,
                                                   view.clip_from_model)
        return loss, grad_x[:, :2]

    path, _ = descended(labs, start, gradient, fit_triangle.schedule(steps))
    return np.array(path)


def teapot(labs, outline, steps=150, size=64, weight=2e-3, radius=0.5):
    """A ball's vertices move until its silhouette is the teapot's, in one view of size x size.

    -> vertices (steps + 1, V, 3), faces. The goal is a mean of 4 x 4 samples.
    """
    lab9, pipeline, camera = labs.inverse_rendering, labs.pipeline, teapot_camera(labs)
    goal = labs.msaa.box_resolve(teapot_mask(labs, 4 * size)[..., None] * 1.0, 4)[..., 0]
    vertices, faces = mesh.icosphere(320)
    edges, start = mesh.edges(faces)[0], radius * vertices

    def gradient(x):
        picture, backward = outline(labs, pipeline.to_clip(x, camera), faces, size)
        loss, grad_picture = lab9.silhouette_loss(picture, goal)
        grad_x, _ = pipeline.to_clip_backward(backward(grad_picture), x, camera)
        return loss, grad_x + lab9.uniform_laplacian_energy_backward(weight, x, edges)

    path, _ = descended(labs, start, gradient, lab9.decay(0.02, 0.1, steps))
    return np.array(path), faces


def teapot_camera(labs):
    """clip_from_world (4, 4) of the teapot's portrait."""
    return clip_from_world(labs, [0.4, 0.8, 2.6], fov_y=44)


def teapot_mask(labs, size):
    """Where the teapot is seen: bool (size, size)."""
    vertices, faces = mesh.teapot()
    return seen_mask(labs, mesh.normalize(vertices), faces, teapot_camera(labs), size)


def teapot_iou(labs, vertices, faces, size=256):
    """Intersection over union of a mesh's silhouette and the teapot's, in fine pictures."""
    seen = seen_mask(labs, vertices, faces, teapot_camera(labs), size)
    return image.intersection_over_union(seen, teapot_mask(labs, size))
