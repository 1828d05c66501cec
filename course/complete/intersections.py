"""Intersections: where two surfaces pass through each other between two pixels.

A walk finds no outline there. Both surfaces reach the other's centre, each behind the one that is
seen, so somewhere in between they are equally deep. Both are followed from the owner's centre on,
face by face, until two faces meet. On screen a face is a plane: let d be how much deeper that of
the owner's surface lies. In the pair's frame d = d_0 + d_x x + d_y y, and it is 0 on a line:

    x = -(d_0 + d_y y) / d_x,       which is c at y = 0                                          (9)
    dc = -dd / d_x,     dd = sum of l_k (dz_k - slope . (dx_k, dy_k)) of a face, less the other's

where l_k are the weights of a face's corners at c. This line is an edge that the mesh lacks.
`points` adds its ends to the vertices, and lab 8 blends and moves it as any edge. Then
`points_backward` hands on what moves the ends to the corners of both faces.
"""
import numpy as np

from .antialiasing import Pairs, blend_pairs_backward, pair_step, place_ends, screen_backward
from .outline_walk import both_pairs, step_over
from .outlines import leave_faces, select, steep_pairs
from .rasterization import screen_points


def all_pairs(face_index, depth, clip, faces, opposite):
    """The pairs that are blended: those with a steep outline, and those where surfaces meet, along
    a steep line. face_index, depth (H, W), clip (V, 4), faces, opposite (F, 3) -> Pairs

    Where surfaces meet, ends are numbers from V on, those of `points`. A face of the owner's
    surface meets face f of the other's, and edge is 3 + f: no edge of its own.
    """
    pairs, through = both_pairs(face_index, depth, clip, faces, opposite)
    return with_meetings(steep_pairs(pairs), through, face_index, clip, faces, opposite)


def with_meetings(pairs, through, face_index, clip, faces, opposite):
    """The Pairs, and those where surfaces meet. through: the second walks whose surface passes the
    other's centre. Only their owner, other and face are read.
    """
    count, shape = len(through.owner), face_index.shape
    if count == 0:
        return pairs
    unknown, owner = np.zeros((2, count)), through.other  # the second walks went back to the owner
    at_owner = Pairs(owner, through.owner, unknown[0], unknown, unknown, unknown,
                     face_index.ravel()[owner], 3 + through.face)
    with np.errstate(all="ignore"):  # of faces without area
        met = find_meetings(at_owner, clip, faces, opposite, shape)
        met = met._replace(ends=new_ends(met, clip))
        met = place_ends(met, points(met, shape, clip, faces), shape)
        met = steep_pairs(select(met, (met.c > 0) & (met.c < 1)))
    both = pairs, met._replace(ends=new_ends(met, clip))
    return Pairs(*(np.concatenate(parts, -1) for parts in zip(*both, strict=True)))


def new_ends(met, clip):
    """The vertices that the ends of N new edges become, from V on: (2, N)."""
    return len(clip) + np.arange(2 * len(met.c)).reshape(2, -1)


def find_meetings(met, clip, faces, opposite, shape):
    """The Pairs whose surfaces meet on the way from owner to other, and by which faces. At first
    these are the faces at the owner's centre. The walk that is behind takes the next step.
    """
    height, width = shape
    mesh = screen_points(clip, width, height), faces, width
    walks = [Pairs(*map(np.array, leave_faces(met.owner, met.other, face, *mesh)))
             for face in meeting_faces(met)]
    go, is_met = np.arange(len(met.c)), np.zeros(len(met.c), bool)
    for _ in range(2 * len(faces)):  # no walk is longer
        if len(go) == 0:
            break
        met = met._replace(face=walks[0].face, edge=3 + walks[1].face)
        c = np.stack([walk.c[go] for walk in walks])
        d_0, d_x, _ = gap(select(met, go), clip, faces, shape)
        is_met[go] = d_0 + c.min(0).clip(0, 1) * d_x >= 0
        goes_on = ~is_met[go] & (c.min(0) < 1)
        for k, walk in enumerate(walks):
            step_over(walk, go[goes_on & (c.argmin(0) == k)], opposite, *mesh)
        go = go[goes_on]
    return select(met, is_met)


def meeting_faces(met):
    """Which faces meet, (2, N): of the owner's surface, and of the other's."""
    return np.stack([met.face, met.edge - 3])


def none_meet(pairs, clip):
    """Are the ends of all Pairs vertices of the mesh?"""
    return np.max(Pairs(*pairs).ends, initial=-1) < len(clip)


def meetings(pairs, clip):
    """Those of the Pairs where surfaces meet. IndexError: their ends are not numbered."""
    met = select(pairs, Pairs(*pairs).ends[0] >= len(clip))
    if not np.array_equal(np.sort(met.ends, None), new_ends(met, clip).ravel()):
        raise IndexError("pairs name vertices that are not there: give the Buffers of this picture")
    return met


def planes(met, x, y, clip, faces, shape):
    """Both faces at a place (x, y), (N,) each, in the pair's frame -> corners (3, 2, N), depth
    (2, N), weights (3, 2, N), slope (2, 2, N) on screen.
    """
    height, width = shape
    corners = np.moveaxis(faces[meeting_faces(met)], -1, 0)
    screen = screen_points(clip[corners.ravel()], width, height)
    screen_x, screen_y, w = (values.reshape(corners.shape) for values in screen)
    place_x, place_y = out_of_frame(met, x, y, width)
    screen_x, screen_y = screen_x - place_x, screen_y - place_y
    z = clip[:, 2][corners] / w
    e = np.cross(screen_x, screen_y, axis=0)  # edge functions
    e_x = np.roll(screen_y, -1, 0) - np.roll(screen_y, -2, 0)  # y_i - y_j: how they change with x
    e_y = np.roll(screen_x, -2, 0) - np.roll(screen_x, -1, 0)
    area, slope = e.sum(0), np.stack([(e_x * z).sum(0), (e_y * z).sum(0)])
    return corners, (e * z).sum(0) / area, e / area, slope / area


def gap(met, clip, faces, shape):
    """d_0, d_x and d_y of eq. (9), each (N,)."""
    _, (depth, other), _, slope = planes(met, 0.0, 0.0, clip, faces, shape)
    along_x, along_y = slope[:, 0] - slope[:, 1]
    dx, dy = pair_step(met.owner, met.other, shape[1])
    return depth - other, dx * along_x + dy * along_y, np.abs(dy) * along_x + np.abs(dx) * along_y


def out_of_frame(met, x, y, width):
    """The inverse of `pair_frame`: x, y (..., N) in the pair's frame -> x, y on screen."""
    dx, dy = pair_step(met.owner, met.other, width)
    row, column = np.divmod(met.owner, width)
    return column + 0.5 + dx * x + np.abs(dy) * y, row + 0.5 + dy * x + np.abs(dx) * y


def points(pairs, shape, clip, faces):
    """clip (V, 4), followed by the ends of the lines where surfaces meet, which the Pairs name."""
    if none_meet(pairs, clip):
        return clip
    met, (height, width) = meetings(pairs, clip), shape
    d_0, d_x, d_y = gap(met, clip, faces, shape)
    y = np.array([[-0.5], [0.5]])
    x, y = out_of_frame(met, -(d_0 + d_y * y) / d_x, y, width)
    ends = np.zeros((2 * len(met.c), 4))
    ends[met.ends - len(clip)] = np.stack(
        [2 * x / width - 1, 2 * y / height - 1, 0 * x, 0 * x + 1], -1)
    return np.concatenate([clip, ends])


def points_backward(grad_points, pairs, shape, clip, faces):
    """Backward of `points`, as far as it moves c: grad_points (V + 2 N, 4) -> grad_clip (V, 4)."""
    if none_meet(pairs, clip):
        return grad_points
    met, (height, width) = meetings(pairs, clip), shape
    # c is the mean of both ends' x, so both move along the pair by dc, however the line leans.
    grad = grad_points[met.ends].sum(0)
    dx, dy = pair_step(met.owner, met.other, width)
    grad_c = dx * grad[:, 0] * 2 / width + dy * grad[:, 1] * 2 / height
    # dc = -dd / d_x. At c a face gets deeper by its weights times dz - slope . (dx, dy).
    d_0, d_x, _ = gap(met, clip, faces, shape)
    corners, _, weights, slope = planes(met, -d_0 / d_x, 0.0, clip, faces, shape)
    grad_z = np.stack([-grad_c / d_x, grad_c / d_x]) * weights
    grad_screen = np.stack([-slope[0] * grad_z, -slope[1] * grad_z, grad_z], -1)
    return grad_points[:len(clip)] + screen_backward(
        grad_screen.reshape(6, -1, 3), corners.reshape(6, -1), clip, width, height)


def all_pairs_backward(grad_picture, colour, pairs, clip, faces):
    """`blend_pairs_backward` for `all_pairs` -> grad_colour (H, W, C), grad_clip (V, 4)."""
    shape = colour.shape[:2]
    grad_colour, grad_points = blend_pairs_backward(grad_picture, colour, pairs,
                                                    points(pairs, shape, clip, faces))
    return grad_colour, points_backward(grad_points, pairs, shape, clip, faces)
