"""Mistakes of lab 1: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
MISTAKES = {
    "1.1": [
        ("[points, np.ones_like(points[..., :1])]", "[np.ones_like(points[..., :1]), points]",
         "the 1 stands in front of the coordinates instead of behind them"),
        ("ones_like", "zeros_like", "a 0 is appended: that is a direction; a point has a 1"),
        ("points[..., :1]", "points", "three ones are appended instead of one"),
    ],
    "1.2": [
        ("matrix.T", "matrix", "the transposed matrix is applied: points are rows here, "
         "but the matrix acts on columns"),
        ("matrix.T", "np.linalg.inv(matrix).T", "the inverse of the matrix is applied"),
        ("points @ matrix.T", "(points @ matrix.T) / (points @ matrix.T)[..., 3:]",
         "the result is divided by w already; the divide is a later step"),
    ],
    "1.3": [
        ("grad_output @ matrix", "grad_output @ matrix.T",
         "the gradient goes through the matrix as points do, instead of through its transpose"),
        ("grad_output.reshape(-1, 4).T @ points.reshape(-1, 4)",
         "points.reshape(-1, 4).T @ grad_output.reshape(-1, 4)",
         "the matrix's gradient is transposed: row i belongs to output i"),
        ("points.reshape(-1, 4)\n", "points.reshape(-1, 4) / max(1, points.size // 4)\n",
         "the matrix's gradient is the mean over the points instead of the sum"),
        ("return grad_points, grad_matrix", "return grad_matrix, grad_points",
         "the two gradients are returned in the wrong order"),
    ],
    "1.4": [
        ("matrix[:3, 3]", "matrix[3, :3]",
         "the offset stands in the last row; for column vectors it is the last column"),
        ("= offset", "= -np.asarray(offset)", "points are moved the opposite way"),
        ("np.eye(4)", "np.zeros((4, 4))", "the ones on the diagonal are missing"),
    ],
    "1.5": [
        ("[*factors, 1.0]", "[*factors, factors[0]]", "w is scaled as well"),
        ("np.diag([*factors, 1.0])", "np.diag([*(1 / np.asarray(factors)), 1.0])",
         "points are divided by the factors"),
        ("[*factors, 1.0]", "[factors[0]] * 3 + [1.0]", "one factor serves all three axes"),
        ("[*factors, 1.0]", "[*factors, 0.0]", "w becomes 0: a corner of the matrix must be 1"),
    ],
    "1.6": [
        ("+ np.sin", "- np.sin", "the turn is clockwise: the sign of the sine is wrong"),
        ("np.cos(angle)", "np.cos(np.radians(angle))", "the angle is in degrees in the cosine; "
         "angles are radians"),
        ("(angle)", "(np.radians(angle))", "the angle is taken for degrees; it is in radians"),
        ("axis / np.linalg.norm(axis)", "axis", "the axis is not brought to length 1"),
        ("(1 - np.cos(angle))", "np.cos(angle)",
         "the part along the axis is multiplied by cos instead of by 1 - cos"),
        ("np.outer(n, n)", "0", "the part along the axis, (1 - cos) n n^T, is missing"),
    ],
    "1.7": [
        ("back = eye - target", "back = target - eye",
         "the camera looks down +z: the third axis is from the target to the eye"),
        ("np.cross(up, back)", "np.cross(back, up)", "left and right are mirrored: "
         "a cross product has its arguments in the wrong order"),
        ("translate(-eye)", "translate(eye)", "the world is moved by +eye instead of by -eye"),
        ("rotation @ translate(-eye)", "translate(-eye) @ rotation",
         "the world is turned first and moved then; it is the other way round"),
        ("np.cross(back, right)", "up", "up was taken as it is, and not made perpendicular"),
        ("rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)",
         "rotation[:3, :3] = (axes / np.linalg.norm(axes, axis=1, keepdims=True)).T",
         "the camera's axes are the columns; that is the camera's pose, and view is its inverse"),
        ("axes / np.linalg.norm(axes, axis=1, keepdims=True)", "axes",
         "the axes are not brought to length 1"),
    ],
    "1.8": [
        ("np.linalg.inv(matrix[:3, :3]).T", "matrix[:3, :3]",
         "normals are moved as points are; under an uneven scaling they tilt"),
        (".T", "", "the inverse is not transposed"),
        ("np.linalg.inv(matrix[:3, :3]).T", "matrix[:3, :3].T", "only the transpose is taken"),
        ("np.linalg.inv(matrix[:3, :3])", "np.linalg.inv(matrix)[:3, :3]",
         "the whole matrix is inverted, its last row too, instead of its upper left 3 x 3"),
    ],
    "1.9": [
        ("[0, 0, 1, 0.0]", "[0, 0, 0, 1.0]", "w is 1: nothing is divided by z"),
        ("[0, 0, 1, 0.0]", "[0, 0, -1, 0.0]", "w is -z; this camera looks down +z"),
        ("[0, 0, f, 0]", "[0, 0, 1, 0]", "z is not multiplied by f"),
        ("[f, 0, 0, 0]", "[1, 0, 0, 0]", "x is not multiplied by f"),
    ],
    "1.10": [
        ("fov_y / 2", "fov_y", "the whole angle is taken for half of it"),
        ("fov_y / 2", "np.radians(fov_y) / 2", "the angle is taken for degrees"),
        ("r = aspect * t", "r = t / aspect",
         "the width is divided by the aspect; it is width / height"),
        ("np.tan(fov_y / 2)", "np.tan(fov_y / 2) / 2",
         "the lecture's field of view is taken, which holds for half the height"),
        ("return -r, r, -t, t", "return -t, t, -r, r", "left and right are swapped with "
         "bottom and top"),
        ("near * np.tan", "np.tan", "the distance of the near plane is left out"),
    ],
    "1.11": [
        ("alpha = (far + near)", "alpha = -(far + near)", "alpha has the wrong sign"),
        ("beta = 2", "beta = -2", "beta has the wrong sign"),
        ("beta = 2 * far", "beta = far", "beta lacks its factor 2"),
        ("2 * near / (r - l)", "near / (r - l)", "the factor 2 in 2 near / (r - l) is missing"),
        ("(r + l) / (r - l)", "-(r + l) / (r - l)",
         "a view that is not centred moves the wrong way"),
        ("-1,                0]", "1,                 0]", "w is z; the camera looks down -z"),
        ("alpha,             beta]", "beta,              alpha]", "alpha and beta are swapped"),
    ],
    "1.12": [
        ("-(r + l)", "(r + l)", "the box is moved sideways the wrong way"),
        ("2 / (near - far)", "2 / (far - near)", "z runs the wrong way: near must become -1"),
        ("[0,           0,           0,                1]", "[0, 0, -1, 0]",
         "w is -z: things shrink with distance, as in perspective"),
        ("2 / (t - b)", "1 / (t - b)", "y is scaled by 1 / (t - b): ndc is 2 high"),
    ],
    "1.13": [
        ("/ clip[..., 3:]", "/ clip[..., 2:3]", "the division is by z; it is by w"),
        ("/ clip[..., 3:]", "/ np.abs(clip[..., 3:])", "the sign of w is lost"),
        ("/ clip[..., 3:]", "", "nothing is divided"),
        ("clip[..., :3] / clip[..., 3:]",
         "np.concatenate([clip[..., :2] / clip[..., 3:], clip[..., 2:3]], -1)", "z is not divided"),
    ],
    "1.14": [
        ("grad_w = -(", "grad_w = (", "the gradient by w has the wrong sign"),
        ("* clip[..., :3] / w)", "* clip[..., :3])", "the gradient by w is divided by w once; "
         "the derivative of 1/w is -1/w^2"),
        ("-(grad_xyz * clip[..., :3] / w).sum(-1, keepdims=True)", "0 * w",
         "w gets no gradient: but the divide depends on it"),
        ("grad_ndc / w", "grad_ndc", "the gradient by x, y, z is not divided by w"),
        (".sum(-1, keepdims=True)", ".mean(-1, keepdims=True)",
         "the gradient by w is the mean over x, y, z instead of the sum"),
    ],
    "1.15": [
        ("[0,         height / 2, 0, height / 2]", "[0, -height / 2, 0, height / 2]",
         "y points down; here row 0 is at the bottom"),
        ("0, width / 2]", "0, width / 2 - 0.5]", "everything is half a pixel off: the left border "
         "of the picture is x = 0, not -1/2"),
        ("[width / 2, 0,          0, width / 2]", "[width, 0, 0, width]",
         "ndc is taken as from 0 to 1; it is from -1 to 1"),
        ("width / 2, 0,          0, width / 2],\n                     [0,         height / 2, 0, "
         "height / 2]", "height / 2, 0, 0, height / 2],\n                     [0, width / 2, 0, "
         "width / 2]", "width and height are swapped"),
        ("[0,         0,          1, 0]", "[0, 0, 0.5, 0.5]",
         "depth is brought to 0 ... 1; here it stays as it is"),
    ],
    "1.16": [
        ("viewport(width, height)", "viewport(height, width)", "width and height are swapped"),
        ("viewport(width, height)", "(viewport(width, height) * [[1], [-1], [1], [1]])",
         "y is negative: it points down"),
        ("viewport(width, height)", "(viewport(width, height) * [[1, 1, 1, 0]] * 1.0)",
         "the middle of the picture stays at 0: the viewport's offset is missing"),
        ("[..., :3]", "", "all four coordinates are returned; w = 1 is no longer wanted"),
    ],
    "1.17": [
        ("grad_screen @ viewport(width, height)[:3, :3]",
         "grad_screen / np.diag(viewport(width, height))[:3]",
         "the gradient is divided by the scale; it must be multiplied"),
        ("viewport(width, height)", "viewport(height, width)", "width and height are swapped"),
        ("viewport(width, height)[:3, :3]", "viewport(width, height)[:3, :3] "
         "+ viewport(width, height)[:3, 3]", "the viewport's offset leaks into the gradient"),
        ("viewport(width, height)[:3, :3]", "(2 * viewport(width, height)[:3, :3])",
         "the scale is the whole width; ndc is 2 wide, so it is half of that"),
    ],
}
