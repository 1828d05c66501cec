"""An honest edge: how a picture changes when a corner of its triangles moves.

    picture_p = sum over triangles k of area(pixel p and what is seen of k) * colour_k          (1)
    loss      = sum over pixels p of weights_p . picture_p                                      (2)

A triangle has one colour, and lies wholly before the next one. What is asked for is the gradient of
(2) with respect to all corners. The truth is made without any derivative: the areas of (1) are cut
out with scissors, exactly, for two places of each corner that lie close together. That takes ten
times as long as an answer may take, and a hundred times as long as one need take.
"""
import numpy as np

FUNCTION = "gradient"
POINTS = 40
SECONDS = 2.0       # of a scene
ALL_SECONDS = 2.0   # of all scenes: `truth` takes ten times as long
COUNTED = None      # no function of the labs is needed
TRIES_IT = False
MOST = 0.5, 0.1, 0.03, 0.01  # the error of each kind of scenes: a claim is that it is less
SCENES = 20         # of each kind
SIZE = 24           # pixels of a side
STEP = 1e-4         # of the corners, in pixels


def trials(seed):
    """The scenes of all kinds, from a seed -> [(kind, (corners, colours, weights))].

    corners (T, 3, 2) in pixels, counter-clockwise, the nearest triangle first; colours (T, 3);
    weights (SIZE, SIZE, 3), smooth: row and column are those of a pixel's y and x.
    """
    rng = np.random.default_rng([seed, 8])
    kinds = {"one large triangle": (1, large), "four that overlap": (4, large),
             "four thin ones": (4, thin), "twelve of a pixel": (12, small)}
    return [(kind, scene(rng, count, shape))
            for kind, (count, shape) in kinds.items() for _ in range(SCENES)]


def scene(rng, count, shape):
    """count triangles of a shape, their colours, and the weights of a random wave a channel."""
    corners = np.array([counter_clockwise(shape(rng)) for _ in range(count)])
    pixels = np.arange(SIZE) + 0.5
    waves = rng.uniform(-0.5, 0.5, (2, 3))
    phase = pixels[:, None, None] * waves[0] + pixels[:, None] * waves[1]
    return corners, rng.uniform(0, 1, (count, 3)), np.sin(phase + rng.uniform(0, 7, 3))


def large(rng):
    """A triangle whose area is at least 40 pixels, anywhere in the picture."""
    corners = rng.uniform(1, SIZE - 1, (3, 2))
    return corners if abs(area(corners)) > 40 else large(rng)


def thin(rng):
    """10 to 20 pixels long, 0.2 to 0.8 wide."""
    angle = rng.uniform(0, 2 * np.pi)
    along, across = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    ends = rng.uniform(10, 20) * np.array([[-0.5], [0.5]]) * along
    corners = [*ends, rng.uniform(-4, 4) * along + rng.uniform(0.2, 0.8) * across]
    return np.array(corners) + rng.uniform(10, SIZE - 10, 2)


def small(rng):
    """A triangle of about a pixel, near the middle, so that some overlap."""
    corners = rng.uniform(-1, 1, (3, 2)) + rng.uniform(8, SIZE - 8, 2)
    return corners if abs(area(corners)) > 0.3 else small(rng)


# --- the truth ----------------------------------------------------------------------------------


def truth(corners, colours, weights):
    """The gradient of (2): central differences of the exact loss -> (T, 3, 2)."""
    found = np.zeros(corners.shape)
    for place in np.ndindex(corners.shape):
        moved = np.zeros(corners.shape)
        moved[place] = STEP
        found[place] = (loss(corners + moved, colours, weights)
                        - loss(corners - moved, colours, weights)) / (2 * STEP)
    return found


def loss(corners, colours, weights):
    """(2), by (1)."""
    return sum(weights[row, column] @ colour * area(part)
               for k, colour in enumerate(colours)
               for piece in seen(corners[k], corners[:k])
               for row, column, part in cut_by_pixels(piece))


def seen(triangle, nearer):
    """What is left of a triangle behind others: convex pieces."""
    pieces = [triangle]
    for other in nearer:
        pieces = [part for piece in pieces for part in outside(piece, other)]
    return pieces


def outside(piece, triangle):
    """Cut off what lies right of each edge in turn: these parts are not covered -> the pieces."""
    parts, rest = [], piece
    for a, b in zip(triangle, np.roll(triangle, -1, 0), strict=True):
        parts.append(clip(rest, b, a))
        rest = clip(rest, a, b)
    return [part for part in parts if part] if rest else [piece]


def cut_by_pixels(piece):
    """Yield row, column, polygon of each part that lies in one pixel."""
    (left, low), (right, high) = np.floor(np.min(piece, 0)), np.ceil(np.max(piece, 0))
    for row in np.arange(low, high, dtype=int):
        strip = clip(clip(piece, (0, row), (1, row)), (1, row + 1), (0, row + 1))
        for column in np.arange(left, right, dtype=int):
            part = clip(strip, (column, 1), (column, 0))
            yield row, column, clip(part, (column + 1, 0), (column + 1, 1))


def clip(polygon, a, b):
    """The part of a convex polygon that lies left of the line from a to b: its corners."""
    side = [(b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) for x, y in polygon]
    found = []
    for k, (point, here) in enumerate(zip(polygon, side, strict=True)):
        before, there = polygon[k - 1], side[k - 1]
        if here * there < 0:
            t = there / (there - here)
            found.append((before[0] + t * (point[0] - before[0]),
                          before[1] + t * (point[1] - before[1])))
        if here >= 0:
            found.append(tuple(point))
    return found


def area(polygon):
    """Half of the sum of x dy - y dx: positive, if it is counter-clockwise."""
    return sum(polygon[k - 1][0] * y - polygon[k - 1][1] * x
               for k, (x, y) in enumerate(polygon)) / 2


def counter_clockwise(triangle):
    return triangle if area(triangle) > 0 else triangle[::-1]


# --- the score ----------------------------------------------------------------------------------


def expected(seed):
    """The truth of each of the `trials`, as lists."""
    return [truth(*given).tolist() for _, given in trials(seed)]


def claims(found, truths, answers):
    """Each kind's median error, and each limit that it keeps -> [(claim, whether it holds, why)].

    answers: an array of numbers for each of the trials found, None where there is none.
    """
    errors = {}
    for (kind, _), true, answer in zip(found, truths, answers, strict=True):
        errors.setdefault(kind, []).append(error(np.array(true), answer))
    return [(f"{kind}: less than {most:g} off", bool(np.median(each) < most),
             f"{np.median(each):.3g} off, the median of {len(each)} scenes")
            for kind, each in errors.items() for most in MOST]


def error(true, answer):
    """|answer - true| / |true|. What is no gradient is infinitely off."""
    if np.shape(answer) != true.shape or not np.all(np.isfinite(answer)):
        return np.inf
    return np.linalg.norm(answer - true) / np.linalg.norm(true)
