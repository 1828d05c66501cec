"""A ball becomes the bunny, of which nothing is known but 20 silhouettes (lab 9)."""
import time

import numpy as np

from ..given import image, mesh
from . import drawing, viewing
from .portrait import BUNNY_EYE


def fit_bunny(labs):
    """A ball becomes the bunny by 20 silhouettes (lab 9)."""
    for name, weight in ("with", 0.02), ("without", 0.0):
        start = time.process_time()
        path, _ = fit(labs, weight)
        yield f"{name} a regularizer, {time.process_time() - start:.0f} s:", None
        yield from seen_anew(labs, path, "0.98" if weight else None)
        yield "  steps 0, 30, 100, 300", drawing.save("fit_bunny", name, stages(labs, path))


def fit(labs, weight, steps=300, size=128, seed=0):
    """The ball's vertices move until its silhouettes are the bunny's, by Adam, with weight times
    the Laplacian energy added to the loss. -> what `carve` returns.
    """
    lab9 = labs.inverse_rendering
    edges, _ = mesh.edges(ball()[1])
    schedule = lab9.decay(0.02, 0.1, steps)

    def penalty_backward(x):
        return lab9.uniform_laplacian_energy_backward(weight, x, edges)

    return carve(labs, penalty_backward, lab9.adam_step, schedule, size, seed)


def carve(labs, penalty_backward, update, schedule, size, seed):
    """Each step descends the losses of 4 of the 20 views and a penalty.

    update and schedule: as in lab 9's `descend`.

    -> vertices (steps + 1, V, 3), the losses (steps,) of the silhouettes, each a mean of 4.
    """
    lab9, rng, (start, faces) = labs.inverse_rendering, np.random.default_rng(seed), ball()
    cameras = viewing.cameras_around(labs, 20)
    targets = silhouettes(labs, *drawing.unit_bunny(), cameras, size)
    white = labs.pipeline.make_mesh(start, faces)

    def gradient(x):
        total, grad_x = 0, penalty_backward(x)
        for view in rng.permutation(20)[:4]:
            picture, *given = silhouette(labs, white._replace(positions=x), cameras[view], size)
            loss, grad_picture = lab9.silhouette_loss(picture, targets[view])
            total += loss / 4
            grad_x += labs.pipeline.render_backward(grad_picture / 4, *given).positions
        return total, grad_x

    path, losses = drawing.descended(labs, start, gradient, schedule, update)
    return np.array(path), losses


def ball():
    """Where the bunny begins: a sphere around the origin, of 1280 faces -> vertices, faces."""
    vertices, faces = mesh.icosphere(1280)
    return 0.6 * vertices, faces


def silhouettes(labs, vertices, faces, cameras, size):
    """A mesh in white on black, for each of the cameras: a list of pictures (size, size, 1)."""
    white = labs.pipeline.make_mesh(vertices, faces)
    return [silhouette(labs, white, camera, size)[0] for camera in cameras]


def silhouette(labs, white, clip_from_world, size):
    """A Mesh in white on black: the picture (size, size, 1), and what `render_backward` takes."""
    return drawing.on_black(labs, white, np.ones((len(white.positions), 1)), clip_from_world, size)


def shared_silhouettes(labs, shape, other, cameras, size=256):
    """Intersection over union of two meshes' silhouettes, for each of the cameras (N,)."""
    return np.array([image.intersection_over_union(
        drawing.seen_mask(labs, *shape, camera, size),
        drawing.seen_mask(labs, *other, camera, size)) for camera in cameras])


def new_views(labs, vertices):
    """Intersection over union with the bunny in 50 views that the fit did not have: (50,)."""
    cameras, (_, faces) = viewing.random_cameras(labs, 50), ball()
    return shared_silhouettes(labs, (vertices, faces), drawing.unit_bunny(), cameras)


def seen_anew(labs, path, goal=None):
    """What new views say about the end of a fit, and how much of it is folded."""
    ious, (_, faces) = new_views(labs, path[-1]), ball()
    reached = [(goal, ious.mean() >= float(goal))] if goal else []
    yield f"  IoU of new views {ious.mean():.4f}", None, *reached
    yield f"  {ious.min():.4f} in the worst of {len(ious)}", None
    yield f"  {folded_edges(path[-1], faces):.1%} of edges folded", None


def folded_edges(vertices, faces):
    """The part of a mesh's edges where it turns by more than 90 degrees: many are a tangle."""
    normal, pairs = mesh.face_normals(vertices, faces), mesh.edge_faces(faces)
    return ((normal[pairs[:, 0]] * normal[pairs[:, 1]]).sum(1) < 0).mean()


def stages(labs, path):
    """The ball on its way, after 0, 30, 100 and all steps, side by side."""
    _, faces = ball()
    pictures = []
    for vertices in path[[0, 30, 100, -1]]:
        clip = viewing.clip_positions(labs, vertices, BUNNY_EYE)
        pictures.append(drawing.smooth(labs, vertices, faces, clip))
    return np.hstack(pictures)
