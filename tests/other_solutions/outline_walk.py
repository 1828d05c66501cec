"""Lab 8's walk once more: one walker after the other."""
import numpy as np

from reference.antialiasing import Pairs
from reference.outline_walk import enter_faces
from reference.outlines import all_silhouettes, leave_faces, neighbours


def joined(found):
    """One Pairs of those of one pair each."""
    return Pairs(*(np.concatenate(parts, -1) for parts in zip(*found, strict=True)))


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
