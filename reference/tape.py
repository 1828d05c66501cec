"""A tape: what was computed is written down, and the chain rule goes back along it by itself.

    v_n = f(v_i, v_j, ...)        step n makes a value of earlier ones: i, j < n                 (7)
    grad_i += df/dv_i . grad_n    for each use of v_i: what f_backward(grad_n, v_i, v_j, ...)
                                  returns. From the last step to the first                      (8)
    grad_a = sum of grad_v        over all places of v that a is copied to by broadcasting       (9)
    R = I + 2 (w K + K K) / |q|^2,    K u = (x, y, z) x u       rotation by q = (w, x, y, z)    (10)

A pair is a function and its backward pass, as labs 1 to 9 have them. A tape holds numbers, arrays,
and names of pairs, so it can be read, and played again with other numbers. What was decided, such
as the face at each pixel, is on it as a given value: it has no gradient, and stays when the tape is
played again.

A Var is a place on a tape. Its arithmetic adds steps, as `on_tape` does, so that one writes
formulas as ever. No loop over steps knows what a picture is.

Sources: Baydin et al. 2018, (7) and (8); Shoemake 1985, (10).
"""
from typing import NamedTuple

import numpy as np

from course.given.arrays import masked_scatter

from . import (
    antialiasing,
    interpolation,
    intersections,
    inverse_rendering,
    mipmapping,
    pipeline,
    rasterization,
    rasterizer_gradients,
    transforms,
)


class Step(NamedTuple):
    """One call: the name of a pair, and the places of its arguments on the tape."""

    pair: str
    places: tuple


class Tape(NamedTuple):
    """Steps and values, one of each for a place. A value that was given has the step None."""

    steps: list
    values: list


class Pair(NamedTuple):
    """A function and its backward pass, which takes the gradient first, then the same arguments.

    wrt: the numbers of the arguments that have gradients, in the order in which they are returned.
    """

    forward: object
    backward: object
    wrt: tuple


class Var:
    """A value on a tape. Its arithmetic, with Vars, arrays and numbers, adds steps to the tape."""

    __array_ufunc__ = None  # array * Var asks the Var, and not each number of the array

    def __init__(self, tape, value, step=None):
        self.tape, self.place, self.value = tape, len(tape.values), value
        tape.steps.append(step)
        tape.values.append(value)

    def __add__(self, other):
        return on_tape("add", self, other)

    def __sub__(self, other):
        return self + -1.0 * other

    def __mul__(self, other):
        return on_tape("multiply", self, other)

    def __truediv__(self, other):
        return self * (other ** -1.0)

    def __pow__(self, exponent):
        return on_tape("power", self, exponent)

    def __matmul__(self, other):
        return on_tape("matmul", self, other)

    def __rmatmul__(self, other):
        return on_tape("matmul", other, self)

    def __getitem__(self, index):
        return on_tape("take", self, index)

    @property
    def T(self):
        return on_tape("transpose", self)

    __radd__, __rmul__ = __add__, __mul__


def value_of(x):
    """The value of a Var. What is no Var is its own."""
    return x.value if isinstance(x, Var) else x


def on_tape(name, *arguments):
    """Eq. (7): call a pair by its name -> a Var. What is no Var comes on the tape as given.

    Where nothing is a Var, there is no tape, and the plain value is returned.

    >>> x = Var(Tape([], []), 3.0)
    >>> y = on_tape("multiply", x, 5.0)
    >>> y.value, y.tape.steps
    (np.float64(15.0), [None, None, Step(pair='multiply', places=(0, 1))])
    """
    value = BY_NAME[name].forward(*map(value_of, arguments))
    tape = next((x.tape for x in arguments if isinstance(x, Var)), None)
    if tape is None:
        return value
    found = [x if isinstance(x, Var) else Var(tape, x) for x in arguments]
    return Var(tape, value, Step(name, tuple(x.place for x in found)))


def gradients(result, wanted, grad=1.0):
    """The gradients of a loss, the Var result, with respect to each of the Vars wanted.

    If result is no number, grad has its shape, and the loss is the sum of grad * result.

    >>> x = Var(Tape([], []), 3.0)
    >>> gradients(x * x * x, [x])
    [np.float64(27.0)]
    """
    end = result.place + 1
    grads = backward(tuple(result.tape.steps[:end]), tuple(result.tape.values[:end]), grad)
    return [grads[x.place] for x in wanted]


def summed_to(grad, shape):  # extra 9.12 (2 points)
    """Eq. (9), backward of broadcasting: grad, of the shape of the result -> grad of this shape.

    An array was copied along axes that it lacks, at the left, and along those where its size is 1.

    >>> summed_to(np.array([[1.0, 2.0, 4.0], [8.0, 16.0, 32.0]]), (2, 1))
    array([[ 7.],
           [56.]])
    """
    grad = np.sum(grad, axis=tuple(range(np.ndim(grad) - len(shape))))
    copied = tuple(axis for axis, size in enumerate(shape) if size == 1)
    return grad.sum(copied, keepdims=True)


def multiply_backward(grad, a, b):  # extra 9.13 (1 point)
    """Backward of a * b, whose shapes broadcast: grad -> grad_a, grad_b of their own shapes.

    >>> multiply_backward(np.array([1.0, 10.0]), np.array([2.0, 3.0]), np.array(5.0))
    (array([ 5., 50.]), np.float64(32.0))
    """
    # d(a b) = b da + a db, at each place of the result.
    return summed_to(grad * b, np.shape(a)), summed_to(grad * a, np.shape(b))


def add_backward(grad, a, b):
    """Backward of a + b: grad -> grad_a, grad_b of their own shapes."""
    return summed_to(grad, np.shape(a)), summed_to(grad, np.shape(b))


def matmul_backward(grad, a, b):  # extra 9.14 (2 points)
    """Backward of a @ b, a (N, K) and b (K, M), or b (K,): grad -> grad_a, grad_b.

    >>> a, b = np.array([[2.0, 3.0]]), np.array([[5.0], [7.0]])
    >>> matmul_backward(np.array([[10.0]]), a, b)
    (array([[50., 70.]]), array([[20.],
           [30.]]))
    """
    # y_nm = sum over k of a_nk b_km: grad_a_nk = sum over m of grad_nm b_km, and so for b.
    return (grad @ b.T if b.ndim > 1 else np.outer(grad, b)), a.T @ grad


def take_backward(grad, a, index):  # extra 9.15 (1 point)
    """Backward of a[index], a gather: grad, of the shape of a[index] -> grad_a, of that of a.

    index: an array of integers, of which some may be equal.

    >>> take_backward(np.array([1.0, 2.0, 4.0]), np.array([7.0, 8.0, 9.0]), np.array([2, 0, 2]))
    array([2., 0., 5.])
    """
    # What is taken twice is used twice: (8) sums.
    grad_a = np.zeros(np.shape(a))
    np.add.at(grad_a, index, grad)
    return grad_a


def replay(steps, values):  # extra 9.16 (2 points)
    """Eq. (7), for all steps: the values of a tape whose given ones may have changed -> a tuple.

    values: one for each step. Where the step is None it is given, else it is an old one, or None.
    `BY_NAME[name].forward` is the function of that name.

    >>> replay((None, Step("multiply", (0, 0)), Step("add", (1, 0))), (3.0, None, None))[1:]
    (np.float64(9.0), np.float64(12.0))
    """
    found = list(values)
    for place, step in enumerate(steps):
        if step is not None:
            found[place] = BY_NAME[step[0]].forward(*(found[k] for k in step[1]))
    return tuple(found)


def backward(steps, values, grad=1.0):  # extra 9.17 (4 points)
    """Eq. (8), for all steps: the gradient with respect to each value of a tape -> a tuple.

    grad: that of the last value. 0.0 stands where nothing comes. `BY_NAME[name]` has the field
    backward, which takes a gradient and then the arguments of the step. It returns the gradients
    for those whose numbers are in the field wrt: a tuple, or an array if it is one alone.

    >>> backward((None, Step("multiply", (0, 0)), Step("add", (1, 0))), (3.0, 9.0, 12.0))
    (np.float64(7.0), np.float64(1.0), 1.0)
    """
    grads = [0.0] * len(steps)
    grads[-1] = grad
    for place in reversed(range(len(steps))):
        if steps[place] is not None and np.any(grads[place]):
            name, places = steps[place]
            pair = BY_NAME[name]
            parts = pair.backward(grads[place], *(values[k] for k in places))
            for argument, part in zip(pair.wrt, parts if isinstance(parts, tuple) else (parts,),
                                      strict=True):
                grads[places[argument]] = grads[places[argument]] + part
    return tuple(grads)


def rotation(q):
    """Eq. (10) for q (4,), of any length but 0 -> R (3, 3). It is an array if q is one, else a Var.

    Nothing but +, *, /, @ and q[k]: so it has a gradient. AXES (3, 3, 3) are the K of the axes.

    >>> rotation(np.array([2.0, 0.0, 0.0, 2.0])) @ np.array([1.0, 5.0, 7.0])
    array([-5.,  1.,  7.])
    """
    K = q[1] * AXES[0] + q[2] * AXES[1] + q[3] * AXES[2]
    square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    return np.eye(3) + 2.0 * (q[0] * K + K @ K) / square


def render(mesh, material, view):
    """`pipeline.render` on a tape -> the picture (H, W, C), a Var.

    Any array of floats in mesh, material and view may be a Var. What decides, `rasterize` and
    `all_pairs`, is no step: it gets values, and what it returns is given.
    """
    clip = on_tape("transform", on_tape("to_homogeneous", mesh.positions), view.clip_from_model)
    face_index, depth = rasterization.rasterize(value_of(clip), mesh.faces, view.width, view.height)
    seen = face_index >= 0
    weights = on_tape("barycentrics", face_index, clip, mesh.faces)
    if isinstance(material, pipeline.Texture):
        change = on_tape("barycentrics_derivatives", face_index, clip, mesh.faces)
        uv_at = material.uv, material.uv_faces, face_index
        at = on_tape("take", on_tape("interpolate", *uv_at, weights), seen)
        footprint = on_tape("take", on_tape("interpolate_derivatives", *uv_at, change), seen)
        colour = on_tape("masked_scatter", on_tape("texture", material.image, at, footprint, 0.0,
                                                   material.filter_mode), seen)
    else:
        colour = on_tape("interpolate", material.colours, mesh.faces, face_index, weights)
    colour = on_tape("add", colour, view.background * ~seen[..., None])
    pairs = intersections.all_pairs(face_index, depth, value_of(clip), mesh.faces, mesh.opposite)
    points = on_tape("points", pairs, face_index.shape, clip, mesh.faces)
    return on_tape("blend_pairs", colour, pairs, points)


def render_and_back(mesh, material, view, grad_picture):
    """What `pipeline.render` and `render_backward` return, by the tape -> picture, Gradients."""
    tape = Tape([], [])
    names = [name for name in material._fields if name in ("colours", "uv", "image")]
    parts = [Var(tape, getattr(material, name)) for name in names]
    positions, matrix = Var(tape, mesh.positions), Var(tape, view.clip_from_model)
    picture = render(mesh._replace(positions=positions),
                     material._replace(**dict(zip(names, parts, strict=True))),
                     view._replace(clip_from_model=matrix))
    grad_positions, grad_matrix, *grad_parts = gradients(
        picture, [positions, matrix, *parts], grad_picture)
    grads = dict(zip(names, grad_parts, strict=True))
    grad_material = type(material)(*(grads.get(name) for name in material._fields))
    return picture.value, pipeline.Gradients(grad_positions, grad_material, grad_matrix)


def blend(colour, pairs, points):
    """`blend_pairs` as a function of the points, too."""
    placed = antialiasing.place_ends(pairs, points, colour.shape[:2])
    return antialiasing.blend_pairs(colour, placed)


def blend_backward(grad, colour, pairs, points):
    """Backward of `blend`: grad (H, W, C) -> grad_colour (H, W, C), grad_points (V, 4)."""
    return antialiasing.blend_pairs_backward(
        grad, colour, antialiasing.place_ends(pairs, points, colour.shape[:2]), points)


AXES = np.stack([inverse_rendering.cross_matrix(axis) for axis in np.eye(3)])

BY_NAME = {
    "add": Pair(np.add, add_backward, (0, 1)),
    "multiply": Pair(np.multiply, multiply_backward, (0, 1)),
    "power": Pair(np.power, lambda grad, a, n: grad * n * a ** (n - 1), (0,)),
    "matmul": Pair(np.matmul, matmul_backward, (0, 1)),
    "transpose": Pair(np.transpose, lambda grad, a: grad.T, (0,)),
    "take": Pair(lambda a, index: a[index], take_backward, (0,)),
    "positive": Pair(lambda a: np.maximum(a, 0.0), lambda grad, a: grad * (a > 0), (0,)),
    "masked_scatter": Pair(masked_scatter, lambda grad, rows, mask: grad[mask], (0,)),
    "to_homogeneous": Pair(transforms.to_homogeneous, lambda grad, points: grad[:, :3], (0,)),
    "transform": Pair(transforms.transform, transforms.transform_backward, (0, 1)),
    "barycentrics": Pair(interpolation.barycentrics,
                         rasterizer_gradients.barycentrics_backward, (1,)),
    "barycentrics_derivatives": Pair(
        interpolation.barycentrics_derivatives,
        rasterizer_gradients.barycentrics_derivatives_backward, (1,)),
    "interpolate": Pair(interpolation.interpolate, interpolation.interpolate_backward, (0, 3)),
    "interpolate_derivatives": Pair(
        interpolation.interpolate_derivatives,
        interpolation.interpolate_derivatives_backward, (0, 3)),
    "texture": Pair(mipmapping.texture, mipmapping.texture_backward, (0, 1, 2, 3)),
    "points": Pair(intersections.points, intersections.points_backward, (2,)),
    "blend_pairs": Pair(blend, blend_backward, (0, 2)),
    "squared_error": Pair(
        lambda picture, target: inverse_rendering.squared_error(picture, target)[0],
        lambda grad, picture, target: grad * inverse_rendering.squared_error(picture, target)[1],
        (0,)),
}
