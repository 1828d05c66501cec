"""Wrong answers to loop_subdivision, written without a look at the checks."""


def loop_slow(vertices, faces, u):
    """the edge points are made from the moved vertices instead of the old ones

    told by: moved | already & new | old & position | old vertices & instead | old places | updated | in place
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    moved = []
    for v in range(len(vertices)):
        ring, rim = ring_of(v, at_edge)
        pull = 1 / 8 if rim else u[v]
        near = rim if rim else ring
        moved.append((1 - len(near) * pull) * vertices[v] + pull * vertices[near].sum(0))
    moved = np.array(moved)
    edge_points = []
    for edge, its in at_edge:
        ends = moved[list(edge)].sum(0)
        if len(its) == 1:
            edge_points.append(ends / 2)
        else:
            tips = [v for f in its for v in faces[f] if v not in edge]
            edge_points.append(3 / 8 * ends + 1 / 8 * moved[tips].sum(0))
    return np.concatenate([moved, edge_points])


def loop_edge_rows(faces, edges, corner_edge):
    """only one of the two opposite corners of an edge is kept, the other is overwritten

    told by: one of & two & opposite | only one | one opposite | both opposite | overwrit | second face | both faces
    """
    rim = on_boundary(corner_edge)
    tip = {}
    for f, face in enumerate(faces):
        for k in range(3):
            tip[int(corner_edge[3 * f + k])] = face[k - 1]
    r, c, weights = [], [], []
    for e, (a, b) in enumerate(edges):
        if rim[e]:
            r += [e, e]
            c += [a, b]
            weights += [1 / 2, 1 / 2]
        else:
            r += [e, e, e]
            c += [a, b, tip[e]]
            weights += [3 / 8, 3 / 8, 1 / 8]
    return np.array(r), np.array(c), np.array(weights)
