"""Catmull and Clark's exercises of lab 11 as printed."""


def catmull_clark_slow(vertices, corners, counts):
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    f = np.array([vertices[face].mean(0) for face in faces])
    new = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        n = len(ring)
        if along:
            a, b = along
            new.append((1 - 2 / 8) * vertices[v] + 1 / 8 * (vertices[a] + vertices[b]))
        else:
            F = np.mean([f[k] for k in range(len(faces)) if v in faces[k]], axis=0)
            R = np.mean([(vertices[v] + vertices[w]) / 2 for w in ring], axis=0)
            new.append((F + 2 * R + (n - 3) * vertices[v]) / n)
    for (a, b), at in at_edge:
        if len(at) == 1:
            new.append(1 / 2 * (vertices[a] + vertices[b]))
        else:
            new.append((vertices[a] + vertices[b] + f[at[0]] + f[at[1]]) / 4)
    return np.array([*new, *f])
