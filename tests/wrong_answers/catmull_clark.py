"""Wrong answers to catmull_clark, written without a look at the checks."""


def catmull_clark_slow(vertices, corners, counts):
    """r is the mean of the neighbours instead of the mean of the middles of the edges

    told by: middle & edge & R | midpoint & R | R & neighbour | R & ring | mean of the middles | mean of the neighbours | middle & vert
    """
    polys = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    centre = np.array([vertices[p].mean(0) for p in polys])
    moved = []
    for v in range(len(vertices)):
        ring, rim = ring_of(v, at_edge)
        n = len(ring)
        if rim:
            moved.append(0.75 * vertices[v] + 0.125 * vertices[rim].sum(0))
        elif n == 0:
            moved.append(vertices[v])
        else:
            F = np.mean([centre[f] for f, p in enumerate(polys) if v in p], axis=0)
            R = vertices[ring].mean(0)
            moved.append((F + 2 * R + (n - 3) * vertices[v]) / n)
    on_edges = []
    for (a, b), its in at_edge:
        s = vertices[a] + vertices[b]
        on_edges.append(s / 2 if len(its) == 1 else (s + centre[its].sum(0)) / 4)
    return np.concatenate([moved, on_edges, centre])
