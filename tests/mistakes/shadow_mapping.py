"""Mistakes of lab 14: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
SWAPPED = "x and y are swapped"
BOTH_WIDTH = "y goes with C_00 or the width, as x does; it has C_11 and the height"
BLUR_BACK = "return window_sums(grad_output / count, radius)"
C_33 = "C_33 is left out of w: right for a cone alone"
SHARE = """lit += is_lit(distance_map, *there, bias)
    return lit / len(offsets)"""
MEAN_DISTANCE = """lit += stored_distance(distance_map, *there[:2])
    return (distance <= lit / len(offsets) + bias) + 0.0"""
FRONT = "distance_map[a] <= distance_map[b]"

MISTAKES = {
    "14.1": [
        ("rotation.T", "rotation", "the transposed matrix is applied: the rows of rotation are "
         "the light's axes"),
        ("points - position", "points + position", "the position is added instead of taken away"),
        ("(points - position) @ rotation.T", "points @ rotation.T - position",
         "points are turned first and moved then; the position is a place in the world"),
        ("(points - position)", "(position - points)", "all is seen from the points: q has the "
         "wrong sign"),
    ],
    "14.2": [
        ("grad_q @ rotation", "grad_q @ rotation.T", "the gradient is turned as points are, "
         "instead of by the transpose"),
        ("-grad_points.sum(0)", "grad_points.sum(0)", "the position's gradient has the wrong sign"),
        ("-grad_points.sum(0)", "-grad_points.mean(0)",
         "the position's gradient is the mean over the points instead of the sum"),
        ("-grad_points.sum(0)", "-grad_q.sum(0)", "the position's gradient is not turned back into "
         "the world"),
    ],
    "14.3": [
        ("q[:, 0] / w", "q[:, 0]", "x is not divided by w"),
        ("w_of(q, clip_from_light)", "-q[:, 2]", "the distance is taken for w, in parallel light, "
         "too"),
        ("+ 1) * (height / 2)", "+ 1) * (width / 2)", BOTH_WIDTH),
        ("+ 1) * (height / 2)", ") * (height / 2)", "y is counted from the map's middle"),
        ("(clip_from_light[1, 1] * q[:, 1] / w + 1)", "(1 - clip_from_light[1, 1] * q[:, 1] / w)",
         "y points down; here row 0 is at the bottom"),
        ("(width / 2)", "width", "ndc is taken to be 1 wide; it is 2 wide"),
    ],
    "14.4": [
        ("clip_from_light[3, 2] * grad_w", "0 * grad_w", "q_z has no gradient; but w depends on "
         "it"),
        ("grad_w = -(", "grad_w = (", "the gradient by w has the wrong sign"),
        ("clip_from_light[3, 2] * grad_w", "grad_w", "C_32 is missing: w is C_32 q_z + C_33"),
        ("q[:, 1]) / w\n", "q[:, 1])\n", "the gradient by w is divided by w once; the derivative "
         "of 1 / w is -1 / w^2"),
        ("(height / 2)", "(width / 2)", BOTH_WIDTH),
        (" * (width / 2) / w", " * (width / 2)", "the gradient by q_x is not divided by w"),
        ("w_of(q, clip_from_light)", "clip_from_light[3, 2] * q[:, 2]", C_33),
    ],
    "14.5": [
        ("distance[seen] = (", "distance[seen] = -(", "q_z is returned; the distance is -q_z"),
        ("(c_33 * depth[seen] - c_23) / (c_32 * depth[seen] - c_22)",
         "(-c_23) / (c_32 * depth[seen] - c_22)", C_33),
        ("(c_33 * depth[seen] - c_23) / (c_32 * depth[seen] - c_22)",
         "-(c_22 * depth[seen] + c_23) / (c_32 * depth[seen] + c_33)",
         "the matrix is applied to the depth; it is to be solved for q_z"),
        ("(c_33 * depth[seen] - c_23)", "(depth[seen] - c_23)", "w is taken to be 1 + C_32 q_z"),
        ("(depth.shape, np.inf)", "(depth.shape, 0.0)", "the distance is 0 where the light sees "
         "nothing; it is infinite"),
    ],
    "14.6": [
        ("y[inside].astype(int), x[inside].astype(int)",
         "x[inside].astype(int) % height, y[inside].astype(int) % width",
         "rows and columns are swapped: a map is indexed [y, x]"),
        ("y[inside].astype(int), x[inside].astype(int)",
         "np.minimum(np.rint(y[inside]).astype(int), height - 1), "
         "np.minimum(np.rint(x[inside]).astype(int), width - 1)",
         "the nearest whole number is taken; the texel that holds a place is its floor"),
        ("inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)",
         "inside = np.ones(x.shape, bool)\n    x, y = np.clip(x, 0, width - 1), "
         "np.clip(y, 0, height - 1)", "the border goes on outside of the map"),
        ("inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)",
         "inside = np.ones(x.shape, bool)\n    x, y = np.floor(x) % width, np.floor(y) % height",
         "the map is repeated outside; there nothing is stored, np.inf"),
        ("(x >= 0) & (x < width) & (y >= 0) & (y < height)",
         "(x > -1) & (x < width) & (y > -1) & (y < height)",
         "decimals are cut off: places up to one texel left of the map or below it count as "
         "inside"),
        ("(x.shape, np.inf)", "(x.shape, 0.0)", "0 is stored outside; it is np.inf"),
    ],
    "14.7": [
        ("distance <= stored", "distance >= stored", "what lies behind is lit, and what lies "
         "before is dark"),
        (" + bias", " - bias", "the bias makes more shadow; it lets light through"),
        (" + bias", "", "there is no bias"),
        ("distance <= stored_distance(distance_map, x, y)",
         "distance < stored_distance(distance_map, x, y)",
         "a point right on the stored surface is dark; <= is lit"),
        ("stored_distance(distance_map, x, y) + bias", "stored_distance(distance_map, y, x) + bias",
         SWAPPED),
    ],
    "14.8": [
        ("slope_x = -w", "slope_x = w", "the slope by x has the wrong sign"),
        (" * -clip_from_light[3, 2] / w - normal[:, 2]", " * 0 - normal[:, 2]",
         "the ray is the light's axis in a cone, too; it is q / distance"),
        (" * (2 / (clip_from_light[1, 1] * height))", "",
         "the slope by y is to a unit of the world; it is to a texel"),
        ("-w * normal[:, 0]", "-normal[:, 0]", "w is left out: in a cone texels grow with the "
         "distance"),
        ("np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)",
         "np.where(along == 0, GRAZING, along)", "only 0 is replaced by GRAZING; all |n . ray| "
         "below it are"),
        ("np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)",
         "np.maximum(along, GRAZING)", "a plane seen from behind is taken for one seen edge-on"),
        ("np.where(along < 0, -GRAZING, GRAZING)", "GRAZING",
         "GRAZING lost the sign of n . ray"),
        ("(clip_from_light[1, 1] * height)", "(clip_from_light[0, 0] * width)", BOTH_WIDTH),
        ("w = w_of(q, clip_from_light)", "w = -q[:, 2]", "the distance is taken for w, in parallel "
         "light, too"),
    ],
    "14.9": [
        ("np.abs(slope_x) + np.abs(slope_y)", "slope_x + slope_y", "slopes of opposite signs "
         "cancel: |slope| is added"),
        (" / 2, most)", ", most)", "the half is missing: a point is at most half a texel off"),
        ("np.minimum(constant + factor * (np.abs(slope_x) + np.abs(slope_y)) / 2, most)",
         "constant + np.minimum(factor * (np.abs(slope_x) + np.abs(slope_y)) / 2, most)",
         "the limit is for the slopes' part alone; it is for the whole bias"),
        ("np.minimum(constant", "np.maximum(constant", "the bias is never below most; it is never "
         "above it"),
        ("(np.abs(slope_x) + np.abs(slope_y)) / 2", "np.hypot(slope_x, slope_y) / 2",
         "the slopes are added as a vector's length; |slope_x| + |slope_y| reaches the texel's "
         "corner"),
    ],
    "14.10": [
        ("np.floor(there_x) + 0.5, np.floor(there_y) + 0.5", "there_x, there_y",
         "the plane is taken at the place itself; it is at the centre of the texel there"),
        ("np.floor(there_x) + 0.5, np.floor(there_y) + 0.5",
         "np.floor(x) + 0.5 + dx, np.floor(y) + 0.5 + dy",
         "the step begins at the centre of the receiver's texel; it begins at the receiver"),
        ("np.floor(there_x) + 0.5, np.floor(there_y) + 0.5",
         "np.trunc(there_x) + 0.5, np.trunc(there_y) + 0.5",
         "decimals are cut off: left of the map and below it that is not the texel"),
        ("np.floor(there_x) + 0.5, np.floor(there_y) + 0.5",
         "np.floor(there_x), np.floor(there_y)", "the texel's corner is taken for its centre"),
        ("slope_x * (centre_x - x)", "slope_x * (x - centre_x)",
         "the slope by x has the wrong sign"),
        ("return there_x, there_y,", "return centre_x, centre_y,",
         "the texel's centre is returned; the place is asked for"),
    ],
    "14.11": [
        (" / len(offsets)", "", "the lit places are counted, but not divided by their number"),
        ("lit += is_lit(distance_map, *there, bias)", "lit += ~is_lit(distance_map, *there, bias)",
         "it is the dark share"),
        ("radius * dx, radius * dy", "dx, dy", "the radius is left out"),
        ("radius * dx, radius * dy", "radius * dy, radius * dx", SWAPPED),
        ("is_lit(distance_map, *there, bias)", "is_lit(distance_map, *there[:2], distance, bias)",
         "every place is compared with the distance of the receiver, not of its plane there"),
        ("*there, bias)", "*there, 0.0)", "the bias is left out"),
        (SHARE, MEAN_DISTANCE, "distances are averaged and then compared"),
    ],
    "14.12": [
        ("blocks = ~is_lit", "blocks = is_lit", "lit places are taken for blockers"),
        ("total / np.maximum(count, 1)", "total / len(offsets)", "the sum is divided by the number "
         "of all places; only blockers count"),
        ("np.maximum(count, 1), np.inf)", "np.maximum(count, 1), 0.0)",
         "without a blocker it is 0 instead of infinite"),
        ("np.where(count > 0, total / np.maximum(count, 1), np.inf)", "total",
         "the blockers' distances are added, not averaged"),
        ("plane, bias)", "distance, bias)",
         "every place is compared with the distance of the receiver, not of its plane there"),
        ("stored_distance(distance_map, there_x[blocks], there_y[blocks])", "plane[blocks]",
         "the receiver's plane is averaged instead of what the map stores"),
        ("radius * dx, radius * dy", "dx, dy", "the radius is left out"),
    ],
    "14.13": [
        ("1 / blocker - 1 / distance", "1 / distance - 1 / blocker",
         "blocker and distance are swapped"),
        ("np.maximum(spread, 0)", "spread", "a blocker behind the point gives a negative radius"),
        ("width / 2)", "width)", "it is the diameter, or ndc is taken to be 1 wide"),
        ("light_radius * (1 / blocker - 1 / distance)",
         "light_radius * (distance / np.minimum(blocker, 1e9) - 1)",
         "it is the border's width in the world, on the receiver; not on the map"),
        ("np.maximum(spread, 0)", "np.abs(spread)", "a blocker behind the point has a border"),
        ("(clip_from_light[0, 0] * width / 2)", "(width / 2)", "C_00 is left out"),
    ],
    "14.14": [
        ("+ radius + 1, n)", "+ radius, n)", "the last row and column of each square are missing"),
        ("np.maximum(np.arange(n) - radius, 0)", "np.maximum(np.arange(n) - radius - 1, 0)",
         "squares begin a pixel too early"),
        ("for axis in 0, 1", "for axis in (1,)", "only along rows is anything added up"),
        ("np.maximum(np.arange(n) - radius, 0)", "(np.arange(n) - radius) % n",
         "squares go on at the opposite side of the picture; they end at its border"),
        ("    return picture\n", "    return picture / (2 * radius + 1)**2\n",
         "it is a mean; sums are asked for"),
    ],
    "14.15": [
        ("window_sums(np.ones((*picture.shape[:2], 1)), radius)", "(2 * radius + 1)**2",
         "at the border, too, it is divided by the pixels of a whole square: it darkens"),
        (" / window_sums(np.ones((*picture.shape[:2], 1)), radius)", "",
         "the sums are not divided by the number of pixels"),
        ("window_sums(np.ones((*picture.shape[:2], 1)), radius)", "(2 * radius + 1)",
         "it is divided by the pixels of a row instead of those of the square"),
        ("window_sums(np.ones((*picture.shape[:2], 1)), radius)",
         "(picture.shape[0] * picture.shape[1])",
         "it is divided by the pixels of the whole picture"),
    ],
    "14.16": [
        (BLUR_BACK, "return box_blur(grad_output, radius)",
         "the gradient is blurred: divided by the number of the pixel's own square, not of the "
         "squares that hold it"),
        (BLUR_BACK, "return window_sums(grad_output, radius)",
         "it is not divided by the number of pixels"),
        (BLUR_BACK, "return window_sums(grad_output, radius) / (2 * radius + 1)**2",
         "at the border, too, it is divided by the pixels of a whole square"),
        (BLUR_BACK, "return grad_output / count", "a pixel gets the gradient of its own square "
         "alone; it is in those of its neighbours, too"),
    ],
    "14.17": [
        ("mean_square - mean**2", "mean_square - mean",
         "the mean is not squared in the variance"),
        ("np.maximum(mean_square - mean**2, least_variance)",
         "mean_square - mean**2 + least_variance",
         "least_variance is added; it is the least that the variance may be"),
        ("np.maximum(mean_square - mean**2, least_variance)", "(mean_square - mean**2)",
         "least_variance is not used"),
        ("np.maximum(distance - mean, 0)", "(distance - mean)",
         "what lies before the mean is dark, too; there it is 1"),
        ("beyond**2)", "beyond)", "the distance beyond the mean is not squared"),
        ("variance / (variance", "1 - variance / (variance", "it is the dark share"),
    ],
    "14.18": [
        ("-grad_beyond - 2 * mean * grad_mean_square", "-grad_beyond",
         "the mean's part in the variance is forgotten"),
        (" * (mean_square - mean**2 > least_variance)", "",
         "the variance has a gradient at its floor, too"),
        ("mean**2 > least_variance", "mean**2 >= least_variance",
         "a variance that just reaches least_variance has a gradient; it must be greater"),
        ("grad_lit * -2 *", "grad_lit * 2 *", "the gradient by the distance has the wrong sign"),
        ("-grad_beyond - 2 * mean", "grad_beyond - 2 * mean",
         "the mean's gradient has the sign of the distance's; beyond is distance - mean"),
        ("np.maximum(distance - mean, 0)", "(distance - mean)",
         "what lies before the mean has a gradient"),
        ("beyond / total**2", "beyond / total", "it is divided by v + b^2 once instead of twice"),
        ("grad_lit * (beyond / total)**2", "(beyond / total)**2", "grad_lit is left out"),
    ],
    "14.19": [
        ("-from_middle[axis] * clip", "from_middle[axis] * clip",
         "what comes nearer moves inwards: the derivative by q_z has the wrong sign"),
        (" + 0.5 - width / 2", " + 0.5", "x is counted from the map's left border; the light looks "
         "at the middle"),
        ("np.arange(width) + 0.5", "np.arange(width)", "a texel's left border is taken for its "
         "centre"),
        ("clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map",
         "clip_from_light[3, 3] + clip_from_light[3, 2] * distance_map",
         "q_z is taken to be the distance; it is minus that"),
        ("clip_from_light[1, 1] * (height / 2)", "clip_from_light[0, 0] * (width / 2)", BOTH_WIDTH),
        ("motion[..., axis, 2] = -from_middle[axis] * clip_from_light[3, 2] / w", "pass",
         "a move along the light's axis moves nothing on the map"),
        ("clip_from_light[3, 3] - clip", "-clip", C_33),
        ("* (width / 2) / w", "* (width / 2)", "the derivative by q_x is not divided by w"),
    ],
    "14.20": [
        (FRONT, FRONT.replace("<=", ">"), "the border moves with the farther texel; it moves with "
         "the one in front"),
        ("distance_map - move[2]", "distance_map + move[2]", "the distance grows by move_z; it is "
         "-q_z"),
        ("shift[..., None] / 2", "shift[..., None]", "each of the two texels loses the whole step; "
         "it loses half of it"),
        ("        moved[b] -= change\n", "", "only the first of two texels changes"),
        ("        moved[b] -= change\n", "        moved[b] += change\n",
         "what the first loses the second wins; both lose it"),
        ("(moments[b] - moments[a])", "(moments[a] - moments[b])", "the border moves the wrong "
         "way: the sign of the step is wrong"),
        ("(moments[b] - moments[a])", "(moved[b] - moved[a])",
         "the step is taken of what has changed already; it is of the moments before"),
        (f"np.where({FRONT}, speed[a], speed[b])", "(speed[a] + speed[b]) / 2",
         "the border moves with the mean of both texels; it moves with the one in front"),
        ("motion[..., axis, :] @ move", "motion[..., 1 - axis, :] @ move", SWAPPED),
        ("(distance_map - move[2])**2]", "distance_map**2 - move[2]]",
         "move_z is taken away from the square; it is the square of the new distance"),
    ],
    "14.21": [
        ("-(grad_moments[a] + grad_moments[b])", "grad_moments[a] + grad_moments[b]",
         "the gradient of the shift has the wrong sign"),
        ("-(grad_moments[a] + grad_moments[b])", "-grad_moments[a]",
         "only one side of a step counts; both texels change"),
        (".sum(-1) / 2", ".sum(-1)", "the half of the change is missing"),
        (" + 2 * (distance_map - move[2]) * grad_moments[..., 1]", " + grad_moments[..., 1]",
         "the square's derivative, 2 d, is missing"),
        ("-grad_distance.sum()", "grad_distance.sum()", "the gradient by move_z has the wrong "
         "sign"),
        (FRONT, FRONT.replace("<=", ">"), "the farther texel's motion is taken; it is that of the "
         "one in front"),
        ("0.0, 0.0, -grad_distance.sum()", "0.0, 0.0, 0.0",
         "the distances' change by move_z is forgotten"),
        ("(distance_map - move[2]) * grad", "distance_map * grad",
         "the square is taken of the old distance; it is of d - move_z"),
    ],
}
