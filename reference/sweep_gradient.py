"""sweep_gradient: Kato's approximate gradient of outlines.

A pixel sees a face or not, so the picture's derivative by an edge is 0. Kato follows a line of
pixels that an edge crosses. How far must the edge go to reach pixel j, and how much would the loss
fall if I_j became I_beyond, the colour on the other side of the edge?

    g_i = -sum_j max(0, (I_j - I_beyond) . dL/dI_j) / (d_j + eps)   corner i, by ndc           (7)
    d_j = (2 / W) (x_j - x_edge) / share_i         how far corner i must go to bring it there  (8)

Rows of pixels give the gradients by x. Columns give those by y: they are rows of the transposed
picture.

The paper lets no gradient pass where something hides the edge. The kernel, and so this, asks for
that only where the edge moves out. Two slips of the kernel, where the edge moves in, are not
repeated here. For d_j = 0 its eps has one sign on both sides, which is wrong on one of them. Its
bound divides by 0 where the third edge is parallel to the line and the line meets a corner.

Sources: Kato, Ushiku, Harada 2018, and a reading of their rasterizer, neural_renderer.
"""
from typing import NamedTuple

import numpy as np

from . import neural_renderer, scanline
from .rasterization import EDGES, scatter


def edge_lines(a, b, height):  # exercise 10.12 (2 points)
    """Where the edge from a to b (2,), on screen, crosses the rows of a picture's centres.

    -> row (K,) integers, ascending, those with 0 <= row < height whose centre y = row + 1/2 is
    from a_y to b_y. crossing (K,) is x there. share (K, 2) is by how much the crossing moves if a
    alone, or b alone, is moved by 1 along x.

    >>> row, crossing, share = edge_lines(np.array([8.0, 3.5]), np.array([4.0, 1.5]), 3)
    >>> row, crossing, share.T
    (array([1, 2]), array([4., 6.]), array([[0. , 0.5],
           [1. , 0.5]]))

    Fine print. A centre at a_y or b_y counts, but an edge with a_y = b_y crosses no row.
    """
    low, high = min(a[1], b[1]), max(a[1], b[1])
    row = np.arange(max(np.ceil(low - 0.5), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([1 - toward_b, toward_b], -1)


def sweep_line(grad_colour, colour, sees, crossing, side,  # exercise 10.13 (3 points)
               share, eps=1e-4):
    """Eqs. (7) and (8): one edge on one line of pixels -> the gradient (2,) of its ends, by ndc.

    grad_colour, colour (W, C) are the line's, with centres at j + 1/2. sees (W,), bool, says which
    pixels see the edge's face. The edge is at crossing, and side is 1 if outside is where j grows,
    else -1. share (2,) is that of `edge_lines`.

    inner is the last pixel whose centre is not outside of the crossing. outer is its neighbour
    outside. If one of them is not in the picture, the gradient is 0. Else it has two sums:

    - The edge moves out, if inner sees the face: over outer and all pixels beyond it, up to the
      picture's border, whatever they see. I_beyond is inner's colour.
    - The edge moves in: over inner and all pixels on its side, those that see the face. I_beyond
      is outer's colour.

    I_j becoming I_beyond must lower the loss, else max(0, ...) is 0. d_j is in ndc, where the line
    has length 2 = W pixels. It has the sign of the edge's motion, side or -side, and so has eps.

    >>> colour, grad_colour = np.array([[0.0], [1.0], [1.0], [0.0], [0.0]]), np.zeros((5, 1))
    >>> grad_colour[4] = -1.0   # it should be brighter: the edge at 2.75 is to go to 4.5
    >>> sees = colour[:, 0] > 0
    >>> sweep_line(grad_colour, colour, sees, 2.75, 1, np.array([0.25, 0.75]), eps=0.0).round(6)
    array([-0.357143, -1.071429])

    Fine print. eps has that sign where d_j = 0, too. An end of share 0 has gradient 0.
    """
    inner = int(np.floor(crossing - 0.5) if side > 0 else np.ceil(crossing - 0.5))
    outer = inner + side
    if not (0 <= min(inner, outer) and max(inner, outer) < len(colour)):
        return np.zeros(2)
    pixel = np.arange(len(colour))
    is_out = (pixel - inner) * side > 0
    beyond = np.where(is_out[:, None], colour[inner], colour[outer])
    pull = ((colour - beyond) * grad_colour).sum(1)
    counts = (pull > 0) & np.where(is_out, sees[inner], sees)
    signed_eps = np.where(is_out, side, -side)[counts] * eps
    distance = 2 / len(colour) * (pixel[counts] + 0.5 - crossing)
    return np.array([-(pull[counts] / (distance / s + signed_eps)).sum() if s > 0 else 0.0
                     for s in share])


class Sweep(NamedTuple):
    """What is swept along its rows: grad_colour, colour (H, W, C), face_index (H, W).

    The faces drawn (D,) of those at screen (F, 3, 2) have a gradient. winding is 1 if they are
    counter-clockwise, -1 if not.
    """

    grad_colour: np.ndarray
    colour: np.ndarray
    face_index: np.ndarray
    screen: np.ndarray
    drawn: np.ndarray
    winding: int


def both_sweeps(grad_colour, colour, face_index, corners):
    """The Sweep along rows, and that along columns: x and y are swapped, and so is the winding."""
    height, width = face_index.shape
    screen = neural_renderer.on_screen(corners, width, height)
    drawn = np.flatnonzero(neural_renderer.front_faces(screen, corners[..., 2]))
    across = (array.swapaxes(0, 1).copy() for array in (grad_colour, colour, face_index))
    return (Sweep(grad_colour, colour, face_index, screen, drawn, 1),
            Sweep(*across, screen[..., ::-1], drawn, -1))


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
                a, b = sweep.screen[f, i], sweep.screen[f, j]
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
                grad_corners[:, ends, axis] -= scatter(terms, face, len(corners))
    return grad_corners


class Crossings(NamedTuple):
    """Where edges cross rows of pixels: (K,) each, share (K, 2). The words are `sweep_line`'s."""

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
    edge, row = scanline.expand(first, last - first)
    a, b = a[edge], b[edge]
    toward_b = (row + 0.5 - a[:, 1]) / (b[:, 1] - a[:, 1])
    crossing = a[:, 0] + toward_b * (b[:, 0] - a[:, 0])
    return edge, row, crossing, np.stack([1 - toward_b, toward_b], -1)


def crossings(sweep, i, j):
    """The Crossings of the edge from corner i to j of each face, with a pixel on either side."""
    height, width = sweep.face_index.shape
    triangles = sweep.screen[sweep.drawn]
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
    """`sweep_line` at all Crossings: yields, for chunks of their pixels, the face (N,) and the
    terms of eq. (7) for both ends (N, 2).
    """
    width = sweep.colour.shape[1]
    wants = (sweep.grad_colour != 0).any(2)
    for part in scanline.chunks(np.full(len(found.row), width)):
        lines = Crossings(*(values[part] for values in found))
        line, pixel, is_out, pull = pulling_pixels(sweep, wants, lines)
        share = lines.share[line]
        distance = 2 / width * (pixel + 0.5 - lines.crossing[line])
        signed_eps = np.where(is_out, lines.side[line], -lines.side[line]) * eps
        # pull / (distance / share + eps), 0 for share 0
        scaled = distance[:, None] + signed_eps[:, None] * share
        yield lines.face[line], pull[:, None] * share / np.where(share > 0, scaled, 1)


def pulling_pixels(sweep, wants, lines):
    """Which pixels pull at which of the Crossings, and how strongly: max(0, ...) of eq. (7).

    wants (H, W): where grad_colour is not 0 -> line, pixel, is_out, pull (N,), where pull > 0.
    """
    sees = sweep.face_index[lines.row] == lines.face[:, None]
    inner_sees = sweep.face_index[lines.row, lines.inner] == lines.face
    pixel, inner = np.arange(sees.shape[1]), lines.inner[:, None]
    is_out = np.where(lines.side[:, None] > 0, pixel > inner, pixel < inner)
    counts = np.where(is_out, inner_sees[:, None], sees)
    line, pixel = np.nonzero(counts & wants[lines.row])
    row, inner, is_out = lines.row[line], lines.inner[line], is_out[line, pixel]
    beyond = sweep.colour[row, np.where(is_out, inner, inner + lines.side[line])]
    pull = ((sweep.colour[row, pixel] - beyond) * sweep.grad_colour[row, pixel]).sum(1)
    lowers = pull > 0
    return line[lowers], pixel[lowers], is_out[lowers], pull[lowers]
