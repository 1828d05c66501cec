"""Small pictures, gradients and fits of a package's renderer: what a mistake must show in."""
import numpy as np

from course.given import mesh
from course.scenes import fit_bunny, fit_pose, fit_triangle, fit_vertices, small, viewing

RNG = np.random.default_rng(0)
VERTICES, FACES = mesh.icosphere(320)
BUMPY = VERTICES * (1 + 0.3 * np.sin(5 * VERTICES[:, :1]))
COLOURS = RNG.uniform(size=(len(VERTICES), 3))
IMAGE = RNG.uniform(size=(32, 64, 3))
SOUP = np.random.default_rng(3).uniform(-1.5, 1.5, (60, 3)) * [1, 1, 0.6]
FLOOR = np.array([[-3.0, 0, -3], [3, 0, -3], [3, 0, 3], [-3, 0, 3]])
GROUND = np.array([[0, 2, 1], [0, 3, 2]])


def scenes(labs):
    """{name: (mesh, material, view)}."""
    draws = labs.pipeline
    around = np.stack([np.arctan2(BUMPY[:, 0], BUMPY[:, 2]) / (2 * np.pi) + 0.5,
                       0.7 * BUMPY[:, 1] + 0.5], 1)
    corners, squares = small.squares()
    screen = np.array([[2 / small.WIDTH, 0, 0, -1], [0, 2 / small.HEIGHT, 0, -1], [0, 0, 1, 0],
                       [0, 0, 0, 1]])
    ball, coloured = draws.make_mesh(BUMPY, FACES), draws.Colours(COLOURS)

    def seen_from(eye, width=41, height=32, near=0.1):
        view_from_world = labs.transforms.look_at(np.array(eye), np.zeros(3), viewing.UP)
        clip_from_view = labs.transforms.perspective(0.84, width / height, near, 10.0)
        return draws.View(clip_from_view @ view_from_world, width, height,
                          np.array([0.1, 0.2, 0.3]))

    def flat(clip_from_model, width, height):
        return draws.View(clip_from_model, width, height, np.zeros(3))

    return {
        "ties": (draws.make_mesh(corners, squares), draws.Colours(COLOURS[:12]),
                 flat(screen, small.WIDTH, small.HEIGHT)),
        "cut": (ball, coloured, seen_from(small.BUNNY_EYE, near=1.85)),
        "ball": (ball, coloured, seen_from([-1.3, 0.7, 2.2])),
        "textured": (ball, draws.Texture(around, FACES, IMAGE), seen_from([-1.0, 0.4, 1.9])),
        "floor": (draws.make_mesh(FLOOR, GROUND), draws.Texture(0.4 * FLOOR[:, ::2], GROUND, IMAGE),
                  seen_from([0.0, 0.5, 2.5])),
        "inside": (ball, coloured, seen_from([0.1, 0.2, 0.4], near=0.01)),
        "soup": (draws.make_mesh(SOUP, np.arange(60).reshape(20, 3)), draws.Colours(COLOURS[:60]),
                 flat(np.eye(4), 24, 16))}


def shown(labs):
    """Yield (what it is, numbers) of all that a package draws, the quickest first."""
    for name, scene in scenes(labs).items():
        picture, buffers = labs.pipeline.render(*scene)
        yield f"the picture {name}", picture
        goal = np.roll(picture[:, ::-1], 2, 0)
        loss, grad_picture = labs.inverse_rendering.squared_error(picture, goal)
        yield f"the loss {name}", loss
        grads = labs.pipeline.render_backward(grad_picture, buffers, *scene)
        yield f"the gradients {name}", np.concatenate([
            np.ravel(part) for part in (grads.positions, grads.clip_from_model, *grads.material)
            if isinstance(part, np.ndarray)])
    path, _, _ = fit_triangle.fit(labs, fit_triangle.template(labs), True, steps=12)
    yield "the fit of a triangle", path[-1]
    path = fit_vertices.fit(labs, fit_vertices.START, fit_vertices.COLOURS, 2)
    yield "the fit of vertices", path[-1][0]
    path = fit_vertices.fit(labs, fit_vertices.START, fit_vertices.NEARLY_GREY, 2, colours_too=True)
    yield "the fit of vertices and colours", np.hstack(path[-1])
    yield "the fit of a silhouette", silhouette_fit(labs)
    yield "the fit of a pose", fit_pose.fit(labs, 0, proposals=4, stages=((24, 3, 5e-3),))[0]


def silhouette_fit(labs, steps=3, size=32):
    """The path, and the losses, of a ball that becomes the bumpy one, seen from one side."""
    lab9, goal = labs.inverse_rendering, labs.pipeline.make_mesh(BUMPY, FACES)
    camera = viewing.cameras_around(labs, 3)[1]
    target = fit_bunny.silhouette(labs, goal, camera, size)[0]

    def gradient(x):
        picture, *given = fit_bunny.silhouette(labs, goal._replace(positions=x), camera, size)
        loss, grad_picture = lab9.silhouette_loss(picture, target)
        return loss, labs.pipeline.render_backward(grad_picture, *given).positions

    found = lab9.descend(VERTICES, gradient, [0.02] * steps)
    return np.concatenate([np.append(x, loss) for x, loss in found])
