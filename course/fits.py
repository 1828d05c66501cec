"""Five scenes found from their pictures, with lab 9: what the demo prints and notebook 09 plots.

Each fit is a function of the labs' modules. It takes what was known, a seed or a start, and a
number of steps; it gives back arrays: the course of the fit, step by step, and where it ended.
Fits of random things are reproducible: the same seed gives the same numbers.
"""
import numpy as np

# A triangle, in pixels of a picture of SIDE x SIDE; its colour is 1, the background's is 0.

SIDE = 64
TEMPLATE = np.array([[50.0, 50.0], [10.0, 38.0], [38.0, 8.0]])
START = np.array([[42.0, 58.0], [21.0, 22.0], [56.0, 26.0]])


def triangle(labs, template, antialiased, steps=300):
    """Three vertices move until the triangle looks like its template (SIDE, SIDE, 1).

    -> vertices (steps + 1, 3, 2) in pixels, at first START; losses, gradients (steps, 3, 2).
    """
    lab9, faces = labs.inverse_rendering, np.array([[0, 1, 2]])
    opposite = labs.antialiasing.opposite_vertices(faces)
    colours, background = np.ones((3, 1)), np.zeros(1)
    x, losses, gradients = [START], [], []
    mean = square = np.zeros(START.shape)
    for step in range(1, steps + 1):
        clip = clip_of_pixels(x[-1])
        colour, *seen = lab9.shade(clip, faces, colours, SIDE, SIDE, background)
        face_index, depth, barycentric = seen
        edges = face_index, depth, clip, faces, opposite
        picture = labs.antialiasing.antialias(colour, *edges) if antialiased else colour
        losses.append(lab9.squared_error(picture, template))

        grad_clip = 0
        grad_colour = lab9.squared_error_backward(1.0, picture, template)
        if antialiased:
            grad_colour, grad_clip = labs.antialiasing.antialias_backward(grad_colour, colour,
                                                                          *edges)
        inside, _ = lab9.shade_backward(grad_colour, clip, faces, colours, face_index, barycentric)
        gradients.append((grad_clip + inside)[:, :2] * 2 / SIDE)
        rate = 0.6 * 0.01**(step / steps)
        x_next, mean, square = lab9.adam_step(x[-1], gradients[-1], mean, square, step, rate)
        x.append(x_next)
    return np.array(x), np.array(losses), np.array(gradients)


def template(labs):
    """TEMPLATE as a picture (SIDE, SIDE, 1): its exact area in each pixel (lab 3)."""
    return labs.sampling.pixel_coverage(TEMPLATE, SIDE, SIDE)[..., None]


def clip_of_pixels(points):
    """points (V, 2) on a screen of SIDE x SIDE -> clip (V, 4), w = 1, all equally deep."""
    ones = np.ones((len(points), 1))
    return np.concatenate([points * 2 / SIDE - 1, 0 * ones, ones], 1)


# A cube of 8 coloured vertices from tiny pictures, as in nvdiffrast's sample: shape and colours.

CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
CUBE_FACES = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                       [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])


def cube(labs, size, seed, steps=1000):
    """A cube seen in one random pose at every step, in size x size pixels; position is CORNERS -
    1/2, colour is CORNERS: at first the one is wrong by up to 1/2, the other is noise.

    -> errors (steps + 1,), the mean distance of the vertices from the cube's; positions (8, 3),
    colours (8, 3) at the end.
    """
    lab9, rng = labs.inverse_rendering, np.random.default_rng(seed)
    opposite = labs.antialiasing.opposite_vertices(CUBE_FACES)
    screen = size, size, np.zeros(3), opposite
    x = CORNERS - 0.5 + rng.uniform(-0.5, 0.5, (8, 3)), rng.uniform(0, 1, (8, 3))
    mean = square = (np.zeros((8, 3)),) * 2
    errors = [cube_error(x[0])]
    for step in range(1, steps + 1):
        clip_from_model = cube_camera(labs) @ random_pose(labs, rng, 0.25)
        target, _ = lab9.render(CORNERS - 0.5, CUBE_FACES, CORNERS, clip_from_model, *screen)
        scene = x[0], CUBE_FACES, x[1], clip_from_model
        picture, buffers = lab9.render(*scene, *screen)
        grad_picture = lab9.squared_error_backward(1.0, picture, target)
        *grad_x, _ = lab9.render_backward(grad_picture, buffers, *scene, opposite)
        rate = 1e-2 * max(0.01, 10**(-0.0005 * (step - 1)))
        x, mean, square = zip(*(lab9.adam_step(*each, step, rate)
                                for each in zip(x, grad_x, mean, square, strict=True)), strict=True)
        errors.append(cube_error(x[0]))
    return np.array(errors), *x


def cube_picture(labs, positions, colours, clip_from_model, size):
    """What a cube of CUBE_FACES looks like on black, in colours from 0 to 1: (size, size, 3)."""
    opposite = labs.antialiasing.opposite_vertices(CUBE_FACES)
    picture, _ = labs.inverse_rendering.render(positions, CUBE_FACES, colours, clip_from_model,
                                               size, size, np.zeros(3), opposite)
    return np.clip(picture, 0, 1)


def cube_error(positions):
    """How far vertices (8, 3) are from those of a cube of side 1: the mean of their distances."""
    return np.linalg.norm(np.abs(positions) - 0.5, axis=1).mean()


def cube_camera(labs, distance=3.5):
    """clip_from_world (4, 4) of the sample: it sees 0.4 to each side of the axis at distance 1."""
    away = labs.transforms.translate(np.array([0.0, 0.0, -distance]))
    return labs.transforms.frustum(-0.4, 0.4, -0.4, 0.4, 1.0, 50.0) @ away


def random_pose(labs, rng, shift=0.0):
    """Any turn is as likely as any other, then a shift by up to so much along x, y, z: (4, 4)."""
    turn = labs.transforms.look_at(np.zeros(3), rng.normal(size=3), rng.normal(size=3))
    return labs.transforms.translate(rng.uniform(-shift, shift, 3)) @ turn
