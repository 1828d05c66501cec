"""Mistakes of lab 6: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
SIZES = "width and height are swapped"
INSIDE = "np.ones(np.shape(index), bool)"
LOOK = "csr_array((weight.ravel(), index.ravel(), start), (len(index), len(texels))) @ texels"
WEIGHED = 'np.einsum("nk,nkc->nkc", weight, texels[index])'
SCATTERED = "return matrix.T @ grad_colour, grad_weight"
BY_U, BY_V = "(grad_column[1] - grad_column[0]) * ", "(grad_row[1] - grad_row[0]) * "
BY_UV = f"[{BY_U}width,\n                     {BY_V}height]"
CENTRES = "(np.arange(n) + 0.5) / n - 0.5"
HALF = "(means[:, ::columns] + means[:, columns - 1::columns]) / 2"
SHARE = "grad_half.repeat(rows, 0).repeat(columns, 1) / (rows * columns)"
DOWN = """    for grad_level in grad_levels[-2::-1]:
        grad = grad_level + halve_backward(grad, grad_level)
"""
TEXELS = "jacobian * [[width], [height]]"
SQUARES = "s_x**2 + t_x**2, s_y**2 + t_y**2"
BY_J = """[2 * grad_A * s_x + grad_C * s_y, 2 * grad_B * s_y + grad_C * s_x,
                     2 * grad_A * t_x + grad_C * t_y, 2 * grad_B * t_y + grad_C * t_x]"""

MISTAKES = {
    "6.1": [
        ("np.floor(x * size)", "(x * size)", "it is cut towards 0: below 0 it is one too high"),
        ("np.floor(x * size)", "np.round(x * size)",
         "it is rounded: a texel lies between two borders, not around one"),
        ("x * size", "x * size - 0.5", "half a texel is taken away; that is for the linear filter"),
        ("np.floor(x * size)", "np.clip(np.floor(x * size), 0, size - 1)",
         "the number is pulled into the texture; that is left to the boundary"),
        ("np.floor(x * size)", "(np.floor(x * size) % size)",
         "the texture repeats already; that is left to the boundary"),
        ("x * size", "x * (size - 1)", "x = 1 is the last texel; it is the border behind it"),
    ],
    "6.2": [
        (" - 0.5", "", "texel j is taken to lie at j / size, which is its border, not its centre"),
        ("- 0.5", "+ 0.5", "half a texel is added; it is taken away"),
        ("[1 - weight, weight]", "[weight, 1 - weight]", "the two weights are swapped"),
        ("np.floor(position)", "np.trunc(position)",
         "it is cut towards 0: below 0 it is one too high"),
        ("x * size - 0.5", "x * (size - 1)",
         "x runs from the first centre to the last one; it runs from border to border"),
    ],
    "6.3": [
        ("size - 1", "size", "the last texel is number size; it is size - 1"),
        ("np.clip(index, 0, size - 1)", "index % size",
         "the texture repeats; its border goes on for ever"),
        (INSIDE, "(index >= 0) & (index < size)",
         "beyond the texture is nothing; there is its border"),
        ("np.clip(index, 0, size - 1)", "np.minimum(np.abs(index), size - 1)",
         "below 0 the texture is mirrored; there is its border"),
    ],
    "6.4": [
        ("index < size", "index <= size", "number size counts as inside; the last one is size - 1"),
        ("index >= 0", "index > 0", "texel 0 counts as outside"),
        ("np.where(inside, index, 0)", "index", "a number outside comes back; it becomes 0"),
        ("np.where(inside, index, 0)", "np.clip(index, 0, size - 1)",
         "a number outside becomes the nearest one; it becomes 0"),
        ("0), inside", f"0), {INSIDE}", "all count as inside"),
    ],
    "6.5": [
        (LOOK, "texels[index].sum(1)", "the weights are left out"),
        (LOOK, f"{WEIGHED}.sum(1) / weight.sum(1, keepdims=True)",
         "it is divided by the sum of the weights; they are taken as they are"),
        (LOOK, f"{WEIGHED}.mean(1)", "it is the mean of the weighed texels instead of their sum"),
        (LOOK, f"{WEIGHED}.sum(2)", "the channels are summed instead of the texels"),
        (LOOK, "texels[index[:, 0]]", "only the first texel of each row is looked at"),
    ],
    "6.6": [
        (SCATTERED, "grad_texels = np.zeros(texels.shape)\n    for at, w, g in zip(index, weight, "
         "grad_colour, strict=True):\n        grad_texels[at] += w[:, None] * g\n"
         "    return grad_texels, grad_weight",
         "a texel that a row names twice gets one of its gradients; they add up"),
        ("matrix.T @", "(matrix != 0).T @", "each texel gets the whole gradient, not its weight's"),
        (SCATTERED, "grad_texels = np.zeros(texels.shape)\n    grad_texels[index] = "
         "weight[..., None] * grad_colour[:, None]\n    return grad_texels, grad_weight",
         "a texel keeps the gradient of its last point alone; they add up"),
        ("texels.take(texel, 0))", "texels.take(texel, 0) / texels.shape[1])",
         "the weights' gradient is the mean over the channels instead of the sum"),
        ('"nc,nkc->nk", grad, texels', '"nkc->nk", texels',
         "grad_colour is left out of the weights' gradient"),
        (SCATTERED, f"{SCATTERED} * weight",
         "the weights' gradient has the weight as a factor; it is the texel alone"),
    ],
    "6.7": [
        (BY_UV, BY_UV.replace(" * width", "").replace(" * height", ""),
         "sizes are left out: u runs from 0 to 1, x from 0 to the width"),
        (BY_UV, f"[{BY_U}height, {BY_V}width]", SIZES),
        (BY_UV, f"[{BY_V}height, {BY_U}width]", "the gradients by u and by v are swapped"),
        (BY_UV, f"[-{BY_U}width, -{BY_V}height]", "the sign is wrong: a is the weight of j + 1"),
        ("grad_weight * column_weight", "grad_weight",
         "the columns' weights are left out of the gradient by v"),
        ("reshape(2, 2, -1)", "reshape(2, 2, -1).swapaxes(0, 1)",
         "the four texels are taken column by column; they stand row by row"),
    ],
    "6.8": [
        (CENTRES, "(np.arange(n) + 0.5) / n",
         "d is measured from the pixel's lower left corner instead of its centre"),
        (CENTRES, "np.linspace(-0.5, 0.5, n)",
         "the points reach from border to border; they are the centres of n x n squares"),
        ("d[..., None, :]).sum(-1)", "d[..., None]).sum(-2)", "the Jacobian is transposed"),
        ("np.meshgrid(offset, offset)", 'np.meshgrid(offset, offset, indexing="ij")',
         "points go column by column; they go row by row"),
        ("(jacobian * d[..., None, :]).sum(-1)", "jacobian[:, [0, 1], [0, 1]] * d",
         "only u_x and v_y are used, and not u_y and v_x"),
        ("np.meshgrid(offset, offset)", "np.meshgrid(offset, -offset)",
         "the points begin with the highest row; they begin with the lowest"),
    ],
    "6.9": [
        (") / 2", ")", "texels are summed instead of averaged"),
        (HALF, "image[::rows, ::columns]", "only one texel of each 2 x 2 is looked at"),
        ("image[rows - 1::rows]", "image[::rows]", "only every second row is looked at"),
        (HALF, f"{HALF} * (rows * columns / 4)",
         "with a side of 1 it is divided by 4; a mean is of two texels there"),
    ],
    "6.10": [
        (" / (rows * columns)", "", "each texel gets the whole gradient, not its share"),
        ("(rows * columns)", "4", "with a side of 1 it is divided by 4; a mean is of two texels"),
        (SHARE, "np.tile(grad_half, (rows, columns, 1)) / (rows * columns)",
         "the whole picture is repeated; each of its texels must be"),
        (SHARE, "np.kron(grad_half, np.eye(rows * columns)[0].reshape(rows, columns, 1))",
         "the first texel of each 2 x 2 gets all of the gradient"),
    ],
    "6.11": [
        ("grad_level + halve", "halve", "what a level itself has for a gradient is forgotten"),
        (DOWN, "    for below, above in list(zip(grad_levels, grad_levels[1:]))[:1]:\n"
         "        grad = below + halve_backward(above, below)\n",
         "gradients come down from level 1 alone; the levels above it hand theirs on"),
        (DOWN, "    grad = grad_levels[0]\n", "only the gradient of level 0 itself counts"),
        ("+ halve_backward(grad, grad_level)", "+ 4 * halve_backward(grad, grad_level)",
         "what comes down a level is not shared out among the four texels"),
    ],
    "6.12": [
        (TEXELS, "jacobian", "J is not in texels"),
        (TEXELS, "jacobian * [[height], [width]]", SIZES),
        (TEXELS, "jacobian * [width, height]",
         "J's columns, x and y, are multiplied by the sizes; it is its rows, u and v"),
        (" + C**2", "", "C is left out: the level depends on how the texture is turned"),
        ("C**2)) / 2", "C**2))", "the 1/2 is left out: S + R is the square of a length"),
        ("np.log2", "np.log", "the natural logarithm is taken; it is that of base 2"),
        (SQUARES, "s_x**2 + s_y**2, t_x**2 + t_y**2",
         "A and B are of J's rows, but C is of its columns"),
        (" + np.sqrt((A - B)**2 / 4 + C**2)", "", "R is left out"),
    ],
    "6.13": [
        ("grad.reshape(-1, 2, 2) * [[width], [height]]", "grad.reshape(-1, 2, 2)",
         "the sizes are left out on the way back"),
        ("2 * np.log(2) *", "2 *", "the logarithm of base 2 is derived like the natural one"),
        ("2 * np.log(2) *", "np.log(2) *", "the 1/2 before the logarithm is left out"),
        ("np.where(R > 0, R, np.inf)", "np.full(R.shape, np.inf)", "R is taken for a constant"),
        (BY_J, BY_J.replace(" + grad_C * s_x", "").replace(" + grad_C * t_x", ""),
         "C pulls at s_x and t_x, but not at s_y and t_y"),
        ("grad_level /", "1 /", "grad_level is left out"),
        ("np.where(S > 0, S + R, np.inf)", "np.where(S > 0, S, np.inf)",
         "it is divided by S; the logarithm is that of S + R"),
        ("np.where(R > 0, R, np.inf)", "(R + 1e-12)",
         "a small number is added to R: small footprints have a wrong gradient"),
        (BY_J, BY_J.replace("2 * ", ""), "the squares of A and B are derived without their 2"),
    ],
    "6.14": [
        ("np.floor(level)", "np.round(level)", "the level is rounded; the lower one is its floor"),
        ("level = np.clip(level, 0, top)\n    lower = np.floor(level)",
         "lower = np.clip(np.floor(level), 0, top)",
         "lower is clamped, but the fraction is of the level as it came"),
        ("np.minimum(lower + 1, top)", "lower + 1", "upper is beyond the pyramid's last level"),
        ("level - lower", "lower + 1 - level",
         "the fraction is that of the lower level; f is the upper one's"),
        ("np.floor(level).astype(int)", "np.minimum(level, max(top - 1, 0)).astype(int)",
         "at the top lower is the level below and the fraction 1; lower is top itself"),
        ("np.minimum(lower + 1, top)", "np.ceil(level).astype(int)",
         "a whole level is its own upper one; that is the next"),
    ],
    "6.15": [
        ("(level > 0) & (level < top)", "(level >= 0) & (level <= top)",
         "levels 0 and top have a gradient; they count as clamped"),
        ("np.where((level > 0) & (level < top), grad_fraction, 0)", "1 * grad_fraction",
         "levels that are clamped have a gradient"),
        ("(level < top)", "(level < top) & (np.floor(level) != level)",
         "a whole level has no gradient; between 0 and top it has"),
        ("(level > 0) & (level < top)", "level < top", "only the upper end is looked at"),
        ("grad_fraction, 0", "1.0, 0.0", "grad_fraction is left out"),
    ],
}
