"""Mistakes of lab 9: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
NO_GRAD_LOSS = "grad_loss is left out"
ONE_END = "each edge counts for its first end alone; both ends are neighbours"
NAMED_TWICE = "of a vertex's neighbours only the last one counts: += with an index adds once"
ALONE = "a vertex of no edge is not made 0"
CORRECTED = "mean / (1 - beta_1**step), square / (1 - beta_2**step)"
ELEMENTS = ("pw, px, py, pz = np.moveaxis(p, -1, 0)\n"
            "    qw, qx, qy, qz = np.moveaxis(q, -1, 0)\n")
PARTS = ["pw * qw - px * qx - py * qy - pz * qz", "pw * qx + px * qw + py * qz - pz * qy",
         "pw * qy + py * qw + pz * qx - px * qz", "pw * qz + pz * qw + px * qy - py * qx"]
STACK = ",\n                     ".join(PARTS)
ROTATED = """matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 2 / (q @ q) * (q[0] * K + K @ K)"""
LENGTH = " - s**2 * (G * (w * K + K @ K)).sum() * q"
ARC = "4 * np.arctan2(diagonals[0], diagonals[1])"
RATIO = "(coverage * target).sum() / (coverage + target - coverage * target).sum()"
SLOPE = "(both / either * (1 - target) - target)"
BOTH_WAYS = "np.concatenate([edges, edges[:, ::-1]])"
TOTAL = "np.stack([np.bincount(vertex, x[neighbour], count) for x in positions.T], -1)"
SHARES = "np.stack([np.bincount(neighbour, g[vertex], count) for g in share.T], -1)"
DISTANCE = "np.where(valence > 0, positions - total / np.maximum(valence, 1), 0)"

MISTAKES = {
    "9.1": [
        ("mean", "sum", "the squares are summed; it is their mean"),
        ("((picture - target)**2)", "np.abs(picture - target)", "differences are not squared"),
        (".mean()", ".mean() / 2", "the mean is halved; here it is not"),
        ("((picture - target)**2).mean()", "np.sqrt(((picture - target)**2).mean())",
         "a root is drawn of the mean"),
        (".mean()", ".sum(-1).mean()", "the channels are summed; they have a mean as pixels do"),
    ],
    "9.2": [
        ("* 2 ", "", "the 2 of the square's derivative is missing"),
        (" / picture.size", "", "it is not divided by the number of all pixels and channels"),
        ("(picture - target)", "(target - picture)",
         "the sign is wrong: it is positive where the picture is too bright"),
        ("grad_loss * ", "", NO_GRAD_LOSS),
        ("picture.size", "len(picture)", "it is divided by the number of rows, not of all numbers"),
    ],
    "9.3": [
        ("x - rate", "x + rate", "the step goes uphill"),
        (CORRECTED, "mean, square", "mean and square are not corrected for their start at 0"),
        ("epsilon), mean, square", "epsilon), corrected_mean, corrected_square",
         "the corrected m^ and s^ are returned; the next step needs m' and s'"),
        ("**step", "**(step + 1)", "the correction is that of the next step: n starts at 1"),
        ("beta_1 * mean + (1 - beta_1) * grad_x", "(1 - beta_1) * mean + beta_1 * grad_x",
         "in the mean the old and the new have each other's share"),
        ("np.sqrt(corrected_square) + epsilon", "np.sqrt(corrected_square + epsilon)",
         "epsilon is under the root; it is added to the root"),
        ("np.sqrt(corrected_square)", "corrected_square", "no root is drawn of the square"),
        ("grad_x**2", "np.abs(grad_x)", "the gradient is not squared in the second mean"),
    ],
    "9.4": [
        (ELEMENTS, ELEMENTS.replace("(p", "(o").replace("(q", "(p").replace("(o", "(q"),
         "p and q are swapped: the order of a product matters"),
        (ELEMENTS, ELEMENTS.replace("pw, px, py, pz", "px, py, pz, pw").replace(
            "qw, qx, qy, qz", "qx, qy, qz, qw"), "the scalar is taken for the last element; w is "
         "the first"),
        (STACK, "pw * qw, px * qx, py * qy, pz * qz", "elements are multiplied one by one"),
        (STACK, f"{PARTS[0]}, pw * qx + px * qw, pw * qy + py * qw, pw * qz + pz * qw",
         "i j = k and its like are left out: the cross product of the two axes"),
        (PARTS[0], "pw * qw", "i i = -1 and its like are left out of the scalar"),
        (PARTS[0], PARTS[0].replace("-", "+"), "i i is taken for 1; it is -1"),
    ],
    "9.5": [
        ("q[0] * K", "-q[0] * K", "it rotates the other way"),
        ("2 / (q @ q)", "2", "q is taken to have length 1"),
        ("2 / (q @ q)", "1 / (q @ q)", "a factor 2 is missing in what is added to the identity"),
        (ROTATED, ROTATED.replace("q[1:]", "q[:3]").replace("q[0]", "q[3]"),
         "the scalar is taken for the last element; w is the first"),
        (" + K @ K", "", "only the first order is there: K K, which is of the second, is missing"),
        ("+= 2 / (q @ q) * (", "= (q @ q) * np.eye(3) + 2 * (",
         "it is not divided by |q|^2: the rotation also scales"),
    ],
    "9.6": [
        (LENGTH, "", "the length's share is left out: |q|^2 is taken for a constant"),
        (LENGTH, LENGTH.replace("s**2", "s"), "the length's share is that of s; it has s^2"),
        ("s * (G * K).sum()", "0.0", "w has no gradient of its own"),
        ("grad_matrix[:3, :3]", "grad_matrix[:3, :3].T", "grad_matrix is transposed"),
        ("grad_xyz)", "np.negative(grad_xyz))", "the gradient by x, y, z has the wrong sign"),
        ("G @ K.T + K.T @ G", "2 * G @ K", "K K is derived like the square of a number"),
        ("2 / (q @ q)", "2.0", "q is taken to have length 1"),
    ],
    "9.7": [
        (ARC, "2 * np.arccos(np.minimum(np.abs((p * q).sum(-1)), 1))",
         "an arccos loses the digits of small angles"),
        ("4 *", "2 *", "it is half of the angle"),
        ("np.sort(", "np.stack(", "q and -q are taken for two rotations: angles go beyond pi"),
        (ARC, "2 * np.arcsin(np.minimum(np.linalg.norm(quaternion_product("
         "p * [1, -1, -1, -1], q)[..., 1:], axis=-1), 1))",
         "an arcsin loses the digits of angles near pi"),
        (ARC, f"np.degrees({ARC})", "the angle is in degrees; angles are radians"),
        (ARC, "2 * diagonals[0]", "the chord is taken for the arc"),
    ],
    "9.8": [
        ("1 - (coverage * target)", "(coverage * target)",
         "it is the overlap itself; the loss is 1 less that"),
        ("target - coverage * target)", "target)", "the union counts the overlap twice"),
        (RATIO, "np.minimum(coverage, target).sum() / np.maximum(coverage, target).sum()",
         "minimum and maximum take the place of c t and of c + t - c t"),
        (RATIO, RATIO.replace("sum()", "sum((-2, -1))").join(["(", ").mean()"]),
         "it is the mean of the losses of several pictures; all pixels are summed first"),
        (RATIO, "2 * (coverage * target).sum() / (coverage + target).sum()",
         "it is the Dice loss: twice the overlap by the sum of both"),
        (RATIO, RATIO.replace("coverage", "np.round(coverage)"),
         "coverage is rounded; pixels covered in part count in part"),
    ],
    "9.9": [
        (SLOPE, "-target", "the union is taken for a constant"),
        (SLOPE, f"-{SLOPE}", "the sign is wrong: to cover the target makes the loss less"),
        ("both / either *", "both *", "A dU is divided by U once; it is by U^2"),
        ("(1 - target) -", "1 -", "dU is taken for dc; where the target is, the union stays"),
        (f"grad_loss * {SLOPE}", SLOPE, NO_GRAD_LOSS),
        (f"{SLOPE} / either", "-1 * (target > 0)", "each pixel of the target pulls by 1"),
    ],
    "9.10": [
        ("positions - total / np.maximum(valence, 1)", "total / np.maximum(valence, 1) - positions",
         "the sign is wrong: d points from the neighbours' mean to the vertex"),
        ("total / np.maximum(valence, 1)", "total", "the neighbours are summed; it is their mean"),
        (BOTH_WAYS, "edges", ONE_END),
        (f"total = {TOTAL}",
         "total = np.zeros(positions.shape)\n    total[vertex] = positions[neighbour]",
         NAMED_TWICE),
        ("np.maximum(valence, 1)", "valence.max()",
         "all are divided by the largest number of neighbours, not each by its own"),
        (DISTANCE, "positions - total / np.maximum(valence, 1)", ALONE),
        ("positions - total / np.maximum(valence, 1)", "valence * positions - total",
         "it is not divided by the number of neighbours"),
    ],
    "9.11": [
        ("np.where(valence > 0, grad_laplacian, 0) - total", "laplacian(grad_laplacian, edges)",
         "it is the forward once more; the matrix must be transposed"),
        (" / np.maximum(valence, 1)", "",
         "a neighbour gets the whole gradient, not its share of it"),
        (" - total", "", "the neighbours get nothing"),
        ("- total", "+ total", "the neighbours' share has the wrong sign"),
        ("np.where(valence > 0, grad_laplacian, 0)", "grad_laplacian", ALONE),
        (f"total = {SHARES}",
         "total = np.zeros(positions.shape)\n    total[neighbour] = share[vertex]", NAMED_TWICE),
        (BOTH_WAYS, "edges", ONE_END),
    ],
}
