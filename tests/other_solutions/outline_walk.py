"""Lab 8's walk once more: one walker after the other."""
import numpy as np

from course.given.arrays import EDGES
from reference.antialiasing import Pairs, crossing, pair_frame
from reference.outlines import all_silhouettes, leave_faces, neighbours


def joined(found):
    """One Pairs of those of one pair each."""
    return Pairs(*(np.concatenate(parts, -1) for parts in zip(*found, strict=True)))


def enter_faces(owner, other, corner, screen, faces, width):
    found = []
    for n, number in enumerate(corner):
        face, entered = divmod(int(number), 3)
        one = slice(n, n + 1)
        screen_x, screen_y, w = (values[faces[face]] for values in screen)
        x, y = pair_frame(screen_x[:, None], screen_y[:, None], owner[one], other[one], width)
        above = np.sign(w) * y[:, 0] >= 0
        edge = next(k for k in range(3) if k != entered
                    and above[EDGES[k][0]] != above[EDGES[k][1]])
        i, j = EDGES[edge]
        is_seen = np.sign(w[i]) * abs(y[j]) + np.sign(w[j]) * abs(y[i]) > 0
        c = crossing(x[i], y[i], x[j], y[j]) if is_seen else np.full(1, np.inf)
        found.append(Pairs(owner[one], other[one], c, faces[face, [i, j]][:, None], x[[i, j]],
                           y[[i, j]], np.array([face]), np.array([edge])))
    return joined(found) if found else leave_faces(owner, other, corner, screen, faces, width)


def walk(pairs, goal, screen, faces, opposite, silhouette, width):
    found = [Pairs(*(np.asarray(values)[..., :0] for values in pairs))]
    for n in range(len(pairs[0])):
        pair = Pairs(*(np.asarray(values)[..., n:n + 1] for values in pairs))
        one = pair[:2]
        while -np.inf < pair.c[0] < 1 and not silhouette[pair.face[0], pair.edge[0]]:
            across = opposite[pair.face, pair.edge]
            if across[0] // 3 == goal[n]:
                break
            pair = enter_faces(*one, across, screen, faces, width)
        found.append(pair)
    return joined(found)


def outline_pairs(face_index, depth, clip, faces, opposite):
    height, width = face_index.shape
    screen, silhouette = all_silhouettes(clip, faces, opposite, width, height)
    seen = face_index.ravel()
    found = [leave_faces(*np.zeros((3, 0), int), screen, faces, width)]
    others = found[:]
    for pair in zip(*neighbours(face_index, depth), strict=True):
        for owner, other in pair, pair[::-1]:
            if seen[owner] < 0:
                break
            one = leave_faces(np.array([owner]), np.array([other]), seen[[owner]], screen, faces,
                              width)
            one = walk(one, seen[[other]], screen, faces, opposite, silhouette, width)
            if silhouette[one.face[0], one.edge[0]] and one.c[0] <= 1:
                found.append(one)
                break
            if one.c[0] < 1:
                break
            if owner == pair[1]:
                others.append(one)
    return joined(found), joined(others)
