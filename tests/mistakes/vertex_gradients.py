"""Mistakes of lab 7: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
SIGN = "the sign is wrong: a vertex drags the picture along, against its slope"
TRANSPOSED = "M is transposed: its columns are the corners"
NO_GRAD_F = "grad_f is left out of the gradient by the values"
QUOTIENT = "the sum s is taken for a constant"
SAME_SIGN = "epsilon has the same sign everywhere: it must have that of s"
NO_EPSILON = "epsilon is left out"
NO_WINDING = "the determinant's sign is lost: that of clockwise faces is negative"
OUTER = "np.outer(grad_a, c)"
STEP = "np.linalg.lstsq(jacobian, -residuals)[0]"
LEAST = "np.linalg.lstsq(jacobian[:jacobian.shape[1]], -residuals[:jacobian.shape[1]])[0]"
CROSS = "cross(corners[:, i], corners[:, j])"
TO_I, TO_J = "[:, i] += cross(corners[:, j], g)", "[:, j] += cross(g, corners[:, i])"
BOTH = f"{TO_I}\n        grad_corners{TO_J}"
EPSILON = "np.copysign(epsilon, s)"
S_CHANGES = "(grad_b - (grad_b * e).sum(0) / s) / s"
QUOTIENT_RULE = "(e_x - e / s * e_x.sum(0)) / s"
BY_S = "e_x.sum(0) * grad_e_x + through_s"
X_Y_1 = """np.bincount(face, u_k * x, count), np.bincount(face, u_k * y, count),
                      np.bincount(face, u_k, count)"""
PLANES = "-depth_planes(z, corners)[:, None] * grad_z"

MISTAKES = {
    "7.1": [
        ("np.ones(3)]", "np.ones(3)], -1", "the vertices stand in rows; they are the columns"),
        ("[*triangle.T, np.ones(3)]", "[np.ones(3), *triangle.T]",
         "the ones stand above x and y; they are the last row"),
        ("*triangle.T", "*triangle.T[::-1]", "the rows of x and of y are swapped"),
        ("np.ones", "np.zeros", "the last row is 0; a position has a 1 there"),
    ],
    "7.2": [
        ("solve(m, a)", "solve(m.T, a)", TRANSPOSED),
        ("- target", "+ target", "the target is added; it is taken away"),
        ("values @ np.linalg.solve(m, a) - target", "target - values @ np.linalg.solve(m, a)",
         "the sign is flipped: a pixel that is too bright has a positive residual"),
        ("np.linalg.solve(m, a)", "m @ a", "M is multiplied instead of its inverse"),
        ("values @ np.linalg.solve(m, a)",
         "values @ np.linalg.solve(m, a) / np.linalg.solve(m, a).sum()",
         "c is divided by its sum: that is eq. (5), not yet (2)"),
    ],
    "7.3": [
        ("-inverse", "inverse", "the sign is missing: an inverse shrinks where the matrix grows"),
        ("-inverse @ dm @ inverse", "-dm @ inverse @ inverse",
         "both inverses are on the same side; matrices do not commute"),
        ("dm @", "dm.T @", "dM is transposed"),
        (" @ inverse\n", "\n", "the inverse is there once; it is on both sides of dM"),
        ("-inverse @ dm @ inverse", "-inverse * dm * inverse",
         "elements are multiplied one by one, and not matrices"),
    ],
    "7.4": [
        ("dm[i, j]", "dm[j, i]", "rows and columns are swapped: i is the row"),
        ("return values", "return -values", SIGN),
        ("inverse_differential(m, dm)", "dm", "dM is taken for the change of the inverse"),
        ("inverse_differential(m, dm)", "inverse_differential(m, dm).T",
         "r and a are on the wrong sides: it is r^T d(M^-1) a"),
        ("dm[i, j] = 1", "dm[i] = 1", "a whole row of M moves; only one of its elements does"),
    ],
    "7.5": [
        ("inverse.T", "inverse", "the inverse is not transposed for the gradient by a"),
        (f"-{OUTER}", OUTER, SIGN),
        (OUTER, "np.outer(c, grad_a)",
         "grad_m is transposed: its row i is of row i of M, its column j of vertex j"),
        (", -grad_f\n", ", grad_f\n", "the gradient by the target has the wrong sign"),
        ("return grad_f * c", "return c", NO_GRAD_F),
        (f"-{OUTER}", f"-grad_f * {OUTER}", "grad_f counts twice in grad_m"),
    ],
    "7.6": [
        ("-c[", "c[", SIGN),
        ("* slope\n", "* slope[::-1]\n", "the derivatives by x and by y are swapped"),
        ("-c[:, :, None] * slope", "np.tile(-slope, (*c.shape, 1))",
         "all vertices have the same gradient: the weights c are left out"),
        (" + inverse[:, 2]", "", "the 1 of a = (x, y, 1) is left out"),
        ("return c,", "return c * values,",
         "by_values is multiplied by the values; it is the weights alone"),
        ("inverse[:, :2].T", "inverse[:2]", TRANSPOSED),
    ],
    "7.7": [
        ("-residuals", "residuals", "the sign is wrong: the step goes uphill"),
        (STEP, "-jacobian.T @ residuals", "it is a step along the gradient"),
        (STEP, LEAST, "only as many residuals as unknowns are looked at"),
        (STEP, "np.linalg.solve(jacobian.T @ jacobian + 0.001 * np.eye(jacobian.shape[1]), "
         "-jacobian.T @ residuals)",
         "something is added to the diagonal of J^T J: that damps the step"),
        (STEP, f"{STEP} / 2",
         "the step is half as long: a factor 2 is in J^T J and in J^T f alike, and cancels"),
    ],
    "7.8": [
        ("c / c.sum()", "c", "c is not divided by its sum"),
        ("c / c.sum()", "c / np.abs(c).sum()", "the sum is that of |c|"),
        ("solve(m, a)", "solve(m.T, a)", TRANSPOSED),
        ("c / c.sum()", "c * m[2] / (c * m[2]).sum()",
         "c is multiplied by w: these are the weights in the picture"),
        ("c / c.sum()", "c / np.linalg.norm(c)", "c is made of length 1; its sum must be 1"),
    ],
    "7.9": [
        ("(grad_b - grad_b @ c / c.sum()) / c.sum()", "grad_b / c.sum()", QUOTIENT),
        ("grad_b - grad_b @ c", "grad_b + grad_b @ c", "the share of the sum s has the wrong sign"),
        ("inverse.T", "inverse", "the inverse is not transposed for the gradient by a"),
        (f"-{OUTER}", OUTER, SIGN),
        (OUTER, "np.outer(c, grad_a)", "grad_m is transposed"),
        (OUTER, "np.outer(grad_a, c / c.sum())", "b is taken for c in grad_m = -grad_a c^T"),
        ("grad_b @ c / c.sum()", "grad_b @ c",
         "c is taken for b in the share of the sum s: it is grad_b . b"),
    ],
    "7.10": [
        (CROSS, "cross(corners[:, j], corners[:, i])",
         "the two corners are swapped: every edge runs the other way"),
        (CROSS, "cross(corners[i], corners[j])",
         "the result is transposed: corners are columns of M, edges are rows"),
        (CROSS, "np.abs(cross(corners[:, i], corners[:, j]))", "the signs are lost"),
        ("in EDGES", "in EDGES[1:] + EDGES[:1]",
         "row k is the edge that starts at vertex k; it is the one opposite to it"),
        (f"np.stack([{CROSS} for i, j in EDGES])",
         "np.moveaxis(np.linalg.inv(np.moveaxis(corners, (0, 1), (-2, -1))), (-2, -1), (0, 1))",
         "it is the inverse itself, without the determinant"),
    ],
    "7.11": [
        (f"        grad_corners{TO_J}\n", "",
         "a corner has the gradient of one of its two edges alone"),
        ("+=", "=", "the second edge's gradient replaces the first one's; they add up"),
        (BOTH, "[:, i] += cross(g, corners[:, j])\n        grad_corners"
         "[:, j] += cross(corners[:, i], g)", "all signs are flipped: p x q = -q x p"),
        (TO_J, "[:, j] += cross(corners[:, i], g)", "the second corner's sign is wrong: "
         "g . (p x q) = q . (g x p)"),
        (BOTH, "[:, j] += cross(corners[:, j], g)\n        grad_corners"
         "[:, i] += cross(g, corners[:, i])",
         "a corner gets what belongs to the other end of the edge"),
        ("zip(grad_edges", "zip(np.swapaxes(grad_edges, 0, 1)",
         "columns of grad_edges are taken for edges; they are its rows"),
    ],
    "7.12": [
        (EPSILON, "epsilon", SAME_SIGN),
        (f"(s + {EPSILON})", "s", NO_EPSILON),
        (f"(s + {EPSILON})", "(np.abs(s) + epsilon)", "the sign of s is lost"),
        (EPSILON, "epsilon * np.sign(s)", "epsilon is 0 where s is 0; it stays positive there"),
        ("e.sum(0)", "e.sum(1, keepdims=True)",
         "the sum is over the samples instead of the corners"),
    ],
    "7.13": [
        (S_CHANGES, "grad_b / s", QUOTIENT),
        ("(grad_b - (grad_b", "(grad_b + (grad_b", "the share of the sum s has the wrong sign"),
        (EPSILON, "epsilon", SAME_SIGN),
        (f"    s = s + {EPSILON}\n", "", NO_EPSILON),
        (".sum(0) / s) / s", ".sum(0)) / s", "e is taken for b in the share of the sum s"),
        ("(grad_b * e).sum(0)", "(grad_b * e).mean(0)",
         "the share of the sum s is a mean over the corners; they add up"),
    ],
    "7.14": [
        (QUOTIENT_RULE, "e_x / s", QUOTIENT),
        ("(e_x - e", "(e_x + e", "the share of the sum s has the wrong sign"),
        (EPSILON, "epsilon", SAME_SIGN),
        (f"    s = s + {EPSILON}\n", "", NO_EPSILON),
        ("e / s *", "e *", "e is taken for b in the share of the sum s"),
        (QUOTIENT_RULE, "e_x / e_x.sum(0)", "it is the quotient of the derivatives"),
    ],
    "7.15": [
        (BY_S, "e_x.sum(0) * grad_e_x", "the way through s alone is left out"),
        (BY_S, "through_s", "the way through b is left out"),
        ("return -(", "return (", "grad_e has the wrong sign"),
        (BY_S, "e_x.sum(0) * grad_e_x - through_s", "the way through s has the wrong sign"),
        (f"(s + {EPSILON})", "(s + epsilon)", SAME_SIGN),
        ("normalize_backward(grad_b_x, e, epsilon)", f"grad_b_x / (s + {EPSILON})",
         "in grad_e_x the sum s_x is taken for a constant"),
    ],
    "7.16": [
        (f"return np.array([[{X_Y_1}] for u_k in u])",
         "sums = np.zeros((len(u), 3, count))\n    sums[:, :, face] += u[:, None] * np.stack"
         "([x, y, np.ones(len(x))])\n    return sums",
         "of the pixels of a face only the last one counts; they add up"),
        (X_Y_1, "np.bincount(face, u_k, count), np.bincount(face, u_k * x, count), "
         "np.bincount(face, u_k * y, count)", "the order is 1, x, y; a is (x, y, 1)"),
        ("for u_k in u])", "for u_k in u]) / np.maximum(np.bincount(face, None, count), 1)",
         "it is the mean over the pixels of a face instead of the sum"),
        ("for u_k in u", "for u_k in np.ones(u.shape)", "u is left out"),
        (", count)", ")", "faces after the last one that is seen are left out"),
    ],
    "7.17": [
        (" / det", "", "the planes are not divided by the determinant"),
        ("(z[:, None] * e).sum(0)", "(z * e).sum(1)", TRANSPOSED),
        ("z[:, None] *", "(z / corners[2])[:, None] *",
         "z is divided by w first; it is that of clip space"),
        ("/ det", "/ np.abs(det)", NO_WINDING),
        ("(e[0] * corners[:, 0]).sum(0)", "e[:, 2].sum(0)",
         "the determinant is that of a face whose w are all 1"),
    ],
    "7.18": [
        (PLANES, PLANES[1:], SIGN),
        ("(e * grad_planes).sum(1)", "(e * grad_planes[:, None]).sum(0)", TRANSPOSED),
        (" / det", "", "the weights are not divided by the determinant"),
        (PLANES, "-depth_planes(z, corners) * grad_z[:, None]",
         "grad_corners is transposed: a row of it is x, y or w of the three corners"),
        (PLANES, "-z[:, None] * grad_z", "z at the corners is taken for the slope of the depth"),
        ("/ det", "/ np.abs(det)", NO_WINDING),
    ],
}
