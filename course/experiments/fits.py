"""Scenes found from their pictures: what the demo prints and notebooks 09, 10, 13, 15 and 16 plot.

Each fit is a function of the labs' modules. It takes what was known, a seed or a start, and a
number of steps; it gives back arrays: the course of the fit, step by step, and where it ended.
Fits of random things are reproducible: the same seed gives the same numbers.
"""
import itertools
from typing import NamedTuple

import numpy as np

from ..given import distances, image, mesh

# A triangle, in pixels of a picture of SIDE x SIDE; its colour is 1, the background's is 0.

SIDE = 64
TEMPLATE = np.array([[50.0, 50.0], [10.0, 38.0], [38.0, 8.0]])
START = np.array([[42.0, 58.0], [21.0, 22.0], [56.0, 26.0]])


def triangle(labs, template, antialiased, steps=300):
    """Three vertices move until the triangle looks like its template (SIDE, SIDE, 1).

    -> vertices (steps + 1, 3, 2) in pixels, at first START; losses, gradients (steps, 3, 2).
    """
    lab9, pipeline, gradients = labs.inverse_rendering, labs.pipeline, []
    mesh, surface, view = triangle_scene(labs)

    def gradient(x):
        moved = mesh._replace(positions=np.pad(x, ((0, 0), (0, 1))))
        picture, buffers = pipeline.render(moved, surface, view)
        picture = picture if antialiased else buffers.colour
        grad_picture = lab9.squared_error_backward(1.0, picture, template)
        backward = pipeline.render_backward if antialiased else without_edges(labs)[1]
        gradients.append(backward(grad_picture, buffers, moved, surface, view).positions[:, :2])
        return lab9.squared_error(picture, template), gradients[-1]

    x, losses = zip(*lab9.descend(START, gradient, triangle_schedule(steps)), strict=True)
    return np.array([START, *x]), np.array(losses), np.array(gradients)


def triangle_scene(labs):
    """A white triangle on black, in pixels of a screen of SIDE x SIDE: Mesh, Colours, View."""
    pipeline = labs.pipeline
    mesh = pipeline.make_mesh(np.pad(START, ((0, 0), (0, 1))), np.array([[0, 1, 2]]))
    clip_from_pixels = np.diag([2 / SIDE, 2 / SIDE, 1.0, 1.0])
    clip_from_pixels[:2, 3] = -1
    return mesh, pipeline.Colours(np.ones((3, 1))), pipeline.View(clip_from_pixels, SIDE, SIDE,
                                                                  np.zeros(1))


def triangle_schedule(steps):
    """The learning rate of each step of the triangle's fits, in pixels."""
    return [0.6 * 0.01**(step / steps) for step in range(1, steps + 1)]


def template(labs):
    """TEMPLATE as a picture (SIDE, SIDE, 1): its exact area in each pixel (lab 3)."""
    return labs.sampling.pixel_coverage(TEMPLATE, SIDE, SIDE)[..., None]


# A cube of 8 coloured vertices from tiny pictures, as in nvdiffrast's sample: shape and colours.

CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SQUARES = np.array([[0, 2, 1, 3], [4, 5, 6, 7], [0, 1, 4, 5],
                    [2, 6, 3, 7], [0, 4, 2, 6], [1, 3, 5, 7]])
HALVES = np.array([[0, 1, 2], [2, 1, 3]])
CUBE_FACES = SQUARES[:, HALVES].reshape(12, 3)


class Cube(NamedTuple):
    """What is unknown about a cube: positions (8, 3), colours (8, 3)."""

    positions: np.ndarray
    colours: np.ndarray


CUBE = Cube(CORNERS - 0.5, CORNERS)  # the cube to find


def cube(labs, size, seed, steps=1000):
    """A cube seen in one random pose at every step, in size x size pixels: at first its positions
    are wrong by up to 1/2, and its colours are noise.

    -> errors (steps + 1,), the mean distance of the vertices from the cube's; losses (steps,);
    positions (8, 3), colours (8, 3) at the end.
    """
    lab9, pipeline, rng = labs.inverse_rendering, labs.pipeline, np.random.default_rng(seed)
    x = Cube(CUBE.positions + rng.uniform(-0.5, 0.5, (8, 3)), rng.uniform(0, 1, (8, 3)))

    def gradient(x):
        clip_from_model = cube_camera(labs) @ random_pose(labs, rng, 0.25)
        target, *_ = cube_seen(labs, CUBE, clip_from_model, size)
        picture, *given = cube_seen(labs, x, clip_from_model, size)
        grad_picture = lab9.squared_error_backward(1.0, picture, target)
        grads = pipeline.render_backward(grad_picture, *given)
        return lab9.squared_error(picture, target), Cube(grads.positions, grads.surface.colours)

    rates = [1e-2 * max(0.01, 10**(-0.0005 * step)) for step in range(steps)]
    errors, losses = [cube_error(x.positions)], []
    for x, loss in lab9.descend(x, gradient, rates):  # noqa: B020
        errors.append(cube_error(x.positions))
        losses.append(loss)
    return np.array(errors), np.array(losses), *x


def cube_seen(labs, x, clip_from_model, size):
    """A Cube on black, (size, size, 3), and what `render_backward` takes."""
    given = (labs.pipeline.make_mesh(x.positions, CUBE_FACES), labs.pipeline.Colours(x.colours),
             labs.pipeline.View(clip_from_model, size, size, np.zeros(3)))
    picture, buffers = labs.pipeline.render(*given)
    return picture, buffers, *given


def cube_picture(labs, positions, colours, clip_from_model, size):
    """What a cube of CUBE_FACES looks like on black, in colours from 0 to 1: (size, size, 3)."""
    picture, *_ = cube_seen(labs, Cube(positions, colours), clip_from_model, size)
    return np.clip(picture, 0, 1)


def cube_error(positions):
    """How far vertices (8, 3) are from those of a cube of side 1: the mean of their distances."""
    return np.linalg.norm(np.abs(positions) - 0.5, axis=1).mean()


def cube_camera(labs, distance=3.5):
    """clip_from_world (4, 4) of the sample: it sees 0.4 to each side of the axis at distance 1."""
    away = labs.transforms.translate(np.array([0.0, 0.0, -distance]))
    return labs.transforms.frustum(-0.4, 0.4, -0.4, 0.4, 1.0, 50.0) @ away


def random_pose(labs, rng, shift=0.0):
    """Any rotation, all as likely, then a shift by up to so much along x, y, z: (4, 4)."""
    rotation = labs.transforms.look_at(np.zeros(3), rng.normal(size=3), rng.normal(size=3))
    return labs.transforms.translate(rng.uniform(-shift, shift, 3)) @ rotation


# The pose of a known cube. It has 24 vertices, so that each side has a colour of its own.

BLOCK = CORNERS[SQUARES].reshape(24, 3) - 0.5
BLOCK_FACES = np.arange(24).reshape(6, 4)[:, HALVES].reshape(12, 3)
BLOCK_COLOURS = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1],
                          [1, 1, 0], [1, 0, 1], [0, 1, 1]]).repeat(4, 0)


def pose(labs, seed, proposals=400, symmetries=None, stages=((64, 40, 5e-3), (256, 40, 3e-4))):
    """A cube's rotation, from one picture: greedy random search, in pictures of 16 x 16, then Adam,
    in each stage (size, steps, first rate).

    symmetries (K, 4) are rotations to try beside small ones, `cube_symmetries` if None.
    -> rotations (proposals + all steps + 1, 4), quaternions from start to end; the right one (4,).
    """
    rng = np.random.default_rng(seed)
    start, goal = (q / np.linalg.norm(q) for q in rng.normal(size=(2, 4)))
    symmetries = cube_symmetries() if symmetries is None else symmetries
    rotations = pose_search(labs, rng, start, goal, proposals, symmetries)
    for size, steps, rate in stages:
        rotations += pose_descent(labs, rotations[-1], goal, size, steps, rate)
    return np.array(rotations), goal


def pose_search(labs, rng, start, goal, proposals, symmetries):
    """Greedy: a proposed rotation is taken if its picture is nearer to the goal's. They become
    smaller and smaller; every second one is one of the symmetries besides.
    """
    lab9, rotations = labs.inverse_rendering, [start]
    target = block_picture(labs, goal, 16)[0]
    least = lab9.squared_error(block_picture(labs, start, 16)[0], target)
    for n in range(proposals):
        half_angle = np.pi / 2 * rng.uniform() * 0.01**(n / proposals)
        axis = rng.normal(size=3)
        axis *= np.sin(half_angle) / np.linalg.norm(axis)
        proposal = lab9.quaternion_product(rotations[-1], np.append(np.cos(half_angle), axis))
        if n % 2:
            symmetry = symmetries[rng.integers(len(symmetries))]
            proposal = lab9.quaternion_product(proposal, symmetry)
        loss = lab9.squared_error(block_picture(labs, proposal, 16)[0], target)
        rotations.append(proposal if loss < least else rotations[-1])
        least = min(loss, least)
    return rotations


def pose_descent(labs, q, goal, size, steps, rate):
    """Adam on the quaternion, in pictures of size x size; the rate falls to a 50th."""
    lab9, target = labs.inverse_rendering, block_picture(labs, goal, size)[0]

    def gradient(q):
        picture, *given = block_picture(labs, q, size)
        grad_picture = lab9.squared_error_backward(1.0, picture, target)
        grad_matrix = labs.pipeline.render_backward(grad_picture, *given).clip_from_model
        grad_q = lab9.quaternion_matrix_backward(cube_camera(labs).T @ grad_matrix, q)
        return lab9.squared_error(picture, target), grad_q

    found = lab9.descend(q, gradient, lab9.decay(rate, 0.02, steps),
                         project=lambda q: q / np.linalg.norm(q))
    return [q for q, _ in found]


def block_picture(labs, q, size):
    """The cube with coloured sides, rotated by q: its picture, and what `render_backward` takes."""
    clip_from_model = cube_camera(labs) @ labs.inverse_rendering.quaternion_matrix(q)
    given = (labs.pipeline.make_mesh(BLOCK, BLOCK_FACES), labs.pipeline.Colours(BLOCK_COLOURS),
             labs.pipeline.View(clip_from_model, size, size, np.zeros(3)))
    picture, buffers = labs.pipeline.render(*given)
    return picture, buffers, *given


def cube_symmetries():
    """The 24 rotations that bring a cube back to itself, as quaternions (24, 4)."""
    signs = np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T
    thirds = np.concatenate([np.ones((8, 1)), signs], 1)  # about a diagonal
    pairs = [np.eye(4)[i] + sign * np.eye(4)[j] for i in range(4) for j in range(i) for sign in
             (-1, 1)]
    symmetries = np.concatenate([np.eye(4), thirds, pairs])
    return symmetries / np.linalg.norm(symmetries, axis=1, keepdims=True)


# The texture of a known globe, from views so far away that most pixels hold many texels.


def globe(steps=16):
    """A unit sphere in steps of latitude and twice as many of longitude: vertices, faces, uv."""
    v, u = np.divmod(np.arange((steps + 1) * (2 * steps + 1)), 2 * steps + 1)
    u, v = u / (2 * steps), v / steps
    corner = np.flatnonzero((u < 1) & (v < 1))[:, None]
    south, north = corner[corner[:, 0] > 2 * steps], corner[corner[:, 0] < corner.max() - 2 * steps]
    up = 2 * steps + 1
    faces = np.concatenate([south + [0, 1, up + 1], north + [0, up + 1, up]])
    return directions(u, v), faces, np.stack([u, v], -1)


def directions(u, v):
    """u (east) and v (north), from 0 to 1 (...) -> points of the unit sphere (..., 3)."""
    longitude, latitude = 2 * np.pi * u, np.pi * (v - 0.5)
    return np.stack([np.cos(latitude) * np.sin(longitude), np.sin(latitude),
                     np.cos(latitude) * np.cos(longitude)], -1)


def planet(rows, seed=3):
    """A texture (rows, 2 rows, 3) for the globe: sea, land and ice, out of random waves."""
    rng, height = np.random.default_rng(seed), 0
    v, u = np.meshgrid((np.arange(rows) + 0.5) / rows, (np.arange(2 * rows) + 0.5) / (2 * rows),
                       indexing="ij")
    for octave in np.arange(6).repeat(6):
        wave = directions(u, v) @ rng.normal(size=3) * 1.7 * 2**octave
        height = height + np.sin(wave + rng.uniform(0, 7)) / 1.7**octave
    relief = np.clip(height / 4, -1, 1)[..., None]
    sea = np.array([0.2, 0.3, 0.55]) + 0.15 * relief
    land = np.array([0.25, 0.45, 0.15]) + relief * np.array([0.6, 0.3, 0.3])
    colour = np.where(height[..., None] > 0.6, land, sea)
    colour[np.abs(v - 0.5) + relief[..., 0] * 0.04 > 0.38] = 0.95
    return np.clip(colour, 0, 1)


def globe_views(labs, texture, count, seed=0, size=64):
    """The globe from count random sides, 1.5 to 50 away: for each, of the pixels that see it, uv
    (N, 2), their change (N, 2, 2), and the colour (N, 3): a mean of 4 x 4 samples, each trilinear.
    """
    rng, views = np.random.default_rng(seed), []
    for _ in range(count):
        pose = random_pose(labs, rng)
        clip_from_view = labs.transforms.frustum(-0.04, 0.04, -0.04, 0.04, 0.1, 100.0)
        away = labs.transforms.translate(np.array([0.0, 0.0, -rng.uniform(1.5, 50)]))
        clip_from_model = clip_from_view @ away @ pose
        fine, *where = globe_footprints(labs, clip_from_model, 4 * size)
        samples = np.zeros((4 * size, 4 * size, 4))
        samples[fine, 3] = 1
        samples[fine, :3] = labs.mipmapping.texture(texture, *where, filter="linear-mipmap-linear")
        samples = samples.reshape(size, 4, size, 4, 4).mean((1, 3))
        seen, at, footprint = globe_footprints(labs, clip_from_model, size)
        known = samples[seen, 3] > 0
        colour = samples[seen][known]
        views.append((at[known], footprint[known], colour[:, :3] / colour[:, 3:]))
    return views


def globe_footprints(labs, clip_from_model, size):
    """seen (size, size), and of the seen pixels (u, v) (N, 2) and its change (N, 2, 2)."""
    vertices, faces, uv = globe()
    clip = labs.pipeline.to_clip(vertices, clip_from_model)
    seen = labs.pipeline.visible(clip, faces, size, size)
    seen = labs.pipeline.with_derivatives(seen, faces)
    return seen.face_index >= 0, *labs.pipeline.footprints(uv, faces, seen)


def texture(labs, truth, views, filter, size=64, first_rate=1e-2):
    """A grey texture becomes the globe's: a step of Adam for each of the views, seen through one of
    lab 6's filters. The rate falls to a tenth.

    -> psnr (steps,), `globe_psnr` after each step; the texture, like truth.
    """
    lab6, lab9, coming = labs.mipmapping, labs.inverse_rendering, iter(views)

    def gradient(x):
        at, footprint, colour = next(coming)
        seen = lab6.texture(x, at, footprint, filter=filter)
        grad_seen = 2 * (seen - colour) / (3 * size**2)  # squared error, the rest of it is black
        grad_x, *_ = lab6.texture_backward(grad_seen, x, at, footprint, filter=filter)
        return ((seen - colour)**2).sum() / (3 * size**2), grad_x

    psnr, rates = [], lab9.decay(first_rate, 0.1, len(views))
    for x, _ in lab9.descend(np.full(truth.shape, 0.5), gradient, rates):
        psnr.append(globe_psnr(x, truth))
    return np.array(psnr), x


def globe_psnr(texture, truth):
    """In decibels, for colours from 0 to 1. A texel counts by its area on the globe: the rows at
    the poles hold as many as the equator's, and show nothing.
    """
    area = np.cos(np.pi * ((np.arange(len(truth)) + 0.5) / len(truth) - 0.5))
    return -10 * np.log10(np.average(((texture - truth)**2).mean((1, 2)), weights=area))


# A ball becomes the bunny, of which nothing is known but 20 silhouettes.


def ball():
    """Where the bunny begins: a sphere around the origin, of 1280 faces -> vertices, faces."""
    vertices, faces = mesh.icosphere(1280)
    return 0.6 * vertices, faces


def rabbit():
    """The Stanford bunny, scaled to the unit sphere -> vertices, faces."""
    vertices, faces = mesh.bunny()
    return mesh.normalize(vertices), faces


def cameras_around(labs, count, longitude=0.0):
    """Cameras 3 away from the origin, spread evenly on a spiral from pole to pole that starts at
    longitude, in turns: clip_from_world (count, 4, 4).
    """
    golden, step = (1 + np.sqrt(5)) / 2, np.arange(count) + 0.5
    return cameras_at(labs, directions(golden * step + longitude,
                                       np.arccos(1 - 2 * step / count) / np.pi))


def random_cameras(labs, count, seed=0):
    """Cameras 3 away from the origin, from all sides alike: clip_from_world (count, 4, 4)."""
    eyes = np.random.default_rng(seed).normal(size=(count, 3))
    return cameras_at(labs, eyes / np.linalg.norm(eyes, axis=1, keepdims=True))


def cameras_at(labs, sides):
    """Cameras that see the origin from 3 away, on the sides (N, 3): clip_from_world (N, 4, 4)."""
    clip_from_view = labs.transforms.perspective(np.radians(40), 1.0, 0.5, 10.0)
    up = np.array([0.0, 1.0, 0.0])
    return np.array([clip_from_view @ labs.transforms.look_at(3 * side, np.zeros(3), up)
                     for side in sides])


def bunny(labs, weight, steps=300, size=128, seed=0):
    """The ball's vertices move until its silhouettes are the bunny's, by Adam, with weight times
    the Laplacian energy added to the loss. -> what `carve` returns.
    """
    lab9, edges = labs.inverse_rendering, mesh.edges(ball()[1])[0]

    def penalty_backward(x):
        return lab9.uniform_laplacian_energy_backward(weight, x, edges)

    return carve(labs, penalty_backward, lab9.adam_step, (0.02, 0.002), steps, size, seed)


def bunny_by_large_steps(labs, amount, rates, steps=300, size=128, seed=0):
    """The same without a penalty, but with lab 13's large steps. -> what `carve` returns."""
    edges, _ = mesh.edges(ball()[1])

    def move(*state):
        return labs.regularization.large_step(*state, edges, np.ones(len(edges)), amount)

    return carve(labs, np.zeros_like, move, rates, steps, size, seed)


def carve(labs, penalty_backward, update, rates, steps, size, seed):
    """At each step, a sum of the losses of 4 of the 20 views, and a penalty; the rate goes from
    rates[0] to rates[1]. update: as in lab 9's `descend`.

    -> vertices (steps + 1, V, 3), the losses (steps,) of the silhouettes, each a mean of 4.
    """
    lab9, rng, (start, faces) = labs.inverse_rendering, np.random.default_rng(seed), ball()
    cameras = cameras_around(labs, 20)
    targets = silhouettes(labs, *rabbit(), cameras, size)
    white = labs.pipeline.make_mesh(start, faces)

    def gradient(x):
        loss, grad_x = 0, penalty_backward(x)
        for view in rng.permutation(20)[:4]:
            picture, *given = silhouette(labs, white._replace(positions=x), cameras[view], size)
            loss += lab9.silhouette_loss(picture, targets[view]) / 4
            grad_picture = lab9.silhouette_loss_backward(1 / 4, picture, targets[view])
            grad_x += labs.pipeline.render_backward(grad_picture, *given).positions
        return loss, grad_x

    schedule = lab9.decay(rates[0], rates[1] / rates[0], steps)
    x, losses = zip(*lab9.descend(start, gradient, schedule, update), strict=True)
    return np.array([start, *x]), np.array(losses)


def silhouettes(labs, vertices, faces, cameras, size):
    """A mesh in white on black, for each of the cameras: a list of pictures (size, size, 1)."""
    white = labs.pipeline.make_mesh(vertices, faces)
    return [silhouette(labs, white, camera, size)[0] for camera in cameras]


def silhouette(labs, white, clip_from_world, size):
    """A Mesh in white on black: the picture (size, size, 1), and what `render_backward` takes."""
    given = (white, labs.pipeline.Colours(np.ones((len(white.positions), 1))),
             labs.pipeline.View(clip_from_world, size, size, np.zeros(1)))
    picture, buffers = labs.pipeline.render(*given)
    return picture, buffers, *given


def shared_silhouettes(labs, shape, other, cameras, size=256):
    """Intersection over union of two meshes' silhouettes, for each of the cameras (N,)."""
    ious = []
    for camera in cameras:
        a, b = (seen_mask(labs, *each, camera, size) for each in (shape, other))
        ious.append((a & b).sum() / (a | b).sum())
    return np.array(ious)


def folded_edges(vertices, faces):
    """The part of a mesh's edges where it turns by more than 90 degrees: many are a tangle."""
    normal, pairs = mesh.face_normals(vertices, faces), mesh.edge_faces(faces)
    return ((normal[pairs[:, 0]] * normal[pairs[:, 1]]).sum(1) < 0).mean()


# A ball in a ring, as density and colour in a grid (lab 15), on white.

SATURN = ("union", ("torus", 0.68, 0.22), ("sphere", 0.32))
WHITE = np.ones(3)


def saturn_rays(labs, cameras, size, samples=3):
    """Pictures (size, size) of a ball in a ring, each pixel a mean of samples^2 rays; on white.

    -> origins, directions, colours (N, 3) of all pixels of all cameras, one after the other.
    """
    lab15, rays = labs.implicit_surfaces, []
    for camera in cameras:
        origins, directions = lab15.camera_rays(camera, samples * size, samples * size)
        t, _ = lab15.sphere_trace(origins, directions, SATURN, 9.0)
        seen, colours = np.isfinite(t), np.ones(origins.shape)
        at = origins[seen] + t[seen, None] * directions[seen]
        ball, left = np.linalg.norm(at, axis=1) < 0.4, at[:, 0] < 0
        paint = np.select([ball[:, None], left[:, None]], [[0.9, 0.3, 0.2], [0.95, 0.8, 0.3]],
                          [0.25, 0.5, 0.85])
        colours[seen] = paint * (0.7 + 0.3 * lab15.normals(at, SATURN)[:, 1:2])
        colours = colours.reshape(size, samples, size, samples, 3).mean((1, 3)).reshape(-1, 3)
        rays.append((*lab15.camera_rays(camera, size, size), colours))
    return tuple(np.concatenate(part) for part in zip(*rays, strict=True))


def volume_samples(labs, origins, directions, n, count=40):
    """The look-ups of rays in a grid of n^3 cells, 1.2 to 3.8 in front of their origins."""
    points, spacing = labs.implicit_surfaces.ray_samples(origins, directions, 1.2, 3.8, count)
    return labs.implicit_surfaces.grid_weights(points.reshape(-1, 3), n), spacing


def volume_seen(labs, origins, directions, density, colour):
    """What rays (R, 3) see of a grid's density (G,) and colour (G, 3) on white: (R, 3)."""
    n = round(len(density)**(1 / 3)) - 1
    weights, spacing = volume_samples(labs, origins, directions, n)
    return labs.implicit_surfaces.volume_render(
        (weights @ density).reshape(spacing.shape), (weights @ colour).reshape(*spacing.shape, 3),
        spacing, WHITE)


class Volume(NamedTuple):
    """What is unknown about a volume: density (G,), colour (G, 3)."""

    density: np.ndarray
    colour: np.ndarray


def volume_fit(labs, origins, directions, target, n, steps, seed=0, batch=1000):
    """Adam on a grid of n^3 cells: in each step, batch random rays. -> density (G,), colour (G, 3),
    losses (steps,)."""
    lab9, lab15, rng = labs.inverse_rendering, labs.implicit_surfaces, np.random.default_rng(seed)

    def gradient(x):
        rays = rng.integers(len(target), size=batch)
        weights, spacing = volume_samples(labs, origins[rays], directions[rays], n)
        seen = ((weights @ x.density).reshape(spacing.shape),
                (weights @ x.colour).reshape(*spacing.shape, 3), spacing, WHITE)
        output = lab15.volume_render(*seen)
        grad_output = lab9.squared_error_backward(1.0, output, target[rays])
        grad_density, grad_colour = lab15.volume_render_backward(grad_output, *seen)
        return lab9.squared_error(output, target[rays]), Volume(
            weights.T @ grad_density.ravel(), weights.T @ grad_colour.reshape(-1, 3))

    falling = [0.1**(step / steps) for step in range(1, steps + 1)]
    x = Volume(np.full((n + 1)**3, 0.1), np.full(((n + 1)**3, 3), 0.5))
    rates, losses = [Volume(1.0 * part, 0.03 * part) for part in falling], []
    found = lab9.descend(x, gradient, rates, project=lambda x: Volume(
        np.maximum(x.density, 0), np.clip(x.colour, 0, 1)))
    for x, loss in found:  # noqa: B007
        losses.append(loss)
    return *x, np.array(losses)


def volume_surface(density, points, level=5.0):
    """Where a density is level, a surface: numbers for marching, positive outside and at the end of
    the grid."""
    return np.where((np.abs(points) == 1).any(1), level, level - density)


# One silhouette, three gradients (lab 10): the same Adam, start and goal for each of them.


def sweep_outline(labs, clip, faces, size, eps=1e-4):
    """neural_renderer's: 1 where a face is seen, and its sweep."""
    lab10, corners = labs.neural_renderer, labs.neural_renderer.corners_of(clip, faces)
    face_index, *_ = lab10.rasterize(corners, size, size)
    picture = (face_index >= 0).astype(float)

    def backward(grad_picture):
        grad_corners = lab10.sweep_backward(grad_picture[..., None], picture[..., None],
                                            face_index, corners, eps)
        return lab10.clip_backward(lab10.per_vertex(grad_corners, faces, len(clip)), clip)

    return picture, backward


def soft_outline(labs, clip, faces, size, sigma=0.05):
    """SoftRas's: a probability, sigma in pixels^2."""
    lab10, corners = labs.neural_renderer, labs.neural_renderer.corners_of(clip, faces)
    screen = lab10.on_screen(corners, size, size)

    def backward(grad_picture):
        grad_corners, grad_screen = np.zeros(corners.shape), lab10.soft_silhouette_backward(
            grad_picture, screen, sigma)
        grad_corners[..., :2] = grad_screen * size / 2
        return lab10.clip_backward(lab10.per_vertex(grad_corners, faces, len(clip)), clip)

    return lab10.soft_silhouette(screen, size, size, sigma), backward


def blend_outline(labs, clip, faces, size):
    """Lab 8's: white faces on black, antialiased."""
    lab8 = labs.antialiasing
    face_index, depth = labs.scanline.rasterize(clip, faces, size, size)
    edges = face_index, depth, clip, faces, lab8.opposite_vertices(faces)
    colour = (face_index >= 0)[..., None].astype(float)

    def backward(grad_picture):
        return lab8.antialias_backward(grad_picture[..., None], colour, *edges)[1]

    return lab8.antialias(colour, *edges)[..., 0], backward


OUTLINES = {"sweep": sweep_outline, "soft": soft_outline, "blend": blend_outline}


def triangle_by(labs, outline, steps=300):
    """`triangle` by any of the OUTLINES -> vertices (steps + 1, 3, 2) in pixels."""
    lab9, goal, (triangle, _, view) = (labs.inverse_rendering, template(labs)[..., 0],
                                       triangle_scene(labs))

    def gradient(x):
        positions = np.pad(x, ((0, 0), (0, 1)))
        clip = labs.pipeline.to_clip(positions, view.clip_from_model)
        picture, backward = outline(labs, clip, triangle.faces, SIDE)
        grad_clip = backward(lab9.squared_error_backward(1.0, picture, goal))
        grad_positions, _ = labs.pipeline.to_clip_backward(grad_clip, positions,
                                                           view.clip_from_model)
        return lab9.squared_error(picture, goal), grad_positions[:, :2]

    found = lab9.descend(START, gradient, triangle_schedule(steps))
    return np.array([START, *(x for x, _ in found)])


def teapot_camera(labs):
    """clip_from_world (4, 4) of the teapot's portrait."""
    eye, up = np.array([0.4, 0.8, 2.6]), np.array([0.0, 1.0, 0.0])
    view = labs.transforms.look_at(eye, np.zeros(3), up)
    return labs.transforms.perspective(np.radians(44), 1.0, 0.1, 10.0) @ view


def teapot_by(labs, outline, steps=150, size=64, weight=2e-3):
    """A ball's vertices move until its silhouette is the teapot's, in one view of size x size.

    -> vertices (steps + 1, V, 3), faces. The goal is a mean of 4 x 4 samples.
    """
    lab9, pipeline, camera = labs.inverse_rendering, labs.pipeline, teapot_camera(labs)
    goal = labs.msaa.box_resolve(teapot_mask(labs, 4 * size)[..., None] * 1.0, 4)[..., 0]
    vertices, faces = mesh.icosphere(320)
    edges, start = mesh.edges(faces)[0], 0.5 * vertices

    def gradient(x):
        picture, backward = outline(labs, pipeline.to_clip(x, camera), faces, size)
        grad_clip = backward(lab9.silhouette_loss_backward(1.0, picture, goal))
        grad_x, _ = pipeline.to_clip_backward(grad_clip, x, camera)
        return (lab9.silhouette_loss(picture, goal),
                grad_x + lab9.uniform_laplacian_energy_backward(weight, x, edges))

    found = lab9.descend(start, gradient, lab9.decay(0.02, 0.1, steps))
    return np.array([start, *(x for x, _ in found)]), faces


def teapot_mask(labs, size):
    """Where the teapot is seen: bool (size, size)."""
    vertices, faces = mesh.teapot()
    return seen_mask(labs, mesh.normalize(vertices), faces, teapot_camera(labs), size)


def seen_mask(labs, vertices, faces, camera, size):
    """Where a mesh is seen at the pixels' centres: bool (size, size)."""
    clip = labs.pipeline.to_clip(vertices, camera)
    return labs.scanline.rasterize(clip, faces, size, size)[0] >= 0


def teapot_iou(labs, vertices, faces, size=256):
    """Intersection over union of a mesh's silhouette and the teapot's, in fine pictures."""
    a = seen_mask(labs, vertices, faces, teapot_camera(labs), size)
    b = teapot_mask(labs, size)
    return (a & b).sum() / (a | b).sum()


# Shape, albedo and light of objects that the code has never seen, from 24 pictures (lab 16).

BALL_STAGES = (16, 2, 1, 80, 1.0), (24, 2, 1, 60, 0.5), (32, 1, 1, 60, 0.3)  # see lab 16's `fit`
FINE_STAGES = (24, 1, 1, 100, 1.0), (32, 1, 1, 80, 0.5), (48, 1, 2, 120, 0.3)
TWO_RINGS = ("smooth union", 0.1, *(("moved", np.array([x, 0.0, 0.0]), ("torus", 0.34, 0.15))
                                    for x in (-0.4, 0.4)))
RABBIT_SIZE = 0.85


def unseen(labs, name):
    """An object to reconstruct, "ring", "two rings" or "bunny": vertices, faces, albedo (V, 3)."""
    if name == "ring":
        vertices, faces = mesh.torus(60_000, 0.6, 0.25)
    elif name == "two rings":
        points, tetrahedra = labs.implicit_surfaces.tetrahedral_grid(72)
        distance = labs.implicit_surfaces.signed_distance(points, TWO_RINGS)
        vertices, faces, _ = labs.implicit_surfaces.marching_tetrahedra(points, distance,
                                                                        tetrahedra)
    else:
        vertices, faces = mesh.split_longest(*rabbit(), 60_000)
        vertices = RABBIT_SIZE * vertices
    return vertices, faces, paint(vertices)


def paint(points):
    """Soft bands and spots in three colours: points (P, 3) -> albedo (P, 3)."""
    x, y, z = points.T
    band = 0.5 + 0.5 * np.tanh(3 * np.sin(9 * y + 2 * np.sin(4 * x) + 1))[:, None]
    spot = 0.5 + 0.5 * np.tanh(4 * np.sin(7 * x + 1) * np.sin(7 * z) - 1)[:, None]
    cream, teal, coral = np.array([[0.85, 0.72, 0.45], [0.06, 0.35, 0.5], [0.8, 0.2, 0.12]])
    return (1 - spot) * (band * cream + (1 - band) * teal) + spot * coral


def daylight(labs):
    """Sun, sky, and some light from the ground (9, 3)."""
    towards = np.array([[0.5, 0.7, 0.5], [-0.8, 0.3, 0.3], [0.0, -1.0, 0.0], [0.0, 0.4, -0.9]])
    return lamps(labs, towards, [[0.97, 0.88, 0.75], [0.2, 0.3, 0.45], [0.2, 0.12, 0.1],
                                 [0.25, 0.3, 0.4]], 0.12)


def evening(labs):
    """A red sun from the other side, and a blue lamp (9, 3)."""
    towards = np.array([[-0.8, 0.3, -0.5], [0.9, 0.1, 0.4]])
    return lamps(labs, towards, [[1.0, 0.6, 0.35], [0.25, 0.4, 0.75]], 0.15)


def lamps(labs, towards, strength, even):
    """The light (9, 3) of lamps in these directions (N, 3), and of an even sky."""
    lab16 = labs.reconstruction
    towards = towards / np.linalg.norm(towards, axis=1, keepdims=True)
    light = lab16.distant_light(towards, np.array(strength))
    light[0] += even / lab16.C0
    return light


def photographs(labs, vertices, faces, albedo, light, cameras, size, samples=4):
    """Pictures (size, size, 4) of a mesh on white: colour, and coverage; samples^2 to a pixel."""
    pipeline, lab16 = labs.pipeline, labs.reconstruction
    colours = lab16.shade(albedo, mesh.vertex_normals(vertices, faces), light)
    surface = pipeline.Colours(np.hstack([colours, np.ones((len(vertices), 1))]))
    shape, background = pipeline.make_mesh(vertices, faces), np.array([1.0, 1, 1, 0])
    views = [pipeline.View(camera, samples * size, samples * size, background)
             for camera in cameras]
    return [labs.msaa.box_resolve(pipeline.render(shape, surface, view)[0], samples)
            for view in views]


def reconstruction(labs, name, stages, size=128, count=24, **settings):
    """What lab 16's `fit` yields, for pictures of one of the `unseen` objects by daylight."""
    cameras = cameras_around(labs, count)
    pictures = photographs(labs, *unseen(labs, name), daylight(labs), cameras, size)
    return labs.reconstruction.fit(pictures, cameras, WHITE, stages, **settings)


def steps_of(stages):
    """How many steps `fit` takes."""
    return sum(steps for _, _, _, steps, _ in stages)


def decibels(pictures, truth):
    """Colours of pictures (H, W, 4), as seen on a screen, against the truth: mean PSNR in dB."""
    errors = [((image.to_srgb(np.clip(a, 0, 1)) - image.to_srgb(np.clip(b, 0, 1)))[..., :3]**2)
              .mean() for a, b in zip(pictures, truth, strict=True)]
    return -10 * np.log10(np.mean(errors))


def judged(labs, x, name, size=128):
    """How good x is: pieces, genus, distance in parts of the diagonal, dB of 8 new views, dB of
    these in the evening's light, relative error of the light; and the two times two kinds of
    pictures, as found and as they are.
    """
    vertices, faces, albedo = unseen(labs, name)
    found = labs.reconstruction.surface(x)
    mean = [distances.surface_distances(*a, *b)[0] for a, b in
            itertools.permutations([found[:2], (vertices, faces)])]
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    at_truth = distances.closest_points(found[0], vertices, faces)
    scale = labs.reconstruction.best_scale(found[4], paint(at_truth))
    cameras, light = cameras_around(labs, 8, longitude=1.1), daylight(labs)
    pictures = [photographs(labs, *shape, lamp, cameras, size) for shape, lamp in (
        ((*found[:2], found[4]), x[3]), ((vertices, faces, albedo), light),
        ((*found[:2], scale * found[4]), evening(labs)),
        ((vertices, faces, albedo), evening(labs)))]
    return {"pieces, genus": labs.reconstruction.genus(found[1]),
            "distance": np.mean(mean) / diagonal,
            "new views": decibels(*pictures[:2]), "relit": decibels(*pictures[2:]),
            "light": np.linalg.norm(x[3] / scale - light) / np.linalg.norm(light),
            "scale": scale, "pictures": pictures}


def without_edges(labs):
    """The pipeline's `render` and its backward pass, without antialiasing."""
    pipeline = labs.pipeline

    def render(mesh, surface, view):
        _, buffers = pipeline.render(mesh, surface, view)
        return buffers.colour, buffers

    def render_backward(grad_picture, buffers, mesh, surface, view):
        grad_surface, grad_clip = pipeline.shade_backward(grad_picture, buffers, mesh.faces,
                                                          surface)
        grad_positions, grad_matrix = pipeline.to_clip_backward(grad_clip, mesh.positions,
                                                                view.clip_from_model)
        return pipeline.Gradients(grad_positions, grad_surface, grad_matrix)

    return render, render_backward


def portrait(labs, x, camera, size, samples=2):
    """What is found, in the light that is found, and as white clay: (size, 2 size, 3), as shown."""
    vertices, faces, _, _, albedo = labs.reconstruction.surface(x)
    clay = np.full(albedo.shape, 0.8)
    seen = [photographs(labs, vertices, faces, *paint, [camera], size, samples)[0][..., :3]
            for paint in ((albedo, x[3]), (clay, daylight(labs)))]
    return image.to_srgb(np.clip(np.hstack(seen), 0, 1))
