"""Mistakes of lab 10: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
TURN = "side[:, 0] * other[:, 1] - other[:, 0] * side[:, 1] > 0"
INVERSE = "return (np.stack(rows, -2) + 0.0) / double_area[..., None, None]"
PARTS = "part[..., 0] + part[..., 1] + part[..., 2]"
ADDED_UP = """grad_textures = [np.bincount(cell.ravel(), (tap * grad[:, None]).ravel(), len(texels))
                     for grad in grad_colour.T]
"""
OVERWRITTEN = """grad_textures = np.zeros(texels.T.shape)
    for own, grad in zip(grad_textures, grad_colour.T):
        own[cell] = tap * grad[:, None]
"""
FIRST = "face * textures.shape[1]**3"
CUBES_SWAPPED = "texel [i, j, k] has index i T^2 + j T + k: i counts most, here it counts least"
CENTRES = "from centres: pixel j's centre is at j + 1/2"

MISTAKES = {
    "10.1": [
        (TURN, TURN.replace(">", "<"), "clockwise faces are drawn, and the others are not"),
        (TURN, f"np.abs({TURN[:-4]}) > 0", "faces of either winding are drawn"),
        (TURN, TURN.replace(">", ">="), "faces without area are drawn, too"),
        (" & (z > 0).all(1)", "", "faces behind the camera are drawn: z is not looked at"),
        ("(z > 0).all(1)", "(z > 0).any(1)", "one corner in front of the camera is enough; all "
         "three are asked for"),
        ("(z > 0)", "(z >= 0)", "a corner with z = 0 counts as in front of the camera"),
    ],
    "10.2": [
        (" / double_area[..., None, None]", "", "nothing is divided by twice the area"),
        ("/ double_area", "/ (double_area / 2)", "it is divided by the area; the determinant is "
         "twice that"),
        ("/ double_area", "/ np.abs(double_area)", "the determinant lost its sign: a clockwise "
         "face has the negative inverse"),
        ("np.stack(rows, -2)", "np.stack(rows, -1)", "the inverse is transposed: row k belongs to "
         "corner k"),
        ("for i, j in EDGES", "for i, j in EDGES[1:] + EDGES[:1]",
         "row k is the edge that starts at corner k; it is the one opposite to it"),
        ("y[..., i] - y[..., j], x[..., j] - x[..., i]",
         "x[..., j] - x[..., i], y[..., i] - y[..., j]", "x and y are swapped"),
    ],
    "10.3": [
        ("np.clip(c, 0, 1)", "c", "nothing is clamped"),
        ("np.clip(c, 0, 1)", "np.maximum(c, 0)", "weights are clamped at 0 alone; at 1, too"),
        ("clamped / (clamped[..., :1] + clamped[..., 1:2] + clamped[..., 2:])", "clamped",
         "the clamped weights are not divided by their sum"),
        (f"1 / ({PARTS})", "(weight * z).sum(-1)", "depth is the mean of z by the weights; what is "
         "linear on screen is 1 / z"),
        (f"1 / ({PARTS})", PARTS, "1 / depth is returned"),
        ("inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None]",
         "inverse[..., 1] * x[..., None] + inverse[..., 0] * y[..., None]", "x and y are swapped"),
    ],
    "10.4": [
        ("-grad_depth * depth**2", "-grad_depth", "depth^2 is missing: the derivative of 1 / q is "
         "-1 / q^2"),
        ("-grad_depth * depth**2", "grad_depth * depth**2", "the derivative of 1 / q has the wrong "
         "sign"),
        ("    grad_weight = grad_weight + grad_q / z\n", "", "depth's gradient does not go through "
         "the weights, only straight to z"),
        ("grad_weight - (grad_weight * weight).sum(-1, keepdims=True)", "grad_weight",
         "the sum that the weights are divided by is taken for a constant"),
        ("(grad_weight * weight).sum", "(grad_weight * weight).mean",
         "a mean is taken where all three weights must be added"),
        ("np.where((c < 0) | (c > 1), 0, grad_c)", "grad_c",
         "what the clamp changes has a gradient; it counts as constant"),
        ("(c < 0) | (c > 1)", "(c <= 0) | (c >= 1)", "a c of exactly 0 or 1 counts as clamped"),
        ("(c < 0) | (c > 1)", "c < 0", "a c above 1 counts as not clamped"),
        ("weight / z**2", "weight / z", "the gradient by z is divided by z once; the derivative "
         "of 1 / z is -1 / z^2"),
    ],
    "10.5": [
        ("face_index[i, j], weight[i, j], depth[i, j] = f, w, d",
         "face_index[-1 - i, j], weight[-1 - i, j], depth[i, j] = f, w, d",
         "rows are counted from the top; row 0 is at the bottom"),
        ("np.array(j + 0.5), np.array(i + 0.5)", "np.array(j * 1.0), np.array(i * 1.0)",
         "pixels are sampled at their lower left corners instead of at their centres"),
        (" and d < depth[i, j]", "", "there is no z-buffer: the last face wins"),
        ("and d < depth[i, j]", "and (d > depth[i, j] or face_index[i, j] < 0)",
         "the farthest face is seen"),
        ("d < depth[i, j]", "d <= depth[i, j]", "of equally deep faces the last one wins; it is "
         "the first"),
        ("np.flatnonzero(front_faces(screen, z))", "range(len(screen))",
         "back faces are drawn, too"),
        ("near < d < far", "near <= d <= far", "near and far themselves are seen; they are not"),
        ("near < d < far and ", "", "near and far do not cut"),
        ("covers(screen[f], x, y)", "(inverse @ [j + 0.5, i + 0.5, 1] > 0).all()",
         "centres on an edge count in no face; here they count in both"),
        ("face_index[i, j], weight[i, j], depth[i, j] = f, w, d",
         "face_index[i, j], weight[i, j], depth[i, j] = f, w, w @ z[f]",
         "depth is the mean of z by the weights, instead of eq. (3)"),
        ("np.full((height, width), -1)", "np.full((height, width), 0)",
         "no face is 0 instead of -1"),
    ],
    "10.6": [
        (" * depth[:, None] / z", "", "z / z_k is missing: the texture bends in perspective"),
        ("* depth[:, None] / z", "/ depth[:, None] * z", "the ratio of the depths is upside down"),
        ("(size - 1) * weight", "size * weight", "the cube is T long; from the first texel to the "
         "last it is T - 1"),
        ("np.minimum(np.floor(t), size - 2)", "np.floor(t)",
         "at t = T - 1 the cell beyond the cube is read; low is T - 2 at most"),
        ("np.floor(t)", "np.round(t)", "t is rounded to the nearest texel instead of down"),
        ("n >> k & 1", "n >> 2 - k & 1", "the bits of n are read in reverse: bit 0 is for axis 0"),
        ("for k in range(3):\n            upper = n >> k & 1",
         "for k in (2, 1, 0):\n            upper = n >> k & 1", CUBES_SWAPPED),
        ("t[:, k] - low[:, k] if upper else 1 - (t[:, k] - low[:, k])",
         "1 - (t[:, k] - low[:, k]) if upper else t[:, k] - low[:, k]",
         "the weights of the lower and the upper texel are swapped"),
    ],
    "10.7": [
        ("sign = 1 if n >> k & 1 else -1", "sign = 1", "a lower texel's weight falls where t "
         "grows: its sign is missing"),
        ("scale = (size - 1) / z", "scale = 1 / z", "the factor T - 1 is missing"),
        ("(grad_t * scale * weight).sum(1)", "(grad_t * scale * weight).mean(1)",
         "the depth's gradient is the mean over the axes; all three t depend on it"),
        ("-grad_weight * weight / z", "grad_weight * weight / z",
         "the gradient by z has the wrong sign"),
        ("-grad_weight * weight / z", "-grad_weight * weight",
         "the gradient by z is divided by z once; the derivative of 1 / z is -1 / z^2"),
        ("np.minimum(np.floor(t), size - 2)", "np.floor(t)",
         "at t = T - 1 it is the derivative in the cell beyond the cube"),
        ("n >> k & 1 else -1", "n >> 2 - k & 1 else -1",
         "the bits of n are read in reverse: bit 0 is for axis 0"),
        (" * factor[i] * factor[j]", "", "the other two axes' factors are left out"),
    ],
    "10.8": [
        (f"first = textures.reshape(-1, textures.shape[-1]), {FIRST}",
         "first = textures.reshape(-1, textures.shape[-1]), 0 * face",
         "all pixels read the cube of face 0"),
        (FIRST, "face * textures.shape[1]**2", "a cube is taken to have T^2 texels; it has T^3"),
        ("tap[:, n, None] * texels", "texels", "the taps' weights are left out"),
        ("tap[:, n, None] * texels[first + index[:, n]] for n in range(8))",
         "tap[:, n, None] * texels[first + index[:, n]] for n in range(8)) / 8",
         "it is divided by 8; the taps' weights have the sum 1 already"),
        ("sum(tap[:, n, None] * texels[first + index[:, n]] for n in range(8))",
         "texels[first + index[np.arange(len(tap)), tap.argmax(1)]]",
         "the texel of greatest weight is taken alone"),
        ("textures.reshape(-1, textures.shape[-1])",
         "textures.swapaxes(1, 3).reshape(-1, textures.shape[-1])", CUBES_SWAPPED),
    ],
    "10.9": [
        ("(tap * grad[:, None]).ravel()", "(0 * tap + grad[:, None]).ravel()",
         "the taps' weights are left out of the texels' gradient"),
        (ADDED_UP, OVERWRITTEN, "a texel that is read several times keeps its last gradient; they "
         "add up"),
        ("first[:, None] + index", "index", "every gradient goes to the cube of face 0"),
        ("(texels[cell[:, n]] * grad_colour).sum(1)", "(texels[cell[:, n]] * grad_colour).mean(1)",
         "grad_tap is the mean over the channels instead of the sum"),
        ("(texels[cell[:, n]] * grad_colour).sum(1)",
         "(tap[:, n, None] * texels[cell[:, n]] * grad_colour).sum(1)",
         "grad_tap has the tap's weight in it: the derivative is the texel alone"),
        ("return np.stack(grad_textures, -1).reshape(textures.shape), np.stack(grad_tap, 1)",
         "return np.stack(grad_tap, 1), np.stack(grad_textures, -1).reshape(textures.shape)",
         "the two gradients are returned in the wrong order"),
    ],
    "10.10": [
        ("np.cross(b - a, c - a)", "np.cross(c - a, b - a)",
         "normals point to the side that sees the corners clockwise, or l away from the light"),
        ("(area / np.where(length > 0, length, 1)) @ towards", "area @ towards",
         "the normal is not brought to length 1"),
        ("@ towards\n", "@ (towards / np.linalg.norm(towards))\n",
         "l is brought to length 1; twice as long is twice as bright"),
        ("np.maximum(cosine, 0)", "cosine", "light from behind takes brightness away: max(0, ...) "
         "is missing"),
        ("np.maximum(cosine, 0)", "np.abs(cosine)", "faces are lit from both sides"),
        ("np.where(length > 0, length, 1)", "length", "a face without area divides 0 by 0"),
        ("ambient + ", "", "the ambient light is left out"),
    ],
    "10.11": [
        ("np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)",
         "(grad_light * directional).sum(1, keepdims=True)",
         "faces that look away from the light have a gradient"),
        ("cosine > 0", "cosine >= 0", "grazing light, n . l = 0, has a gradient"),
        ("towards - cosine * normal", "towards",
         "the length of N is taken for a constant: the part along n is not taken away"),
        ("normal) / length", "normal)", "the gradient by N is not divided by its length"),
        ("np.cross(c - a, grad_area), np.cross(grad_area, b - a)",
         "np.cross(grad_area, c - a), np.cross(b - a, grad_area)",
         "the corners' gradients have the wrong sign: a cross product is turned round"),
        ("-grad_b - grad_c, grad_b", "0 * grad_b, grad_b", "the first corner has no gradient; it "
         "is in both sides"),
        ("(grad_light * np.maximum(cosine, 0)).sum(0)", "grad_light.sum(0)",
         "the cosine is left out of the directional light's gradient"),
        ("grad_light.sum(0),", "grad_light.mean(0),", "the ambient light's gradient is the mean "
         "over the faces instead of the sum"),
        ("(grad_cosine * normal).sum(0)", "(grad_cosine * area).sum(0)",
         "the light's direction gets N instead of n"),
    ],
    "10.12": [
        ("np.ceil(low - 0.5)", "np.ceil(low)", "the first row is not counted " + CENTRES),
        ("row + 0.5 - a[1]", "row - a[1]", "crossings are those of the rows' lower borders, not "
         "of their centres"),
        ("np.floor(high + 0.5)", "np.floor(high - 0.5)", "the last row is left out; both ends are "
         "included"),
        ("low, high = min(a[1], b[1]), max(a[1], b[1])", "low, high = a[1], b[1]",
         "an edge that goes down crosses nothing"),
        ("[1 - toward_b, toward_b]", "[toward_b, 1 - toward_b]", "the shares of a and b are "
         "swapped"),
        ("min(np.floor(high + 0.5), height)", "np.floor(high + 0.5)",
         "rows above the picture are among them"),
        ("max(np.ceil(low - 0.5), 0)", "np.ceil(low - 0.5)",
         "rows below the picture are among them"),
        ("a[0] + toward_b * (b[0] - a[0])", "toward_b * (b[0] - a[0])",
         "x is counted from a instead of from the picture's left border"),
        ("    if a[1] == b[1]:\n        row = row[:0]\n", "", "an edge along a row crosses it: it "
         "crosses none"),
    ],
    "10.13": [
        ("-(pull[asked]", "(pull[asked]", "the gradient has the wrong sign: descent goes away "
         "from the pixel that asks"),
        ("asked = (pull > 0)", "asked = (pull != 0)",
         "max(0, ...) is missing: a change that raises the loss counts, too"),
        ("np.where(is_out, sees[inner], sees)", "sees",
         "on the way out only pixels that see the face pull; there all do, if inner sees it"),
        ("np.where(is_out, sees[inner], sees)", "(is_out | sees)",
         "an edge that something hides moves out: inner must see the face"),
        ("np.where(is_out, sees[inner], sees)", "np.where(is_out, sees[inner], True)",
         "on the way in pixels of other faces pull, too"),
        ("2 / len(colour) * ", "", "d is in pixels; it is in ndc, where the line has length 2"),
        ("pixel[asked] + 0.5", "pixel[asked]", "d is not measured " + CENTRES),
        ("distance / s", "distance * s", "the distance is multiplied by the share instead of "
         "divided"),
        ("np.where(is_out, side, -side)[asked] * eps", "eps",
         "eps is positive on either side; it has the sign of the way"),
        ("np.where(is_out[:, None], colour[inner], colour[outer])",
         "np.where(is_out[:, None], colour[outer], colour[inner])",
         "I_beyond is of the wrong side: going out, pixels become as inner is"),
        (".sum(1)", ".mean(1)", "the pull is the mean over the channels instead of the sum"),
        ("np.floor(crossing - 0.5) if side > 0 else np.ceil(crossing - 0.5)",
         "np.floor(crossing)", "inner is the pixel that the crossing lies in; its centre may be "
         "outside"),
    ],
}
