"""Kernels: the body of a loop, run for every face or pixel at once.

    out[i] = body(i, inputs)        i = 0 ... N - 1, in any order: N threads                 (1)
    writers[p] = threads that write to place p        more than one: they race               (2)
    key = 2^32 floor(2^29 (depth + 1)) + face         the least key is the nearest face      (3)
    seconds >= bytes moved / (bytes a second)         so read once, write once               (4)
    item[start[k] : start[k + 1]]                     the items of bin k, one after another  (5)
    sum_v = values of bin v, added in their order     a thread a vertex gathers              (6)
    M_f = [p_0 p_1 p_2; 1 1 1]                        pass 1, a thread a face: M_f^-1        (7)
    c = M_f^-1 (x, y, 1),  depth = 1 / sum c_k / z_k  pass 2, a thread a pixel: a bin        (8)
    picture = depth sum c_k A_k / z_k                 pass 3, a thread a pixel               (9)

A thread is one call of the body. Nobody says which comes first. @kernel compiles these loops where
numba is installed. (7) to (9) are neural_renderer's passes, with lab 10's M^-1. A face covers a
sample where all c_k >= 0. The whole pipeline in this form is in course/fast: face_kernels.py,
pixel_kernels.py and pair_kernels.py, and compiled_pipeline.py starts their threads.

Sources: a reading of neural_renderer's rasterizer; Laine and Karras 2011 (5); Williams, Waterman
and Patterson 2009 (4).
"""
import numpy as np

from course.given.compiled import kernel


@kernel
def writers(boxes, width, height):  # step 17.1
    """Eq. (2) for a thread a face: how many threads write to each pixel?

    boxes (F, 4) integers: left, bottom, right, top. A face writes to the columns left <= j < right
    of the rows bottom <= i < top -> (height, width).

    >>> writers(np.array([[0, 0, 2, 2], [1, 0, 3, 1]]), 4, 2)
    array([[1, 2, 1, 0],
           [1, 1, 0, 0]])
    """
    count = np.zeros((height, width), np.intp)
    for left, bottom, right, top in boxes:
        for i in range(bottom, top):
            for j in range(left, right):
                count[i, j] += 1
    return count


@kernel
def race(face, depth, schedule):
    """A z-buffer of one pixel without atomics: which face and depth are there in the end?

    face, depth (N,): what each thread brings. schedule (2 N,): which thread takes the next step.
    Its first step reads the depth that is there. Its second writes its own, if that is less than
    what it has read.

    >>> face, depth = np.array([7, 8]), np.array([0.25, 0.5])
    >>> race(face, depth, np.array([0, 0, 1, 1])), race(face, depth, np.array([0, 1, 0, 1]))
    ((7, 0.25), (8, 0.5))
    """
    seen = -1
    nearest = np.inf
    read = np.full(len(face), -1.0)
    has_read = np.zeros(len(face), np.bool_)
    for thread in schedule:
        if not has_read[thread]:
            has_read[thread] = True
            read[thread] = nearest
        elif depth[thread] < read[thread]:
            seen, nearest = int(face[thread]), float(depth[thread])
    return seen, nearest


@kernel
def nearest_faces(pixel, depth, face, count):  # exercise 17.2 (3 points)
    """Eq. (3): the face that each of count pixels sees, whatever the order of the fragments.

    pixel, depth, face (N,): fragments, depth from -1 to 1 -> face (count,), -1 where none comes.
    Each does key[p] = min(key[p], its key) in np.int64, of which the largest is 2^62 + face. The
    face is found in the key. See `demo tiles`.

    >>> nearest_faces(np.array([2, 0, 2]), np.array([0.5, -1.0, 0.25]), np.array([7, 8, 9]), 4)
    array([ 8, -1,  9, -1])
    """
    none = 3 << 61  # more than any key
    key = np.full(count, none, np.int64)
    for n in range(len(pixel)):
        own = int(np.floor((depth[n] + 1) * 2**29)) * 2**32 + int(face[n])
        key[pixel[n]] = min(key[pixel[n]], own)
    found = np.full(count, -1)
    for p in range(count):
        if key[p] < none:
            found[p] = key[p] % 2**32
    return found


def mixed_in_passes(e, a):
    """sum e_k a_k / sum e_k for N pixels as NumPy does it, an array for each step.

    e, a (3, N) -> (N,).
    """
    s = e[0] + e[1]
    s = s + e[2]
    b = e / s
    parts = b * a
    mixed = parts[0] + parts[1]
    return mixed + parts[2]


@kernel
def mixed_at_once(e, a):  # extra 17.3 (2 points)
    """Eq. (4): `mixed_in_passes` as one loop over n, which makes no array but the result.

    e, a (3, N) -> sum e_k a_k / sum e_k (N,).

    >>> mixed_at_once(np.array([[1.0, 2.0], [1.0, 0.0], [2.0, 2.0]]),
    ...               np.array([[4.0, 1.0], [8.0, 5.0], [0.0, 3.0]]))
    array([3., 2.])
    """
    mixed = np.empty(e.shape[1])
    for n in range(e.shape[1]):
        e0, e1, e2 = e[0, n], e[1, n], e[2, n]
        mixed[n] = (e0 * a[0, n] + e1 * a[1, n] + e2 * a[2, n]) / (e0 + e1 + e2)
    return mixed


@kernel
def bins(bin_of, count):  # exercise 17.4 (3 points)
    """Eq. (5): which items are in each of count bins? -> start (count + 1,), item (N,)

    bin_of (N,): the bin of each item n. A bin's items stand in the order of their numbers. Three
    loops do it: count, add the counts up, fill.

    >>> bins(np.array([2, 0, 2, 2, 0]), 4)
    (array([0, 2, 2, 5, 5]), array([1, 4, 0, 2, 3]))
    """
    start = np.zeros(count + 1, np.intp)
    for n in range(len(bin_of)):
        start[bin_of[n] + 1] += 1
    for k in range(count):
        start[k + 1] += start[k]
    free = start.copy()
    item = np.empty(len(bin_of), np.intp)
    for n in range(len(bin_of)):
        item[free[bin_of[n]]] = n
        free[bin_of[n]] += 1
    return start, item


@kernel
def tile_lists(boxes, size, across, down):  # exercise 17.5 (4 points)
    """Eq. (5) for tiles: which faces must each look at? -> start (across down + 1,), item

    boxes (F, 4) as in `writers`, none empty. Tiles are size pixels wide and high. Tile i across + j
    lists, in order, the faces whose box shares a pixel with it. `writers`, asked of tiles, counts
    the pairs, and `bins` sorts them. See `demo tiles`.

    >>> tile_lists(np.array([[0, 0, 2, 2], [3, 1, 5, 2]]), 4, 2, 1)
    (array([0, 2, 3]), array([0, 1, 1]))
    """
    tiles = np.concatenate((boxes[:, :2] // size, (boxes[:, 2:] - 1) // size + 1), 1)
    total = writers(tiles, across, down).sum()
    face, tile = np.empty(total, np.intp), np.empty(total, np.intp)
    pair = 0
    for f in range(len(tiles)):
        left, bottom, right, top = tiles[f]
        for i in range(bottom, top):
            for j in range(left, right):
                face[pair], tile[pair] = f, i * across + j
                pair += 1
    start, order = bins(tile, across * down)
    return start, face[order]


@kernel
def gathered(start, item, values):  # exercise 17.6 (2 points)
    """Eq. (6): for each bin, the sum of its items' values, added in their order.

    start (K + 1,), item (N,) of `bins`, values (N, C) -> (K, C). A thread a bin. See `demo tiles`.

    >>> start, item = np.array([0, 2, 2, 3]), np.array([0, 2, 1])
    >>> gathered(start, item, np.array([[1.0, 5.0], [10.0, 6.0], [100.0, 7.0]]))
    array([[101.,  12.],
           [  0.,   0.],
           [ 10.,   6.]])
    """
    total = np.zeros((len(start) - 1, values.shape[1]))
    for k in range(len(start) - 1):
        for place in range(start[k], start[k + 1]):
            for channel in range(values.shape[1]):
                total[k, channel] += values[item[place], channel]
    return total


@kernel
def invert_face(face, triangles, inverse):
    """Eq. (7), pass 1, the thread of one face: inverse[face] becomes M^-1, or nan without an area.

    triangles (F, 3, 2): the faces' corners, inverse (F, 3, 3).
    """
    double_area = 0.0
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        x_i, y_i, x_j, y_j = (triangles[face, i, 0], triangles[face, i, 1],
                              triangles[face, j, 0], triangles[face, j, 1])
        inverse[face, k, 0], inverse[face, k, 1] = y_i - y_j, x_j - x_i
        inverse[face, k, 2] = x_i * y_j - x_j * y_i
        double_area += inverse[face, k, 2]
    if double_area == 0:
        double_area = np.nan
    for k in range(3):
        for axis in range(3):
            inverse[face, k, axis] /= double_area


@kernel
def three_passes(triangles, z, colours, lists, size, width, height):  # exercise 17.7 (6 points)
    """Eqs. (7) to (9): neural_renderer's forward pass as kernels -> picture (height, width, C).

    triangles (F, 3, 2): corners in pixels, z (F, 3) > 0, colours (F, 3, C), lists: start and item
    of `tile_lists`, of tiles of size pixels. Pass 1 is the given `invert_face`: nan marks a face
    without area, which covers nothing. Passes 2 and 3 are one loop over pixels, sampled at
    (j + 0.5, i + 0.5). A pixel looks at its tile's faces alone, sees the first of equally deep
    ones, and is 0 without one. See `demo tiles`.

    >>> triangles, z = np.array([[[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]]]), np.array([[1.0, 1.0, 2.0]])
    >>> colours, lists = np.array([[[8.0], [4.0], [4.0]]]), (np.array([0, 1, 1]), np.array([0]))
    >>> three_passes(triangles, z, colours, lists, 2, 4, 2).round(3)[..., 0]
    array([[6.857, 5.714, 0.   , 0.   ],
           [4.8  , 0.   , 0.   , 0.   ]])
    """
    start, item = lists
    across = (width + size - 1) // size
    inverse = np.empty((len(triangles), 3, 3))
    for face in range(len(triangles)):
        invert_face(face, triangles, inverse)
    picture = np.zeros((height, width, colours.shape[2]))
    for pixel in range(width * height):
        i, j = pixel // width, pixel % width
        x = j + 0.5
        y = i + 0.5
        tile = i // size * across + j // size
        seen = -1
        nearest = np.inf
        q0, q1, q2 = 0.0, 0.0, 0.0
        for face in item[start[tile]:start[tile + 1]]:
            c = inverse[face, :, 0] * x + inverse[face, :, 1] * y + inverse[face, :, 2]
            if c[0] >= 0 and c[1] >= 0 and c[2] >= 0:
                p0, p1, p2 = c[0] / z[face, 0], c[1] / z[face, 1], c[2] / z[face, 2]
                depth = 1 / (p0 + p1 + p2)
                if depth < nearest:
                    seen, nearest, q0, q1, q2 = face, depth, p0, p1, p2
        if seen >= 0:
            for k in range(colours.shape[2]):
                picture[i, j, k] = nearest * (q0 * colours[seen, 0, k] + q1 * colours[seen, 1, k]
                                              + q2 * colours[seen, 2, k])
    return picture
