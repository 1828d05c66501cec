"""Mistakes of lab 11: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
CENTRE = "the corners of the middle triangle begin elsewhere: they are AB, BC, CA"
NOT_BOUNDARY = "a vertex on the boundary is pulled inwards, too"
OWN_INSIDE = "(1 - len(ring) * u[v]) * vertices[v]"
ON_BOUNDARY = "points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0))"
IN_PLACE = """vertices = vertices.copy()
            vertices[v] = 3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0)
            points.append(vertices[v])"""
INSIDE_RULE = "the inside's rule is used on the boundary, too"

MISTAKES = {
    "11.1": [
        ("np.minimum(start, end) * vertex_count + np.maximum(start, end)",
         "start * vertex_count + end", "an edge runs as the face does, not from low to high: one "
         "of two faces is there twice"),
        ("np.minimum(start, end) * vertex_count + np.maximum(start, end)",
         "np.maximum(start, end) * vertex_count + np.minimum(start, end)",
         "edges run from high to low, and ascend by high"),
        ("start[next_corner(counts)]", "np.roll(start, -1)",
         "a face's last corner is joined to the next face's first; it is to its own first"),
        ("start[next_corner(counts)]", "np.roll(start.reshape(-1, int(counts[0])), -1, 1).ravel() "
         "if len(start) % int(counts[0]) == 0 else np.roll(start, -1)",
         "all faces are taken to have as many corners as the first"),
        ("corners.astype(np.int64)", "corners", "numbers are packed into a type too narrow for "
         "their product"),
        ("np.divmod(key, vertex_count)", "np.divmod(key, vertex_count)[::-1]",
         "low and high are swapped"),
    ],
    "11.2": [
        ("regular // 2 + 1", "regular // 2", "on the boundary half of the valence counts as "
         "regular; it is one more"),
        ("np.where(at_boundary, regular // 2 + 1, regular)", "regular",
         "the boundary is not looked at"),
        (" & (valence > 0)", "", "vertices of no edge are extraordinary; they are not"),
        ("(valence != ", "(valence == ", "regular vertices are told, instead of the others"),
        ("np.where(at_boundary, regular // 2 + 1, regular)",
         "np.where(at_boundary, regular, regular // 2 + 1)", "inside and boundary are swapped"),
    ],
    "11.3": [
        ("len(np.unique(corners))", "int(corners.max() + 1)", "vertices of no face are counted"),
        ("len(np.unique(corners))", "len(corners)", "a vertex counts once for each of its faces"),
        ("len(edges_of(corners, counts)[0])", "len(corners)", "an edge counts once for each of its "
         "faces"),
        ("+ len(counts)", "- len(counts)", "faces are taken away; they are added"),
        ("len(counts)", "len(corners) // 3", "all faces are taken for triangles"),
    ],
    "11.4": [
        (" ** 2", "", "the square is missing"),
        ("np.cos(2 * np.pi / n)", "np.cos(360 / n)", "the angle is in degrees; the cosine takes "
         "radians"),
        (") / n", ")", "it is not divided by n: u is the weight of one neighbour, not of all"),
        ("np.cos(2 * np.pi / n) / 4", "np.cos(2 * np.pi / n)", "the cosine's 1/4 is missing"),
        ("2 * np.pi", "np.pi", "half of the turn is taken: the angle is 2 pi / n"),
        ("(5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2) / n",
         "np.where(n == 3, 3 / 16, 3 / (8 * n))", "Warren's weights are taken for Loop's own"),
    ],
    "11.5": [
        ("vertices[ring].sum(0)", "vertices[ring].mean(0)", "the ring's mean is weighted with u; "
         "each neighbour has u for itself"),
        (OWN_INSIDE, "(1 - u[v]) * vertices[v]", "v keeps 1 - u instead of 1 - n u"),
        (ON_BOUNDARY, ON_BOUNDARY.replace("beside", "ring"),
         NOT_BOUNDARY + ", by all its neighbours"),
        ("        if beside:\n", "        if False:\n", INSIDE_RULE),
        (ON_BOUNDARY, "points.append(vertices[v])", "vertices on the boundary stay"),
        ("3 / 8 * ends + 1 / 8 *", "1 / 8 * ends + 3 / 8 *", "3/8 and 1/8 are swapped at an edge"),
        ("ends / 2 if len(its_faces) == 1 else\n                      ", "",
         "the inside's rule is used for edges on the boundary, too"),
        ("3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0)", "ends / 2",
         "every edge gets its middle; inside, the opposite vertices pull, too"),
        (ON_BOUNDARY, IN_PLACE,
         "points that have moved already pull at the next ones; all rules are about old points"),
    ],
    "11.6": [
        ("np.concatenate([u, -u])", "np.concatenate([u, u])", "the pulled vertex gets heavier: "
         "what it gives away has the other sign"),
        ("np.concatenate([u, -u])", "np.concatenate([u, 1 - u])", "every pull brings a 1 of its "
         "own for the diagonal; that 1 is there already"),
        ("np.concatenate([u, -u])", "np.concatenate([u, 0 * u])", "the pulled vertex keeps its "
         "whole weight: a pull's entries add up to 0"),
        ("np.concatenate([columns, rows])", "np.concatenate([columns, columns])",
         "both entries of a pull are in one column: they add up to nothing"),
        ("np.concatenate([rows, rows]), np.concatenate([columns, rows])",
         "np.concatenate([columns, rows]), np.concatenate([rows, rows])",
         "rows and columns are swapped"),
        ("np.concatenate([rows, rows])", "np.concatenate([rows, columns])",
         "u is taken away from the neighbour instead of from the vertex that is pulled"),
    ],
    "11.7": [
        ("along | ~at_boundary[start]", "np.ones(len(start), bool)", NOT_BOUNDARY + ", by its u"),
        ("along | ~at_boundary[start]", "along | ~(at_boundary[start] & at_boundary[end])",
         "a vertex on the boundary is pulled by neighbours inside"),
        ("np.where(along, beside, u[start])", "np.where(along, beside, u[end])",
         "a vertex is pulled with its neighbour's u instead of its own"),
        ("np.concatenate([edges, edges[:, ::-1]])", "np.concatenate([edges, edges])",
         "only the lower end of an edge is pulled, and twice"),
        ("np.isin(every, edges[is_boundary])",
         "np.bincount(edges[is_boundary][:, 0], minlength=len(u)) > 0",
         "of a boundary edge only the lower end counts as being on the boundary"),
        ("np.where(along, beside, u[start])", "(u[start] + 0 * along)",
         "u is used on the boundary, too; there it is the number beside"),
        ("np.where(along, beside, u[start])", "np.where(at_boundary[start], beside / 2, u[start])",
         "both neighbours along the boundary pull by beside together; each does by itself"),
        ("(every, every, np.ones(len(u)))", "(start, start, np.ones(len(start)))",
         "the 1 on the diagonal comes once for each edge; a vertex of no edge has none"),
    ],
    "11.8": [
        ("np.where(is_boundary, 1 / 2, 3 / 8)", "np.where(is_boundary, 3 / 8, 1 / 2)",
         "the weights inside and on the boundary are swapped"),
        ("np.where(is_boundary, 1 / 2, 3 / 8)", "np.full(len(edges), 3 / 8)",
         "3/8 is taken on the boundary, too"),
        ("inside = ~is_boundary[corner_edge]", "inside = np.ones(len(corner_edge), bool)",
         "the opposite vertex pulls on the boundary, too"),
        ("np.roll(faces, 1, axis=1)", "np.roll(faces, -1, axis=1)",
         "the next corner is taken for the opposite one: that is an end of the edge"),
        ("np.roll(faces, 1, axis=1)", "faces", "a corner of the edge is taken for the opposite "
         "one"),
        ("np.roll(faces, 1, axis=1)", "np.roll(faces, 1)", "corners are rolled over into the next "
         "face: each face is a row of its own"),
        ("1 / 8)))", "1 / 4)))", "each opposite vertex weighs 1/4; both together do"),
    ],
    "11.9": [
        ("ca, bc, c, ab, bc, ca]", "c, ca, bc, ab, bc, ca]",
         "the third child begins with its old corner: corner k of child k is the old one"),
        ("ca, bc, c, ab, bc, ca]", "ca, bc, c, ab, ca, bc]", "the triangle in the middle is wound "
         "the other way"),
        ("ca, bc, c, ab, bc, ca]", "ca, bc, c, bc, ca, ab]", CENTRE),
        ("ab, bc, ca = (", "ca, ab, bc = (", "edges go with the corner that they run to; they run "
         "from it"),
        ("(vertex_count + corner_edge)", "corner_edge", "the new vertices are numbered from 0; "
         "they come after the old ones"),
        ("[a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1)",
         "[a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]).reshape(4, 3, -1).swapaxes(1, 2)",
         "all first children come first; the four of a face stand together"),
    ],
    "11.10": [
        ("(vertices[v] + vertices[ring]) / 2", "vertices[ring]",
         "R is the mean of the neighbours; it is that of the edges' middles"),
        ("(len(ring) - 3) * vertices[v]) / len(ring)", "vertices[v]) / 4",
         "the weights are those of valence 4, whatever the valence is"),
        ("2 * middles.mean(0)", "middles.mean(0)", "R counts once; it counts twice"),
        ("        if beside:\n", "        if False:\n", INSIDE_RULE),
        (ON_BOUNDARY, "points.append(vertices[v])", "vertices on the boundary stay"),
        ("(ends + face_points[its_faces].sum(0)) / 4", "ends / 2",
         "every edge gets its middle; inside, the face points pull, too"),
        ("ends / 2 if len(its_faces) == 1 else\n                      ", "",
         "the inside's rule is used for edges on the boundary, too"),
        ("np.concatenate([points, face_points])", "np.concatenate([points[:len(vertices)], "
         "face_points, points[len(vertices):]])",
         "face points come before those of edges"),
        ("face_points[around].mean(0)", "face_points[around].sum(0)",
         "F is the sum of the face points instead of their mean"),
    ],
    "11.11": [
        ("vertex_count + face_of_corner(counts)", "face_of_corner(counts)",
         "face points are in the columns from 0 on; these are the vertices'"),
        ("np.where(is_boundary, 1 / 2, 1 / 4)", "np.full(len(edges), 1 / 4)",
         "1/4 is taken on the boundary, too"),
        ("inside = ~is_boundary[corner_edge]", "inside = np.ones(len(corner_edge), bool)",
         "the face point pulls on the boundary, too"),
        ("np.full(inside.sum(), 1 / 4)", "np.full(inside.sum(), 1 / 8)",
         "each face point weighs 1/8; that is Loop's weight"),
        ("np.where(is_boundary, 1 / 2, 1 / 4)", "np.full(len(edges), 1 / 2)",
         "the ends weigh 1/2 inside, too: the row's sum is not 1"),
        ("face_of_corner(counts)", "np.arange(len(corner_edge)) // int(counts[0])",
         "all faces are taken to have as many corners as the first"),
    ],
    "11.12": [
        ("** 2", "** 1", "the pull is 1 / n; it is 1 / n^2"),
        ("pull_entries(corners[inside], face_point[inside], u[corners[inside]])",
         "pull_entries(corners[:0], face_point[:0], u[:0])", "no face point pulls"),
        ("inside = ~np.isin(corners, edges[is_boundary])", "inside = np.ones(len(corners), bool)",
         "face points pull at the boundary, too"),
        ("vertex_rows(edges, is_boundary, u,", "vertex_rows(edges, is_boundary, 2 * u,",
         "a neighbour pulls by 2 / n^2: R is of the middles, which halves it"),
        ("len(n) + face_of_corner(counts)", "face_of_corner(counts)",
         "face points are in the columns from 0 on; these are the vertices'"),
        ("1 / 8)", "1 / 6)", "the boundary has the limit's 1/6; a step has 1/8"),
        ("u[corners[inside]])", "(1 / counts)[face_of_corner(counts)][inside])",
         "a face point pulls by 1 / (its face's corners)"),
    ],
    "11.13": [
        ("[corners, ahead, middle, behind]", "[corners, behind, middle, ahead]",
         "quads are wound the other way"),
        ("[corners, ahead, middle, behind]", "[middle, behind, corners, ahead]",
         "quads begin with the face's vertex; they begin with the corner"),
        ("    behind[next_corner(counts)] = ahead\n",
         "    behind[:] = ahead[next_corner(counts)]\n",
         "the edge of the next corner is taken for that of the one before"),
        ("    behind[next_corner(counts)] = ahead\n", "    behind[:] = np.roll(ahead, 1)\n",
         "a face's first corner takes the last edge of the face before"),
        ("vertex_count + corner_edge.max() + 1 + face_of", "vertex_count + face_of",
         "the faces' vertices have the numbers of the edges'"),
        ("corner_edge.max() + 1 + ", "len(corner_edge) + ",
         "E is taken to be the number of corners; an edge of two faces counts once"),
    ],
    "11.14": [
        ("3 / (8 * u)", "8 * u / 3", "the fraction is upside down"),
        ("3 / (8 * u)", "3 / 8 * u", "it is multiplied by u instead of divided"),
        ("1 / (n + 3 / (8 * u))", "u + 0.0 * n", "the weight of one step is taken for that of the "
         "limit"),
        ("1 / (n + 3 / (8 * u))", "n / (n + 3 / (8 * u))", "it is the weight of all neighbours "
         "together"),
        ("n + 3", "1 + 3", "n is left out"),
    ],
    "11.15": [
        ("4 * u, 1 / 6)", "u, 1 / 6)", "the ring's 4 is missing"),
        ("1 / 6)", "1 / 8)", "the boundary has the 1/8 of a step; the limit has 1/6"),
        ("np.roll(quads, 2, axis=1)", "np.roll(quads, 1, axis=1)",
         "a neighbour is taken for the diagonal's end"),
        ("np.roll(quads, 2, axis=1)", "np.roll(quads, 2)",
         "corners are rolled over into the next quad: each quad is a row of its own"),
        ("inside = ~np.isin(quads, edges[is_boundary])", "inside = np.ones(quads.shape, bool)",
         "diagonals pull at the boundary, too"),
        ("(n + 5)", "(n + 4)", "the denominator is n (n + 4)"),
        ("1 / (np.maximum(n, 1) * (n + 5))", "1 / (n + 5.0)", "it is not divided by n"),
        ("pull_entries(quads[inside], across[inside], u[quads[inside]])",
         "pull_entries(quads[:0, 0], across[:0, 0], u[:0])", "no diagonal pulls"),
        ("np.isin(quads, edges[is_boundary])", "(n[quads] != 4)",
         "the boundary is told by valences: a vertex inside may have another one than 4"),
    ],
}
