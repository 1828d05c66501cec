"""Multi-view fit: shape, albedo and light from pictures, by the backward pass of every lab.

    scene -> surface -> normals -> colours -> pictures -> loss   marching, shading, the pipeline
    scene <- surface <- normals <- colours <- pictures <- loss   back, then lab 9's `descend`

The scene's unknowns live on lab 15's grid of G = (n + 1)^3 points over [-1, 1]^3. Where the surface
crosses an edge of the grid, the albedo is mixed as the position is. The loss is eq. (5) of
reconstruction.py. The gradients of carving (6), sign changes (7) and bumps are added to its own.
Before each step, (8) spreads the gradients of distances and albedo over the grid.

The cameras must be right, and the object within [-1, 1]^3.

Sources: lecture "Differentiable graphics 1" (its last part), Shen et al. 2021, Munkberg et al.
2022.
"""
import functools
from typing import NamedTuple

import numpy as np

from course.given import mesh

from . import marching_tetrahedra, msaa, pipeline, reconstruction
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
    high. outside (H, W): the pixels that are certain to show nothing of the object. renderer: what
    takes the place of the pipeline, with a `render` and a `render_backward` like it, or None.
    """

    picture: np.ndarray
    view: pipeline.View
    samples: int
    outside: np.ndarray
    renderer: object = None


class Stage(NamedTuple):
    """A part of the fit: cells of the grid along an axis, how often smaller the pictures are,
    samples^2 a pixel, how many steps, and a factor of RATES, of which a third is left at the end.
    """

    cells: int
    shrink: int
    samples: int
    steps: int
    rate: float


WEIGHTS = Weights(coverage=1.0, carving=4.0, sign_changes=1e-3, bumps=0.03)
RATES = Scene(distance=1.0, offsets=0.02, albedo=0.05, light=0.1)  # the first two in cells
CONSTANTS = 0.9, 0.99, 1e-8  # of Adam: squares are forgotten faster than usual
UNIFORM_ADAM = functools.partial(uniform_adam_step, constants=CONSTANTS)  # keeps the direction
UPDATES = Scene(distance=UNIFORM_ADAM, offsets=UNIFORM_ADAM, albedo=UNIFORM_ADAM,
                light=functools.partial(adam_step, constants=CONSTANTS))
FREE = 1 / 6.01  # of a cell: offsets of less than 1/6 turn no tetrahedron over
SPREAD = 1.0     # the amount of eq. (8)

# --- the scene ----------------------------------------------------------------------------------


def start(n):
    """The Scene of n^3 cells where every fit begins: a ball, grey, in even light."""
    points = marching_tetrahedra.grid_points(n)
    light = np.zeros((9, 3))
    light[0] = 1 / reconstruction.C0
    return Scene(np.linalg.norm(points, axis=1) - 0.85, np.zeros((len(points), 3)),
                 np.full((len(points), 3), 0.5), light)


def refine(x, n):
    """A Scene, looked up on a grid of n^3 cells. Its offsets go back to 0, which moves the surface
    a little.
    """
    points = marching_tetrahedra.grid_points(n)
    weights = marching_tetrahedra.grid_weights(points, cells(x))
    return Scene(weights @ x.distance, np.zeros((len(points), 3)), weights @ x.albedo, x.light)


def cells(x):
    """How many cells a Scene's grid has along an axis: n."""
    return round(len(x.distance)**(1 / 3)) - 1


def bounded(x):
    """The nearest Scene that is allowed: its surface stays within the grid, its albedo from 0 to 1,
    and its offsets are too small to turn a tetrahedron over.
    """
    points = marching_tetrahedra.grid_points(cells(x))
    cell = points[1, 2] - points[0, 2]
    at_border = (np.abs(points) == 1).any(1)
    return Scene(np.where(at_border, np.maximum(x.distance, cell / 100), x.distance),
                 np.clip(x.offsets, -FREE * cell, FREE * cell), np.clip(x.albedo, 0, 1), x.light)


# --- from the scene to its surface, and back ----------------------------------------------------


def crossed_cubes(distance):
    """Which cubes of the grid have corners of both signs: bool (n^3,), in their order."""
    m = round(len(distance)**(1 / 3))
    inside = (distance < 0).astype(int).reshape(m, m, m)
    squares = sum(inside[:, i:m - 1 + i, j:m - 1 + j] for i in (0, 1) for j in (0, 1))
    corners = (squares[:-1] + squares[1:]).ravel()  # how many of a cube's eight are inside
    return (0 < corners) & (corners < 8)


def surface(x):
    """The Surface of a Scene. Where nothing is inside, V = F = 0."""
    points = marching_tetrahedra.grid_points(cells(x)) + x.offsets
    near = marching_tetrahedra.tetrahedra_of(np.flatnonzero(crossed_cubes(x.distance)), cells(x))
    vertices, faces, ends = marching_tetrahedra.marching_tetrahedra(points, x.distance, near)
    albedo = marching_tetrahedra.zero_crossing(*x.albedo[ends.T], *x.distance[ends.T])
    return Surface(vertices, faces, ends, mesh.vertex_normals(vertices, faces), albedo)


def surface_backward(grad_vertices, grad_albedo, ends, x):
    """Backward of `surface`: grad_vertices, grad_albedo (V, 3) -> grad_distance, grad_offsets and
    grad_albedo on the grid.

    The normals' gradient has come to grad_vertices before (`vertex_normals_backward`).
    """
    # Positions and albedo are mixed by the same distances: these get a gradient from both.
    points = marching_tetrahedra.grid_points(cells(x)) + x.offsets
    backward = marching_tetrahedra.marching_tetrahedra_backward
    grad_offsets, by_place = backward(grad_vertices, ends, points, x.distance)
    grad_field, by_colour = backward(grad_albedo, ends, x.albedo, x.distance)
    return by_place + by_colour, grad_offsets, grad_field


# --- from the surface to the pictures, and back -------------------------------------------------


def targets_of(capture, shrink, samples, renderer=None):
    """The Targets of a Capture: pictures shrink times smaller, rendered with samples^2 a pixel."""
    background = np.append(capture.background, 0.0)
    found = []
    for camera, picture in zip(capture.cameras, capture.pictures, strict=True):
        small = msaa.box_resolve(picture, shrink)
        height, width, _ = small.shape
        view = pipeline.View(camera, samples * width, samples * height, background)
        found.append(Target(small, view, samples, is_outside(small), renderer))
    return found


def is_outside(picture):
    """Which pixels, and all around them, show nothing of the object: (H, W, 4) -> bool (H, W)."""
    around = np.pad(picture[..., 3] > 0, 1, mode="edge")
    return ~np.lib.stride_tricks.sliding_window_view(around, (3, 3)).any((2, 3))


def render_views(shape, colours, views):
    """The pictures (K, H, W, 4) of K views, which are Targets, and Buffers for the way back.

    shape is a pipeline.Mesh, colours (V, 3). Coverage, the fourth number, is 1 on the surface.
    """
    pictures, buffers = [], []
    for target in views:
        renderer = target.renderer or pipeline
        fine, seen = renderer.render(shape, covering(colours), target.view)
        pictures.append(msaa.box_resolve(fine, target.samples))
        buffers.append(seen)
    return np.stack(pictures), buffers


def render_views_backward(grad_pictures, buffers, shape, colours, views):
    """Backward of `render_views`: grad_pictures (K, H, W, 4) -> grad_vertices, grad_colours (V, 3).

    The third result is carving's grad_level (V,), the mean over the views of eq. (6)'s gradient
    with respect to s at the vertices. The loss does not count it.
    """
    found = []
    for grad_picture, seen, target in zip(grad_pictures, buffers, views, strict=True):
        fine = np.empty((*seen.depth.shape, 4))  # only its shape is asked for
        grad_fine = msaa.box_resolve_backward(grad_picture, fine, target.samples)
        renderer = target.renderer or pipeline
        gradients = renderer.render_backward(grad_fine, seen, shape, covering(colours), target.view)
        grad_level = carving_backward(1 / len(views), target, shape.faces, seen)
        found.append((gradients.positions, gradients.material.colours[:, :3], grad_level))
    return tuple(sum(of_all_views) for of_all_views in zip(*found, strict=True))


def covering(colours):
    """colours (V, 3), and coverage 1 beside them: pipeline.Colours (V, 4)."""
    return pipeline.Colours(np.column_stack([colours, np.ones(len(colours))]))


def carving_backward(grad_carving, target, faces, buffers):
    """Backward of eq. (6): grad_carving, a number -> grad_level (V,), of s at the vertices."""
    # s is an attribute of the vertices, seen by the pixels: back as any other attribute of lab 5.
    grad_picture = -grad_carving / target.outside.size * target.outside[..., None]
    fine = buffers.depth[..., None]  # only its shape is asked for
    grad_fine = msaa.box_resolve_backward(grad_picture, fine, target.samples)
    return pipeline.to_vertices(grad_fine, buffers, faces)[:, 0]


def views_loss_and_gradients(vertices, faces, albedo, light, views,  # exercise 16.9 (9 points)
                             targets, weight):
    """Eq. (5) of K views and its gradients: the arrows on top of this file, there and back.

    views: K Targets, for `render_views` and its backward pass. targets (K, H, W, 4). vertices,
    albedo (V, 3), light (9, 3) -> loss, grad_vertices, grad_albedo, grad_light, grad_level.

    >>> vertices = np.array([[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]])
    >>> light, target = np.zeros((9, 3)), np.array([[[0.0, 0.0, 0.0, 1.0]]])
    >>> light[0] = 1 / reconstruction.C0
    >>> view = Target(target, pipeline.View(np.eye(4), 1, 1, np.zeros(4)), 1, np.array([[False]]))
    >>> loss, _, grad_albedo, _, _ = views_loss_and_gradients(
    ...     vertices, np.array([[0, 1, 2]]), np.full((3, 3), 0.5), light, (view,), target[None],
    ...     1.0)
    >>> float(loss), grad_albedo.sum(0).round(6)
    (0.25, array([0.333333, 0.333333, 0.333333]))
    """
    n = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, n, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss, grad_pictures = reconstruction.picture_loss(pictures, targets, weight)

    grad_vertices, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape,
                                                                    colours, views)
    grad_albedo, grad_n, grad_light = reconstruction.shade_backward(grad_colours, albedo, n, light)
    by_normals = reconstruction.vertex_normals_backward(grad_n, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level


# --- the fit ------------------------------------------------------------------------------------


def loss_and_gradients(x, targets, weights=WEIGHTS):
    """The mean loss (5) of Targets, and a Scene of gradients, also of carving and the regularizers.

    ValueError where no surface is left.
    """
    found = surface(x)
    if not len(found.faces):
        raise ValueError("a fit expects a surface, got distances that are nowhere below 0; check "
                         "whether the cameras are right")
    pictures = np.stack([target.picture for target in targets])
    loss, grad_vertices, grad_albedo, grad_light, grad_level = views_loss_and_gradients(
        found.vertices, found.faces, found.albedo, x.light, targets, pictures, weights.coverage)
    by_bumps, by_changes = regularizers_backward(weights, found, x)
    grad_distance, grad_offsets, grad_field = surface_backward(
        grad_vertices + by_bumps, grad_albedo, found.ends, x)
    grad_distance += reconstruction.level_backward(weights.carving * grad_level, found.ends,
                                                   x.distance)
    return loss, Scene(grad_distance + by_changes, grad_offsets, grad_field, grad_light)


def regularizers_backward(weights, found, x):
    """The gradients of bumps, to vertices (V, 3), and of sign changes (7), to distances (G,)."""
    # Both count in cells, so that a weight means the same on any grid.
    cell = 2 / cells(x)
    edges = reconstruction.closed_mesh_edges(found.faces)
    by_bumps = reconstruction.bumps_backward(weights.bumps / cell**2, found.vertices,
                                             found.normals, edges)
    _, by_changes = reconstruction.sign_changes(x.distance / cell, found.ends)
    return by_bumps, by_changes * (weights.sign_changes / len(found.vertices) / cell)


def learning_rates(stage):
    """A Scene of learning rates for each step of a Stage, as lab 9's `descend` takes them."""
    cell = 2 / stage.cells
    falling = [stage.rate * 3**-(step / stage.steps) for step in range(1, stage.steps + 1)]
    return [Scene(*(factor * np.array(RATES) * [cell, cell, 1, 1])) for factor in falling]


def stochastic_gradient(targets, per_step, rng, weights):
    """-> gradient(x), as lab 9's `descend` takes it: of per_step Targets, drawn anew each time.

    Gradients in space are spread by eq. (8), but for the offsets.
    """
    def gradient(x):
        drawn = [targets[k] for k in rng.permutation(len(targets))[:per_step]]
        loss, grad_x = loss_and_gradients(x, drawn, weights)
        return loss, grad_x._replace(distance=reconstruction.spread(grad_x.distance, SPREAD),
                                     albedo=reconstruction.spread(grad_x.albedo, SPREAD))
    return gradient


def fit(capture, stages, seed=0, weights=WEIGHTS, per_step=4, renderer=None, begin=None):
    """Reconstruction, from coarse to fine: yields x, a Scene, after each step, and the loss before
    it, eq. (5) of the views drawn.

    capture is a Capture, stages are Stages. Each step looks at per_step of the views, drawn by the
    seed. renderer: what takes the place of the pipeline, see Target. begin: a Scene in the place of
    `start`.
    """
    rng = np.random.default_rng(seed)
    x = begin
    for stage in stages:
        x = start(stage.cells) if x is None else refine(x, stage.cells)
        targets = targets_of(capture, stage.shrink, stage.samples, renderer)
        gradient = stochastic_gradient(targets, per_step, rng, weights)
        steps = descend(x, gradient, learning_rates(stage), UPDATES, bounded)
        for x, loss in steps:
            yield x, loss
