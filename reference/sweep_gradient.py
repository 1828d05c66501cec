"""sweep_gradient: Kato's approximate gradient of outlines.

A pixel sees a face or not, so the picture's derivative with respect to an edge is 0. Kato follows a
line of pixels that an edge crosses. How far must the edge go to reach pixel j, and how much would
the loss fall if I_j became I_beyond, the colour on the other side of the edge?

    g_i = -sum_j max(0, (I_j - I_beyond) . dL/dI_j) / (d_j + eps_j)    for end i of the edge   (7)
    d_j = way_j / share_i,   way_j = (2 / W) (x_j - x_edge)   eps has the sign of the edge's motion
    share_b = (y - a_y) / (b_y - a_y) = 1 - share_a,   x_edge = share_a a_x + share_b b_x      (8)

Moving end i alone by 1 moves the crossing by share_i. Rows of pixels give the gradients in x.
Columns give those in y: they are rows of the transposed picture.

The paper lets no gradient pass where something hides the edge. The kernel, and so this module, asks
for that only where the edge moves out. Two slips of the kernel are not repeated here. For d_j = 0
its eps has one sign on both sides. Its bound for edges that move in may divide by 0.

Sources: Kato, Ushiku, Harada 2018, and a reading of their rasterizer, neural_renderer.
"""
from typing import NamedTuple

import numpy as np

from course.given.arrays import EDGES, chunks, expand, scatter

from . import neural_renderer


def edge_pulls(grad_colour, colour, beyond, way, share, eps):  # step 10.6
    """How do P pixels pull on both ends of their edges? -> the terms of eq. (7), (P, 2).

    The minus is included: their sum over the pixels is g. grad_colour, colour, beyond (P, C):
    dL/dI_j, I_j and I_beyond. way (P,), share (P, 2). eps (P,) has the sign of the edge's motion.

    >>> colour, beyond = np.array([[0.0], [0.5]]), np.array([[1.0], [1.0]])
    >>> grad_colour, share = np.array([[-3.0], [2.0]]), np.array([[0.25, 0.75], [0.5, 0.5]])
    >>> edge_pulls(grad_colour, colour, beyond, np.array([0.5, 0.1]), share, np.zeros(2)) + 0.0
    array([[-1.5, -4.5],
           [ 0. ,  0. ]])

    Fine print. An end of share 0 does not move the crossing. It gets 0.
    """
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    # 1 / (way / share + eps) is share / (way + eps share), which is 0 for a share of 0.
    scaled = way[:, None] + eps[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def sweep_lines(grad_colour, colour, sees, crossing,  # exercise 10.7 (4 points)
                side, share, eps=1e-4):
    """K lines of pixels, each crossed by an edge: the gradients (K, 2) of the edges' ends, in ndc.

    grad_colour, colour (K, W, C). sees (K, W): is the face seen? crossing (x_edge), side (K,).
    share (K, 2). Outside is where j grows if side is 1, falls if -1. inner is the last pixel not
    outside, outer the next. Add up `edge_pulls`, 0 if inner or outer is off the line. Outside, j
    counts if inner sees the face: I_beyond is inner's colour, and the edge moves by side. Any other
    j counts if it sees the face: I_beyond is outer's colour, and the edge moves by -side.

    >>> colour, sees = np.array([[[1.0], [1.0], [0.0], [0.0]]]), np.array([[1, 1, 0, 0]]) > 0
    >>> grad_colour = np.array([[[0.0], [0.0], [-1.0], [0.0]]])  # pixel 2 is asked to shine
    >>> edge = np.array([2.25]), np.array([1]), np.array([[0.25, 0.75]])
    >>> sweep_lines(grad_colour, colour, sees, *edge, eps=0.0)
    array([[-2., -6.]])
    """
    count, width, _ = colour.shape
    inner = np.where(side > 0, np.floor(crossing - 0.5), np.ceil(crossing - 0.5)).astype(int)
    on_line = (np.minimum(inner, inner + side) >= 0) & (np.maximum(inner, inner + side) < width)
    inner, outer = np.where(on_line, [inner, inner + side], 0)
    is_out = (np.arange(width) - inner[:, None]) * side[:, None] > 0
    counts = np.where(is_out, sees[np.arange(count), inner][:, None], sees) & on_line[:, None]
    line, pixel = np.nonzero(counts)
    out = is_out[line, pixel]
    beyond = colour[line, np.where(out, inner[line], outer[line])]
    way = 2 / width * (pixel + 0.5 - crossing[line])
    terms = edge_pulls(grad_colour[line, pixel], colour[line, pixel], beyond, way, share[line],
                       np.where(out, side[line], -side[line]) * eps)
    return scatter(terms, line, count)


class Sweep(NamedTuple):
    """What is swept along its rows: grad_colour, colour (H, W, C), face_index (H, W).

    Of all triangles (F, 3, 2) on the screen, only those drawn (D,) have a gradient. winding is 1 if
    they are counter-clockwise, -1 if not.
    """

    grad_colour: np.ndarray
    colour: np.ndarray
    face_index: np.ndarray
    triangles: np.ndarray
    drawn: np.ndarray
    winding: int


def both_sweeps(grad_colour, colour, face_index, corners):
    """The Sweep along rows, and the one along columns, where x and y swap and the winding turns."""
    height, width = face_index.shape
    triangles = neural_renderer.on_screen(corners, width, height)
    drawn = np.unique(face_index[face_index >= 0])  # faces that are not seen get no gradient
    across = (array.swapaxes(0, 1).copy() for array in (grad_colour, colour, face_index))
    return (Sweep(grad_colour, colour, face_index, triangles, drawn, 1),
            Sweep(*across, triangles[..., ::-1], drawn, -1))


def outer_side(winding, a, b):
    """1 if the outside of the edge from a to b (..., 2) is where x grows, -1 where it falls."""
    # A counter-clockwise face is on the left of an edge that goes up.
    return (winding * np.sign(b[..., 1] - a[..., 1])).astype(int)


def sweep_backward(grad_colour, colour, face_index, corners, eps=1e-4):
    """The outline's gradient for whole meshes: grad_corners (F, 3, 3), 0 for z.

    grad_colour, colour (H, W, C), face_index (H, W) of `rasterize`, corners (F, 3, 3).
    """
    grad_corners = np.zeros(corners.shape)
    for axis, sweep in enumerate(both_sweeps(grad_colour, colour, face_index, corners)):
        for ends in map(list, EDGES):
            for face, grads in sweep_edges(sweep, *ends, eps):
                grad_corners[:, ends, axis] += scatter(grads, face, len(corners))
    return grad_corners


def sweep_edges(sweep, i, j, eps):
    """`sweep_lines` of the edges from corner i to j of all faces: yields, for chunks of lines, the
    face (K,) and its gradients (K, 2).
    """
    height, width, _ = sweep.colour.shape
    a, b = sweep.triangles[sweep.drawn][:, [i, j]].swapaxes(0, 1)
    edge, row, crossing, share = edge_lines(a, b, height)
    face, side = sweep.drawn[edge], outer_side(sweep.winding, a, b)[edge]
    for part in chunks(np.full(len(edge), width)):
        line = row[part]
        sees = sweep.face_index[line] == face[part, None]
        yield face[part], sweep_lines(sweep.grad_colour[line], sweep.colour[line], sees,
                                      crossing[part], side[part], share[part], eps)


def edge_lines(a, b, height):
    """The rows of a picture that edges from a to b (D, 2) cross: edge, row (K,), and eq. (8) there,
    crossing (K,), share (K, 2). An edge crosses the rows whose centre row + 1/2 is from a_y to b_y,
    and none if it is flat.
    """
    low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    first = np.clip(np.ceil(low - 0.5), 0, height).astype(int)
    last = np.where(low == high, first, np.clip(np.floor(high + 0.5), first, height)).astype(int)
    edge, row = expand(first, last - first)
    a, b = a[edge], b[edge]
    share_b = (row + 0.5 - a[:, 1]) / (b[:, 1] - a[:, 1])
    crossing = a[:, 0] + share_b * (b[:, 0] - a[:, 0])
    return edge, row, crossing, np.stack([1 - share_b, share_b], -1)
