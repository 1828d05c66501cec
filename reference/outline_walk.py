"""Walk on: the outline of a surface, however small its faces are.

outlines.py gives up unless a pair's line leaves the owner's face by a silhouette. Where faces are
smaller than pixels, the outline belongs to a face between the two centres that no pixel shows. So
walk from face to face, until the edge is a silhouette: there the outline crosses at c. If the walk
comes to the face that the other pixel sees, the surface simply goes on. If it passes the other's
centre on another face, that pixel's surface hides it: that one walks, from the other's centre to
the owner's.

(4) and (5) of antialiasing.py blend at the outline, and their way back is exact. Pictures that stay
hard have another estimate, Reynolds' boundary term summed over rows and columns:

    dL = sum of 1/2 (g_owner + g_other) . (I_owner - I_other) v                             (8)

over all pairs with an outline, whose point on the pair's line moves by v along it, for a picture I
with the gradient g.

Sources: Laine et al. 2020 (nvdiffrast), section 3.6, the first step of each walk; Li et al. 2018,
the boundary term; Pidhorskyi et al. 2024 (DRTK), (8) with the point at the owner's centre.
"""
import numpy as np

from course.given.arrays import EDGES

from .antialiasing import Pairs, crossing, ends_backward, pair_frame, pair_step
from .outlines import WINDOW, all_silhouettes, leave_faces, neighbours, select, steep_pairs


def enter_faces(owner, other, corner, screen, faces, width):  # step 8.12
    """By which edge does each pair's line leave the face that it comes into? -> Pairs

    As `leave_faces`, but for corner (N,), numbered 3 * face + corner as in `opposite_corners`. The
    line comes in by the edge across from this corner. Its ends lie on different sides of the line
    y = 0, and the corner on the side of one of them. The line leaves between the corner and the
    other end. See `demo borders`.

    >>> screen = np.array([[0.0, 0.5, 2.0], [-1.5, 2.5, 2.5], [1.0, 1.0, 1.0]])
    >>> pairs = enter_faces(*np.array([[0], [1], [2]]), screen, np.array([[0, 1, 2]]), 3)
    >>> pairs.face, pairs.edge, pairs.c, pairs.ends.T
    (array([0]), array([1]), array([0.5]), array([[2, 0]]))

    Fine print. y < 0 is below, and y >= 0 above, as in `last_crossing`. A corner behind the camera
    (w < 0) is mirrored: compare s y, s the sign of w. If the crossing is not in front of it, where
    s_i |y_j| + s_j |y_i| <= 0, the face passes the other's centre: c = np.inf.
    """
    face, entered = np.divmod(corner, 3)
    corners = faces[face].T
    screen_x, screen_y, w = (values[corners] for values in screen)
    x, y = pair_frame(screen_x, screen_y, owner, other, width)
    n = np.arange(len(face))
    front = np.sign(w)
    below = front * y < 0
    i, j = np.array(EDGES).T[:, entered]
    edge = np.where(below[entered, n] == below[i, n], i, j)
    ends = np.array(EDGES).T[:, edge], n
    (x0, x1), (y0, y1), (front_0, front_1) = x[ends], y[ends], front[ends]
    seen = front_0 * np.abs(y1) + front_1 * np.abs(y0) > 0
    c = np.full(len(face), np.inf)
    c[seen] = crossing(x0[seen], y0[seen], x1[seen], y1[seen])
    return Pairs(owner, other, c, corners[ends], x[ends], y[ends], face, edge)


def put(pairs, n, new):
    """Write new Pairs over those at n, which is numbers or bool (N,): pairs change in place."""
    for values, new_values in zip(pairs, new, strict=True):
        values[..., n] = new_values


def step_over(pairs, n, opposite, screen, faces, width):
    """Move the pairs n (M,) over their edges into the faces across: pairs change in place."""
    across = opposite[pairs.face[n], pairs.edge[n]]
    put(pairs, n, enter_faces(pairs.owner[n], pairs.other[n], across, screen, faces, width))


def walk(pairs, goal, screen, faces, opposite, silhouette, width):  # exercise 8.13 (5 points)
    """Where a walk over the surface, from the owner's centre to the other's, stops -> Pairs

    pairs: the first steps, of `leave_faces`. Go on as long as c < 1, the edge is no silhouette,
    bool (F, 3), and the face across, by opposite (F, 3) of `opposite_corners`, is not goal (N,),
    which the other pixel sees. The given `step_over` moves pairs in place: work on a copy.

    >>> screen = np.array([[0.0, 0.5, 0.5, 1.25], [1.0, -1.0, 3.0, 0.0], [1.0, 1.0, 1.0, 1.0]])
    >>> faces, opposite = np.array([[0, 1, 2], [2, 1, 3]]), np.array([[5, -1, -1], [-1, -1, 0]])
    >>> pairs = leave_faces(*np.array([[0], [1], [0]]), screen, faces, 2)
    >>> pairs = walk(pairs, np.array([-1]), screen, faces, opposite, opposite < 0, 2)
    >>> pairs.face, pairs.edge, pairs.c.round(3)
    (array([1]), array([1]), array([0.625]))

    Fine print. If no edge of the first face crosses, c is -np.inf and the walk is over. No walk is
    longer than there are faces.
    """
    pairs = Pairs(*map(np.array, pairs))
    go = np.flatnonzero(pairs.c > -np.inf)
    for _ in range(len(faces)):
        go = go[(pairs.c[go] < 1) & ~silhouette[pairs.face[go], pairs.edge[go]]]
        go = go[opposite[pairs.face[go], pairs.edge[go]] // 3 != goal[go]]
        if len(go) == 0:
            break
        step_over(pairs, go, opposite, screen, faces, width)
    return pairs


def is_outline(pairs, silhouette):
    """Did each pair's walk stop at a silhouette before the other's centre, or at it? bool (N,)"""
    return silhouette[pairs.face, pairs.edge] & (pairs.c > -WINDOW) & (pairs.c <= 1)


def outline_pairs(face_index, depth, clip, faces, opposite):  # exercise 8.14 (8 points)
    """The pairs of neighbours with an outline between their centres -> Pairs, and others -> Pairs

    First the owner's surface walks, and the given `is_outline` says where it found one. If it
    passes the other's centre (c >= 1) without one, and that pixel sees a face, this walks from
    there: owner and other change places. Second walks that pass, too, are the others: there
    surfaces cross. face_index, depth (H, W), clip (V, 4), faces, opposite (F, 3).
    `all_silhouettes(clip, faces, opposite, width, height)` is given.

    >>> clip = np.array([[-0.125, -9.0, 0.0, 1.0], [-0.125, 9.0, 0.0, 1.0], [-9.0, 0.0, 0.0, 1.0]])
    >>> picture = np.array([[0, 0, -1, -1]]), np.array([[0.0, 0.0, np.inf, np.inf]])
    >>> pairs, others = outline_pairs(*picture, clip, np.array([[0, 1, 2]]), np.full((1, 3), -1))
    >>> pairs.owner, pairs.other, pairs.c, others.c
    (array([1]), array([2]), array([0.25]), array([], dtype=float64))
    """
    height, width = face_index.shape
    screen, silhouette = all_silhouettes(clip, faces, opposite, width, height)
    seen = face_index.ravel()

    def walked(owner, other):
        pairs = leave_faces(owner, other, seen[owner], screen, faces, width)
        return walk(pairs, seen[other], screen, faces, opposite, silhouette, width)

    owner, other = neighbours(face_index, depth)
    pairs = walked(owner, other)
    hidden = ~is_outline(pairs, silhouette) & (pairs.c >= 1) & (seen[other] >= 0)
    put(pairs, hidden, walked(other[hidden], owner[hidden]))
    found = is_outline(pairs, silhouette)
    through = ~found & (pairs.c >= 1) & (seen[pairs.other] >= 0)
    return select(pairs, found), select(pairs, through)


def last_folds(pairs, face_index, clip, faces, opposite):
    """Pairs with an outline, at the last fold of their surface instead of the first.

    A bumpy surface folds back and comes forward again. What the pair's line cuts out of it is a
    curve, which covers all up to its greatest c. So walk on along the curve, a pixel behind the
    owner's centre at most, once around at most, and as long as the other's face is not reached.
    """
    height, width = face_index.shape
    screen, silhouette = all_silhouettes(clip, faces, opposite, width, height)
    goal, go = face_index.ravel()[pairs.other], np.arange(len(pairs.c))
    last, at = Pairs(*map(np.array, pairs)), Pairs(*map(np.array, pairs))
    for _ in range(2 * len(faces) - 1):
        across = opposite[at.face[go], at.edge[go]]
        go = go[(across >= 0) & (across // 3 != goal[go])]
        if len(go) == 0:
            break
        step_over(at, go, opposite, screen, faces, width)
        is_around = (at.face[go] == pairs.face[go]) & (at.edge[go] == pairs.edge[go])
        go = go[(np.abs(at.c[go]) < 1) & ~is_around]
        farther = go[silhouette[at.face[go], at.edge[go]] & (at.c[go] > last.c[go])]
        put(last, farther, select(at, farther))
    return last


def both_pairs(face_index, depth, clip, faces, opposite):
    """What `outline_pairs` finds, the first with their `last_folds`, as Pairs of arrays, whatever
    tuples or lists it returns.
    """
    kinds = Pairs(owner=np.intp, other=np.intp, c=float, ends=np.intp, x=float, y=float,
                  face=np.intp, edge=np.intp)
    with np.errstate(all="ignore"):  # of vertices that no seen face has
        found, others = (Pairs(*map(np.asarray, pairs, kinds)) for pairs in outline_pairs(
            face_index, depth, clip, faces, opposite))
        return last_folds(found, face_index, clip, faces, opposite), others


def walked_pairs(face_index, depth, clip, faces, opposite):
    """The pairs with a steep outline -> Pairs"""
    return steep_pairs(both_pairs(face_index, depth, clip, faces, opposite)[0])


def outline_pull_backward(grad_picture, colour, pairs, clip):  # extra 8.15 (3 points)
    """Eq. (8): grad_picture, colour (H, W, C), pairs of `outline_pairs` -> grad_clip (V, 4).

    The outline's point divides its edge as y0 and y1 say: it is (1 - t) end_0 + t end_1 with
    t = y0 / (y0 - y1), so it moves along the pair by (1 - t) v_0 + t v_1. `pair_step` and
    `ends_backward` are given. No check of one picture's gradient passes: the picture jumps. The
    mean over many shifts of the camera is right.

    >>> ends = np.array([[0], [1]]), np.array([[0.0], [0.5]]), np.array([[-1.0], [1.0]])
    >>> pairs = Pairs(np.array([0]), np.array([1]), np.array([0.25]), *ends, None, None)
    >>> clip = np.array([[-0.5, -1.0, 0.0, 1.0], [0.0, 3.0, 0.0, 1.0]])
    >>> colour, grad_picture = np.array([[[1.0], [0.0]]]), np.array([[[10.0], [100.0]]])
    >>> outline_pull_backward(grad_picture, colour, pairs, clip)[:, :2]
    array([[27.5,  0. ],
           [27.5,  0. ]])
    """
    height, width, channels = colour.shape
    pixels, grad = colour.reshape(-1, channels), grad_picture.reshape(-1, channels)
    owner, other, _, ends, _, (y0, y1), *_ = pairs
    force = ((grad[owner] + grad[other]) / 2 * (pixels[owner] - pixels[other])).sum(1)
    t = y0 / (y0 - y1)
    pull = np.stack([1 - t, t]) * force
    dx, dy = pair_step(owner, other, width)
    return ends_backward(dx * pull, dy * pull, ends, clip, width, height)
