"""Multi-view fit: shape, albedo and light from pictures, by the backward pass of every lab.

    scene -> surface -> colours -> picture -> loss     marching (lab 15), shading, the pipeline
    scene <- surface <- colours <- picture <- loss     the same upwards, and lab 9's `descend`

The scene's unknowns live on lab 15's grid of G = (n + 1)^3 points over [-1, 1]^3. Where the surface
crosses an edge of the grid, the albedo is mixed as the position is. The loss is eq. (5) of
reconstruction.py. The gradients of carving (6), sign changes (7) and bumps are added to its own.
Before each step, (8) spreads what belongs to distances and albedo over the grid.

The caller guarantees that the cameras are right, and that the object is within [-1, 1]^3.

Sources: lecture "Differentiable graphics 1" (its last part), Shen et al. 2021, Munkberg et al.
2022.
"""
import functools
import itertools
from typing import NamedTuple

import numpy as np

from course.given import mesh

from . import interpolation, marching_tetrahedra, msaa, pipeline, reconstruction
from .inverse_rendering import adam_step, descend
from .regularization import uniform_adam_step


class Scene(NamedTuple):
    """The unknowns, or one thing for each of them, such as a gradient or a learning rate.

    distance (G,), offsets of the grid's points (G, 3), albedo (G, 3), and light (9, 3).
    """

    distance: np.ndarray
    offsets: np.ndarray
    albedo: np.ndarray
    light: np.ndarray


class Weights(NamedTuple):
    """How much each part of the loss counts. The weight of the colours is 1."""

    coverage: float
    carving: float
    sign_changes: float
    bumps: float


class Surface(NamedTuple):
    """The mesh of a Scene: vertices, normals, albedo (V, 3), faces (F, 3).

    ends (V, 2) are the two points of the grid on whose edge a vertex lies.
    """

    vertices: np.ndarray
    faces: np.ndarray
    ends: np.ndarray
    normals: np.ndarray
    albedo: np.ndarray


class Capture(NamedTuple):
    """What a fit is given: pictures (H, W, 4) of colours and coverage, cameras clip_from_world
    (4, 4), one for each picture, and the background's colour (3,).
    """

    pictures: list
    cameras: list
    background: np.ndarray


class Target(NamedTuple):
    """A picture (H, W, 4) to be matched, and the View that renders it, samples times as wide and
    high. outside (H, W): the pixels that are certain to show nothing of the object.
    """

    picture: np.ndarray
    view: pipeline.View
    samples: int
    outside: np.ndarray


class Stage(NamedTuple):
    """A part of the fit: cells of the grid along an axis, how often smaller the pictures are,
    samples^2 a pixel, how many steps, and a factor of RATES, of which a third is left at the end.
    """

    cells: int
    shrink: int
    samples: int
    steps: int
    rate: float


WEIGHTS = Weights(coverage=1.0, carving=4.0, sign_changes=1e-3, bumps=1e-2)
RATES = Scene(distance=1.0, offsets=0.02, albedo=0.05, light=0.1)  # the first two in cells
CONSTANTS = 0.9, 0.99, 1e-8  # of Adam: squares are forgotten faster than usual
IN_SPACE = functools.partial(uniform_adam_step, constants=CONSTANTS)  # keeps the direction
UPDATES = Scene(IN_SPACE, IN_SPACE, IN_SPACE, functools.partial(adam_step, constants=CONSTANTS))
FREE = 1 / 6.01  # of a cell: offsets of less than 1/6 turn no tetrahedron over
SPREAD = 1.0     # the amount of eq. (8)

# --- the scene ----------------------------------------------------------------------------------


def start(n):
    """The Scene of n^3 cells where every fit begins: a ball, grey, in even light."""
    points, _ = marching_tetrahedra.tetrahedral_grid(n)
    light = np.zeros((9, 3))
    light[0] = 1 / reconstruction.C0
    return Scene(np.linalg.norm(points, axis=1) - 0.85, np.zeros((len(points), 3)),
                 np.full((len(points), 3), 0.5), light)


def refine(x, n):
    """A Scene, looked up on a grid of n^3 cells. Its offsets go back to 0, which moves the surface
    a little.
    """
    points, _ = marching_tetrahedra.tetrahedral_grid(n)
    weights = marching_tetrahedra.grid_weights(points, cells(x))
    return Scene(weights @ x.distance, np.zeros((len(points), 3)), weights @ x.albedo, x.light)


def cells(x):
    """How many cells a Scene's grid has along an axis: n."""
    return round(len(x.distance)**(1 / 3)) - 1


def bounded(x):
    """The nearest Scene that is allowed: its surface stays within the grid, its albedo from 0 to 1,
    and its offsets are too small to turn a tetrahedron over.
    """
    points, _ = marching_tetrahedra.tetrahedral_grid(cells(x))
    cell = points[1, 2] - points[0, 2]
    at_border = (np.abs(points) == 1).any(1)
    return Scene(np.where(at_border, np.maximum(x.distance, cell / 100), x.distance),
                 np.clip(x.offsets, -FREE * cell, FREE * cell), np.clip(x.albedo, 0, 1), x.light)


# --- from the scene to its surface, and back ----------------------------------------------------


def crossed_cubes(distance):
    """Which cubes of the grid have corners of both signs: bool (n^3,), in their order."""
    m = round(len(distance)**(1 / 3))
    corners = np.lib.stride_tricks.sliding_window_view((distance < 0).reshape(m, m, m), (2, 2, 2))
    inside = corners.sum((3, 4, 5)).ravel()
    return (0 < inside) & (inside < 8)


def surface(x):
    """The Surface of a Scene. Where nothing is inside, V = F = 0."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(cells(x))
    near = tetrahedra.reshape(-1, 6, 4)[crossed_cubes(x.distance)].reshape(-1, 4)
    vertices, faces, ends = marching_tetrahedra.marching_tetrahedra(points + x.offsets, x.distance,
                                                                    near)
    a, b = ends.T
    albedo = marching_tetrahedra.crossing(x.albedo[a], x.albedo[b], x.distance[a], x.distance[b])
    return Surface(vertices, faces, ends, mesh.vertex_normals(vertices, faces), albedo)


def surface_backward(grad_vertices, grad_albedo, ends, x):
    """Backward of `surface`: grad_vertices, grad_albedo (V, 3) -> grad_distance, grad_offsets and
    grad_albedo on the grid.

    The normals' gradient has come to grad_vertices before (`vertex_normals_backward`).
    """
    # Positions and albedo are mixed by the same distances: these get a gradient from both.
    points, _ = marching_tetrahedra.tetrahedral_grid(cells(x))
    backward = marching_tetrahedra.marching_tetrahedra_backward
    grad_offsets, by_place = backward(grad_vertices, ends, points + x.offsets, x.distance)
    grad_field, by_colour = backward(grad_albedo, ends, x.albedo, x.distance)
    return by_place + by_colour, grad_offsets, grad_field


# --- from the surface to the pictures, and back -------------------------------------------------


def targets_of(capture, shrink, samples):
    """The Targets of a Capture: pictures shrink times smaller, rendered with samples^2 a pixel."""
    background = np.append(capture.background, 0.0)
    found = []
    for camera, picture in zip(capture.cameras, capture.pictures, strict=True):
        small = msaa.box_resolve(picture, shrink)
        height, width, _ = small.shape
        view = pipeline.View(camera, samples * width, samples * height, background)
        found.append(Target(small, view, samples, is_outside(small)))
    return found


def is_outside(picture):
    """Which pixels, and all around them, show nothing of the object: (H, W, 4) -> bool (H, W)."""
    around = np.pad(picture[..., 3] > 0, 1, mode="edge")
    return ~np.lib.stride_tricks.sliding_window_view(around, (3, 3)).any((2, 3))


def target_loss(target, shape, colours, weights, renderer):
    """One Target, forward and back.

    -> loss, grad_vertices (V, 3), grad_colours (V, 4), and grad_level (V,) of carving, which the
    loss does not count. shape is a pipeline.Mesh. colours are pipeline.Colours (V, 4), and the last
    one is 1, for coverage.
    """
    fine, buffers = renderer.render(shape, colours, target.view)
    picture = msaa.box_resolve(fine, target.samples)
    loss = reconstruction.picture_loss(picture, target.picture, weights.coverage)
    grad_picture = reconstruction.picture_loss_backward(1.0, picture, target.picture,
                                                        weights.coverage)
    grad_fine = msaa.box_resolve_backward(grad_picture, fine, target.samples)
    gradients = renderer.render_backward(grad_fine, buffers, shape, colours, target.view)
    grad_level = carving_backward(weights.carving, target, shape, buffers)
    return loss, gradients.positions, gradients.surface.colours, grad_level


def carving_backward(grad_carving, target, shape, buffers):
    """Backward of eq. (6): grad_carving, a number -> grad_level (V,), of s at the vertices."""
    # s is an attribute of the vertices, seen by the pixels: back as any other attribute of lab 5.
    grad_picture = -grad_carving / target.outside.size * target.outside[..., None]
    grad_fine = msaa.box_resolve_backward(grad_picture, buffers.colour[..., :1], target.samples)
    level = np.zeros((len(shape.positions), 1))
    grad_level, _ = interpolation.interpolate_backward(grad_fine, level, shape.faces,
                                                       buffers.face_index, buffers.barycentric)
    return grad_level[:, 0]


def mean_loss(targets, found, light, weights, renderer):
    """The mean over Targets of `target_loss`, of a Surface in a light (9, 3)."""
    colours = np.ones((len(found.vertices), 4))
    colours[:, :3] = reconstruction.shade(found.albedo, found.normals, light)
    shape = pipeline.make_mesh(found.vertices, found.faces)
    parts = [target_loss(target, shape, pipeline.Colours(colours), weights, renderer)
             for target in targets]
    return [sum(part) / len(targets) for part in zip(*parts, strict=True)]


# --- the fit ------------------------------------------------------------------------------------


def loss_and_gradients(x, targets, weights=WEIGHTS, renderer=pipeline):
    """The mean loss (5) of Targets, and a Scene of gradients, also of carving and the regularizers.

    renderer is as for `fit`. ValueError where no surface is left.
    """
    found = surface(x)
    if not len(found.faces):
        raise ValueError("no surface is left, for nothing is inside: are the cameras right?")
    loss, grad_vertices, grad_colours, grad_level = mean_loss(targets, found, x.light,
                                                              weights, renderer)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(
        grad_colours[:, :3], found.albedo, found.normals, x.light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, found.vertices, found.faces)
    by_bumps, by_changes = regularizers_backward(weights, found, x)
    grad_distance, grad_offsets, grad_field = surface_backward(
        grad_vertices + by_normals + by_bumps, grad_albedo, found.ends, x)
    grad_distance += reconstruction.level_backward(grad_level, found.ends, x.distance)
    return loss, Scene(grad_distance + by_changes, grad_offsets, grad_field, grad_light)


def regularizers_backward(weights, found, x):
    """The gradients of bumps, to vertices (V, 3), and of sign changes (7), to distances (G,)."""
    # Both count in cells, so that a weight means the same on any grid.
    cell = 2 / cells(x)
    edges, _ = mesh.edges(found.faces)
    by_bumps = reconstruction.bumps_backward(weights.bumps / cell**2, found.vertices,
                                             found.normals, edges)
    by_changes = reconstruction.sign_changes_backward(
        weights.sign_changes / len(found.vertices), x.distance / cell, found.ends) / cell
    return by_bumps, by_changes


def learning_rates(stage):
    """A Scene of learning rates for each step of a Stage, as lab 9's `descend` takes them."""
    cell = 2 / stage.cells
    falling = [stage.rate * 3**-(step / stage.steps) for step in range(1, stage.steps + 1)]
    return [Scene(*factor * np.array(RATES) * [cell, cell, 1, 1]) for factor in falling]


def stochastic_gradient(targets, per_step, rng, weights, renderer):
    """-> gradient(x), as lab 9's `descend` takes it: of per_step Targets, drawn anew each time.

    Gradients in space are spread by eq. (8), but for the offsets.
    """
    def gradient(x):
        drawn = [targets[k] for k in rng.permutation(len(targets))[:per_step]]
        loss, grad_x = loss_and_gradients(x, drawn, weights, renderer)
        return loss, grad_x._replace(distance=reconstruction.spread(grad_x.distance, SPREAD),
                                     albedo=reconstruction.spread(grad_x.albedo, SPREAD))
    return gradient


def fit(capture, stages, seed=0, weights=WEIGHTS, per_step=4, renderer=pipeline):
    """Reconstruction, from coarse to fine: yields x, a Scene, after each step, and the loss before
    it, eq. (5) of the views drawn.

    capture is a Capture, stages are tuples like Stage. Each step looks at per_step of the views,
    drawn by the seed. renderer has a `render` and a `render_backward` like the pipeline's.
    """
    rng = np.random.default_rng(seed)
    x = None
    for stage in itertools.starmap(Stage, stages):
        x = start(stage.cells) if x is None else refine(x, stage.cells)
        targets = targets_of(capture, stage.shrink, stage.samples)
        gradient = stochastic_gradient(targets, per_step, rng, weights, renderer)
        steps = descend(x, gradient, learning_rates(stage), UPDATES, bounded)
        for x, loss in steps:
            yield x, loss
