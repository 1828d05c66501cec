"""Mistakes of lab 13: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
ANGLE = "np.arctan2(np.linalg.norm(np.cross(p, q), axis=-1), (p * q).sum(-1))"
DIGITS = ": a tiny angle loses half of its digits"
FLAT = "twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)"
NEXT_CORNER = "the angles are those of the next corner"
TWO_ROWS = "np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])"
VALUES = "np.concatenate([-weights, -weights, weights, weights])"
ROUNDS = """x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, -grow)"""
FROM_THE_FIRST = """x = (smooth_explicit(x, edges, weights, mass, shrink)
             + smooth_explicit(x, edges, weights, mass, -grow) - x)"""

MISTAKES = {
    "13.1": [
        (ANGLE, f"np.degrees({ANGLE})", "angles are in degrees; they are radians"),
        (ANGLE, "np.arccos(np.clip((unit(p) * unit(q)).sum(-1), -1, 1))",
         f"it is an arccos{DIGITS}, and a corner that coincides with another has a right angle"),
        (ANGLE, "np.arcsin(np.clip(np.linalg.norm(np.cross(unit(p), unit(q)), axis=-1), 0, 1))",
         "it is an arcsin: it cannot tell an obtuse angle from an acute one"),
        ("p, q = sides(triangles)", "p, q = sides(np.roll(triangles, -1, -2))", NEXT_CORNER),
        (ANGLE, "np.arctan2(np.cross(p, q)[..., 2], (p * q).sum(-1))",
         "only z of the cross product is looked at: right in the plane alone"),
        ("p, q = sides(triangles)", "p, q = sides(triangles)\n    q = q - p",
         "it is the angle between two sides in a row: the outer one, of another corner"),
    ],
    "13.2": [
        ("4 * twice_area**2", "2 * twice_area**2", "the factor 2 of q = 2 r / R is missing"),
        ("return 4 * twice_area**2 / np.where(below > 0, below, 1)",
         "return below / np.where(twice_area > 0, 4 * twice_area**2, np.inf)",
         "the ratio is upside down"),
        ("4 * twice_area**2", "16 * twice_area**2", "twice the area is taken for the area"),
        ("return 4 * twice_area**2 / np.where(below > 0, below, 1)",
         "return 6 * 3**0.5 * twice_area / np.where(below > 0, length.sum(-1)**2, 1)",
         "it is the area over the perimeter squared: another measure of roundness"),
        ("np.where(below > 0, below, 1)", "below", "where corners coincide, 0 is divided by 0"),
        ("length.prod(-1)", "length.prod(-1)**(2 / 3)", "the units do not cancel: large triangles "
         "seem better"),
    ],
    "13.3": [
        ("np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, twice_area))",
         "np.where(flat, 0, twice_area / np.where((p * q).sum(-1) == 0, np.inf, (p * q).sum(-1)))",
         "it is the tangent"),
        ("/ np.where(flat, 1, twice_area)", "/ np.where(flat, 1, twice_area / 2)",
         "it is divided by the area; the cross product is twice that"),
        ("(p * q).sum(-1) /", "np.abs((p * q).sum(-1)) /", "the sign is lost: of an obtuse angle "
         "it is negative"),
        ("p, q = sides(triangles)", "p, q = sides(np.roll(triangles, -1, -2))", NEXT_CORNER),
        (FLAT, "twice_area <= NO_AREA", "the area is compared with a number as it is: small "
         "triangles count as flat"),
        (FLAT, "twice_area <= 0", "only an area of exactly 0 counts as none"),
        (".max(-1, keepdims=True)", ".min(-1, keepdims=True)",
         "the area is compared with the shortest side; it is the longest"),
    ],
    "13.4": [
        ("by_s = -(", "by_s = 0 * (", "the area counts as constant"),
        ("by_s = -(", "by_s = (", "the area's part has the wrong sign: a cotangent "
         "falls where the area grows"),
        (" - by_p - by_q\n", "\n", "the corner itself has no part in its two sides"),
        ("by_dot * q, by_dot * p", "by_dot * p, by_dot * q",
         "the derivative of p . q by p is q, not p"),
        ("area_vector / s, q - p", "area_vector, q - p", "the normal is not brought to length 1"),
        ("keepdims=True)).sum(-2, keepdims=True) / s", "keepdims=True)) / s",
         "each corner moves the area of its own cotangent alone; all three have the same area"),
        ("np.where(flat, 0, grad_cotangents[..., None] / s)", "grad_cotangents[..., None] / s",
         "flat triangles have a gradient; their cotangents are set to 0"),
    ],
    "13.5": [
        (" / 2", "", "the half is forgotten"),
        ("return np.bincount(face_edges.ravel(), cotangents.ravel(), edge_count) / 2",
         "weights = np.zeros(edge_count)\n    weights[face_edges] += cotangents / 2\n"
         "    return weights", "an edge keeps the cotangent of its last face; they add up"),
        (" / 2", " / np.maximum(np.bincount(face_edges.ravel(), minlength=edge_count), 1)",
         "it is the mean of an edge's cotangents: at the boundary half of one is asked for"),
        ("cotangents.ravel()", "np.roll(cotangents, 1, 1).ravel()",
         "an edge gets the cotangent of one of its ends, not of the corner opposite to it"),
        ("cotangents.ravel()", "np.abs(cotangents).ravel()",
         "negative cotangents lose their sign"),
    ],
    "13.6": [
        (VALUES, "np.concatenate([weights, weights, -weights, -weights])",
         "it is -L: the diagonal is positive"),
        (VALUES, "np.concatenate([-weights, -weights, 0 * weights + 1, 0 * weights + 1])",
         "the valence stands on the diagonal; it is the sum of the weights"),
        (VALUES, "np.concatenate([-weights, -weights, 0 * weights, 0 * weights])",
         "the diagonal is missing: rows must add up to 0"),
        (VALUES, "np.concatenate([-weights, 0 * weights, weights, weights])",
         "the edge from j to i is missing: L is symmetric"),
        (VALUES, "np.concatenate([-weights, -weights, weights, weights]) / 2",
         "each edge counts half"),
        (VALUES, "np.concatenate([-weights, -weights, weights, 0 * weights])",
         "only one end of an edge has it on the diagonal"),
    ],
    "13.7": [
        ("y * per_mass(y, mass)", "per_mass(y, mass)**2", "the mass is squared"),
        ("per_mass(y, mass)", "y", "the mass is left out"),
        ("(y * per_mass(y, mass)).sum()", "(x * y).sum()", "it is x . L x: the sum over the edges "
         "of squared lengths"),
        (".sum()", ".mean()", "it is the mean over vertices and channels instead of the sum"),
        ("(y * per_mass(y, mass)).sum()", "(y * per_mass(y, mass)).sum() / 2",
         "there is a half; eq. (4) has none"),
        ("(y * per_mass(y, mass)).sum()", "(y**2 * mass[:, None]).sum()",
         "it is multiplied by the mass instead of divided"),
        ("(edges, weights, len(x))", "(edges, np.ones(len(edges)), len(x))",
         "all weights are taken to be 1"),
    ],
    "13.8": [
        ("L @ grad_y,", "grad_y,", "L is applied once; the gradient goes through it again"),
        ("grad_y = 2 *", "grad_y =", "the 2 of the square is missing"),
        ("-grad_energy * (z**2)", "grad_energy * (z**2)", "the gradient by the mass has the wrong "
         "sign"),
        ("* (z**2).sum(1)", "* (z * (L @ x)).sum(1)", "the gradient by the mass is divided by it "
         "once; the derivative of 1 / m is -1 / m^2"),
        ("((grad_y[i] - grad_y[j]) * (x[i] - x[j]))", "(grad_y[i] * (x[i] - x[j]))",
         "an edge's weight counts at one of its ends alone; it is in both rows of L"),
        ("(x[i] - x[j])).sum(1)", "(x[i] - x[j])).mean(1)",
         "the weights' gradient is the mean over the channels instead of the sum"),
        ("2 * grad_energy * z", "2 * z", "grad_energy is left out"),
        ("z = per_mass(L @ x, mass)", "z = L @ x", "the mass is left out"),
    ],
    "13.9": [
        ("x - step", "x + step", "the sign is wrong: the surface gets rougher"),
        ("per_mass(laplacian(edges, weights, len(x)) @ x, mass)",
         "laplacian(edges, weights, len(x)) @ x", "it is not divided by the mass"),
        ("x - step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)",
         "(1 - step) * x - step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)",
         "x is pulled towards 0, too: L x is the way to the neighbours already"),
        ("per_mass(laplacian(edges, weights, len(x)) @ x, mass)",
         "(laplacian(edges, weights, len(x)) @ x / np.maximum(mass, 1)[:, None])",
         "masses below 1 count as 1, and a vertex of mass 0 moves"),
        ("weights, len(x)", "0 * weights + 1, len(x)", "all weights are taken to be 1"),
        ("step * per", "per", "the step is left out"),
    ],
    "13.10": [
        ("mass[:, None] * x", "x", "x is not multiplied by the mass on the right"),
        ("+ step *", "- step *", "the sign of L is wrong: the surface gets rougher"),
        ("step * laplacian", "laplacian", "the step is left out"),
        ("spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)",
         "smooth_explicit(x, edges, weights, mass, step)",
         "it is the explicit step, which a large s blows up"),
        ("scipy.sparse.diags_array(mass)", "scipy.sparse.eye_array(len(x))",
         "the system has 1 on its diagonal instead of the mass"),
        ("mass = np.where(mass > 0, mass, 1)", "mass = mass + 1.0",
         "every mass is made 1 larger, not only those of 0"),
    ],
    "13.11": [
        ("mass, -grow)", "mass, grow)", "both steps shrink; the second goes the other way"),
        (ROUNDS, ROUNDS.replace("-grow", "-SHRINK").replace("shrink", "grow").lower(),
         "shrink and grow are swapped"),
        (ROUNDS, FROM_THE_FIRST,
         "the second step starts from where the first one did"),
        ("range(rounds)", "range(1)", "there is one round, however many are asked for"),
        ("        x = smooth_explicit(x, edges, weights, mass, -grow)\n", "",
         "nothing grows again: the step back is missing"),
    ],
    "13.12": [
        (" / 6", " / 3", "it is divided by 3; a tetrahedron is a sixth of the box"),
        (" / 6", "", "the sixth is missing"),
        ("np.cross(x1, x2)", "np.cross(x2, x1)", "the sign is wrong: counter-clockwise from "
         "outside is positive"),
        ("(x0 * np.cross(x1, x2)).sum()", "np.abs((x0 * np.cross(x1, x2)).sum(1)).sum()",
         "absolute values are added; faces that look at the origin must take away"),
        ("(x0 * np.cross(x1, x2)).sum()", "abs((x0 * np.cross(x1, x2)).sum())",
         "the volume lost its sign"),
        ("(x0 * np.cross(x1, x2)).sum() / 6",
         "np.linalg.norm(np.cross(x1 - x0, x2 - x0), axis=1).sum() / 2", "it is the area"),
    ],
    "13.13": [
        ("np.roll(triangles, -1, 1), np.roll(triangles, -2, 1)",
         "np.roll(triangles, -2, 1), np.roll(triangles, -1, 1)",
         "the cross product is turned round"),
        (" / 6", " / 18", "it is divided by 3 once more: each corner has the whole derivative"),
        (" / 6", "", "the sixth is missing"),
        ("grad_volume * ", "", "grad_volume is left out"),
        ("np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1))",
         "np.cross(triangles, np.roll(triangles, -1, 1))",
         "a corner gets the gradient of the one across: the cross product is of the two others"),
        ("np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1)) / 6",
         "np.cross(*sides(triangles)) / 6",
         "it is the gradient of a face that moves as a whole; corners move one by one"),
    ],
    "13.14": [
        ("corners[:, [3, 1, 0]])[:, 0]", "corners[:, [3, 1, 0]])[:, 1]",
         "delta is the angle at the edge's end; it is the one at d"),
        (" - np.pi", "", "pi is not taken away"),
        ("gamma + delta - np.pi", "np.pi - gamma - delta", "the gain has the wrong sign"),
        ("gamma + delta - np.pi", "np.degrees(gamma + delta) - 180", "it is in degrees"),
        ("gamma + delta", "gamma - delta", "delta is taken away; both angles are added"),
        ("corners[:, [2, 0, 1]])[:, 0]", "corners[:, [0, 2, 3]])[:, 0]",
         "gamma is the angle at a, between c and d"),
        ("gamma + delta - np.pi", "np.maximum(gamma, delta) - np.pi / 2",
         "an edge is flipped for one obtuse angle; it is the sum of both"),
    ],
    "13.15": [
        (" - (move * normals).sum(1, keepdims=True) * normals", "",
         "the move along the normal is not taken away"),
        ("move - (move", "move + (move", "the move along the normal is doubled instead of taken "
         "away"),
        ("vertices + move - (", "vertices + (", "only the move along the normal is left"),
        ("valence, rate) - vertices", "np.ones(len(vertices)), rate) - vertices",
         "the neighbours' pulls are added; the mean is asked for"),
        ("valence, rate)", "valence, 1.0)", "the rate is left out"),
        ("(move * normals).sum(1, keepdims=True) * normals", "move * normals**2",
         "the part along the normal is taken axis by axis: n (n . move) is a product of vectors"),
        ("valence, rate)", "valence + 1.0, rate)", "the vertex itself is in the mean"),
    ],
    "13.16": [
        ("u = x + amount * laplacian(edges, weights, len(x)) @ x", "u = x",
         "x itself is smoothed: x is taken for u, and then for x again"),
        ("    grad_u = precondition(grad_x, edges, weights, amount)\n", "    grad_u = grad_x\n",
         "the gradient is not spread out: it is the one by x"),
        ("return precondition(u, edges, weights, amount), mean", "return u, mean",
         "u is returned instead of x"),
        ("grad_u = precondition(grad_x, edges, weights, amount)",
         "grad_u = grad_x + amount * laplacian(edges, weights, len(x)) @ grad_x",
         "the gradient goes through (I + lambda L) as x does, not through its inverse"),
        ("grad_u = precondition(grad_x, edges, weights, amount)",
         "grad_u = precondition(precondition(grad_x, edges, weights, amount), edges, weights, "
         "amount)", "the gradient is spread out twice"),
        ("    u = x + amount * laplacian(edges, weights, len(x)) @ x\n", "    weights = "
         "np.ones(len(edges))\n    u = x + amount * laplacian(edges, weights, len(x)) @ x\n",
         "all weights are taken to be 1"),
        ("amount * laplacian", "laplacian", "lambda is left out of u"),
    ],
}
