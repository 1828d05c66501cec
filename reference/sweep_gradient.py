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


def edge_crossing(a, b, y):  # extra 10.12 (1 point)
    """Eq. (8): where does the edge from a to b cross the row y? -> x_edge (...), share (..., 2).

    a, b (..., 2), y (...), shapes that broadcast. share is share_a, share_b.

    >>> edge_crossing(np.array([8.0, 3.0]), np.array([4.0, 1.0]), np.array([1.5, 2.5]))
    (array([5., 7.]), array([[0.25, 0.75],
           [0.75, 0.25]]))
    """
    share_b = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return a[..., 0] + share_b * (b[..., 0] - a[..., 0]), np.stack([1 - share_b, share_b], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):  # exercise 10.13 (2 points)
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


def edge_lines(a, b, height):
    """The rows of a picture that the edge from a to b (2,) crosses: row (K,), and `edge_crossing`
    there. These are the rows whose centre row + 1/2 is from a_y to b_y. A flat edge crosses none.
    """
    low, high = min(a[1], b[1]), max(a[1], b[1])
    row = np.arange(max(np.ceil(low - 0.5), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    return row, *edge_crossing(a, b, row + 0.5)


def sweep_line(grad_colour, colour, sees, crossing,  # exercise 10.14 (4 points)
               side, share, eps=1e-4):
    """One line of pixels that an edge crosses: the gradient (2,) of the edge's ends, in ndc.

    grad_colour, colour (W, C), sees (W,): is the face seen? share (2,) of eq. (8). Outside is where
    j grows if side is 1, falls if -1. Add up `edge_pulls` as the lecture's loop does. inner is the
    last pixel not outside. If inner or outer is off the line: 0.

    >>> colour, sees = np.array([[1.0], [1.0], [0.0], [0.0]]), np.array([True, True, False, False])
    >>> grad_colour, share = np.array([[0.0], [0.0], [-1.0], [0.0]]), np.array([0.25, 0.75])
    >>> sweep_line(grad_colour, colour, sees, 2.25, 1, share, eps=0.0)  # pixel 2 is asked to shine
    array([-2., -6.])
    """
    inner = int(np.floor(crossing - 0.5) if side > 0 else np.ceil(crossing - 0.5))
    outer = inner + side
    if not (0 <= min(inner, outer) and max(inner, outer) < len(colour)):
        return np.zeros(2)
    pixel = np.arange(len(colour))
    is_out = (pixel - inner) * side > 0
    counts = np.where(is_out, sees[inner], sees)
    beyond = np.where(is_out[:, None], colour[inner], colour[outer])
    way = 2 / len(colour) * (pixel + 0.5 - crossing)
    signed_eps = np.where(is_out, side, -side) * eps
    terms = edge_pulls(grad_colour[counts], colour[counts], beyond[counts], way[counts],
                       np.tile(share, (counts.sum(), 1)), signed_eps[counts])
    return terms.sum(0)


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


def sweep_backward_loop(grad_colour, colour, face_index, corners, eps=1e-4):
    """The outline's gradient, edge by edge and line by line: grad_corners (F, 3, 3), 0 for z.

    grad_colour, colour (H, W, C), face_index (H, W) of `rasterize`, corners (F, 3, 3).
    """
    grad_corners = np.zeros(corners.shape)
    for axis, sweep in enumerate(both_sweeps(grad_colour, colour, face_index, corners)):
        for f in sweep.drawn:
            for i, j in EDGES:
                a, b = sweep.triangles[f, i], sweep.triangles[f, j]
                side = outer_side(sweep.winding, a, b)
                lines = edge_lines(a, b, len(sweep.colour))
                for row, crossing, share in zip(*lines, strict=True):
                    sees = sweep.face_index[row] == f
                    grad_corners[f, [i, j], axis] += sweep_line(
                        sweep.grad_colour[row], sweep.colour[row], sees, crossing, side, share, eps)
    return grad_corners


def sweep_backward(grad_colour, colour, face_index, corners, eps=1e-4):
    """What `sweep_backward_loop` returns, to rounding, for whole meshes."""
    grad_corners = np.zeros(corners.shape)
    for axis, sweep in enumerate(both_sweeps(grad_colour, colour, face_index, corners)):
        for ends in map(list, EDGES):
            for face, terms in pulls(sweep, crossings(sweep, *ends), eps):
                grad_corners[:, ends, axis] += scatter(terms, face, len(corners))
    return grad_corners


class Crossings(NamedTuple):
    """Where edges cross rows of pixels: (K,) each, share (K, 2). See `sweep_line` for the words."""

    face: np.ndarray
    row: np.ndarray
    crossing: np.ndarray
    share: np.ndarray
    side: np.ndarray
    inner: np.ndarray


def all_edge_lines(a, b, height):
    """`edge_lines` of edges a, b (D, 2): edge (K,), row (K,), crossing (K,), share (K, 2)."""
    low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    first = np.clip(np.ceil(low - 0.5), 0, height).astype(int)
    last = np.where(low == high, first, np.clip(np.floor(high + 0.5), first, height)).astype(int)
    edge, row = expand(first, last - first)
    return edge, row, *edge_crossing(a[edge], b[edge], row + 0.5)


def crossings(sweep, i, j):
    """The Crossings of the edge from corner i to j of each face, with a pixel on either side."""
    height, width = sweep.face_index.shape
    triangles = sweep.triangles[sweep.drawn]
    a, b = triangles[:, i], triangles[:, j]
    edge, row, crossing, share = all_edge_lines(a, b, height)
    side = outer_side(sweep.winding, a, b)[edge]
    inner = np.where(side > 0, np.floor(crossing - 0.5), np.ceil(crossing - 0.5))
    outer = inner + side
    kept = (np.minimum(inner, outer) >= 0) & (np.maximum(inner, outer) < width)
    inner = np.where(kept, inner, 0).astype(int)
    found = Crossings(sweep.drawn[edge], row, crossing, share, side, inner)
    return found if kept.all() else Crossings(*(values[kept] for values in found))


def pulls(sweep, found, eps):
    """`sweep_line` at all Crossings: yields, for chunks of their pixels, the face (N,) and its
    `edge_pulls` (N, 2).
    """
    width = sweep.colour.shape[1]
    wants = (sweep.grad_colour != 0).any(2)
    for part in chunks(np.full(len(found.row), width)):
        lines = Crossings(*(values[part] for values in found))
        line, pixel, is_out = pulling_pixels(sweep, wants, lines)
        row, side = lines.row[line], lines.side[line]
        beyond = sweep.colour[row, np.where(is_out, lines.inner[line], lines.inner[line] + side)]
        way = 2 / width * (pixel + 0.5 - lines.crossing[line])
        signed_eps = np.where(is_out, side, -side) * eps
        terms = edge_pulls(sweep.grad_colour[row, pixel], sweep.colour[row, pixel], beyond, way,
                           lines.share[line], signed_eps)
        yield lines.face[line], terms


def pulling_pixels(sweep, wants, lines):
    """Which pixels count at which of the Crossings: line, pixel, is_out (N,).

    wants (H, W) says where grad_colour is not 0. is_out: the edge moves out to the pixel.
    """
    sees = sweep.face_index[lines.row] == lines.face[:, None]
    inner_sees = sweep.face_index[lines.row, lines.inner] == lines.face
    pixel = np.arange(sees.shape[1])
    inner = lines.inner[:, None]
    is_out = np.where(lines.side[:, None] > 0, pixel > inner, pixel < inner)
    counts = np.where(is_out, inner_sees[:, None], sees)
    line, pixel = np.nonzero(counts & wants[lines.row])
    return line, pixel, is_out[line, pixel]
