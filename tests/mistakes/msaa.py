"""Mistakes of lab 4: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
SWAPPED = "x and y are swapped"
FACE_0 = "face 0 is taken for no face"
OWN_SHADES = "every sample has a shade of its own: that is supersampling"
BLOCKS = "picture.reshape(height // n, n, width // n, n, channels).mean((1, 3))"
REPEATED = "grad_output.repeat(n, 0).repeat(n, 1) / n**2"
PAIR = "i * width + j, face_index[s, i, j]"
MIX = "picture[mixed] += others / len(request)"
SUMS = "grad_colour = np.stack([np.bincount(used, part, len(shade) + 1) for part in parts.T], -1)"

MISTAKES = {
    "4.1": [
        ("[j, i]", "[i, j]", "it goes column by column: x and y are swapped"),
        (" + 0.5", "", "samples lie at the corners of the small squares instead of their centres"),
        ("(np.stack([j, i], -1) + 0.5) / n", "np.stack([j, i], -1) / max(n - 1, 1)",
         "samples reach from one border of the pixel to the other; none lies on a border"),
        ("[j, i]", "[j, n - 1 - i]", "rows are counted from the top; the first one is the lowest"),
    ],
    "4.2": [
        ("(s + 1)", "s", "s is multiplied instead of s + 1"),
        ("(count + 1)", "count", "the remainder is that by S instead of by S + 1"),
        (" - 1\n", "\n", "the 1 is not taken away after the remainder"),
        ("[s, row]", "[row, s]", SWAPPED),
        (" + 0.5", "", "samples lie at the borders of their columns and rows, not in the middle"),
    ],
    "4.3": [
        ("clip[:, 3:] * ", "", "w is left out: far vertices move less on screen"),
        ("clip[:, 3:] *", "np.abs(clip[:, 3:]) *",
         "|w| is taken for w: vertices behind the camera move the wrong way"),
        ("1 - 2 * offset", "2 * offset - 1", "the sample moves away from the centre, not to it"),
        ("[width, height]", "[height, width]", "width and height are swapped"),
        ("1 - 2 * offset", "0.5 - offset",
         "vertices move half as far: ndc is 2 wide, so a pixel is 2 / width"),
        ("1 - 2 * offset", "-2 * offset", "what is at offset comes to the pixel's corner"),
    ],
    "4.4": [
        (">= 0", "> 0", FACE_0),
        ("mean(0)", "sum(0)", "samples are counted; what is asked for is their share"),
        ("(face_index >= 0).mean(0)", "(face_index >= 0).any(0) * 1.0",
         "one sample on a face is enough for the whole pixel"),
        ("mean(0)", "mean(-1)", "the mean is over a row of pixels; samples are the first axis"),
        ("(face_index >= 0).mean(0)", "face_index.mean(0)", "the faces' numbers are averaged"),
    ],
    "4.5": [
        ("-(x", "(x", "the order has the wrong sign: it is minus the slope"),
        ("    x = x - x.mean()\n", "", "the line is forced through the origin"),
        ("-(x @ y) / (x @ x)", "-(x @ x) / (x @ y)", "the slope is that of log n over log error"),
        ("np.log(n), np.log(error)", "n, error", "no logarithm is taken"),
        ("np.log(n), np.log(error)", "np.log2(n), np.log(error)",
         "the two logarithms have different bases"),
        ("-(x @ y) / (x @ x)", "-(y[-1] - y[0]) / (x[-1] - x[0])",
         "only the first and the last error count"),
    ],
    "4.6": [
        ("mean", "sum", "it is the sum of a block instead of its mean"),
        (BLOCKS, "picture[::n, ::n]", "only one pixel of each block is looked at"),
        (BLOCKS, "picture.reshape(n, height // n, n, width // n, channels).mean((0, 2))",
         "pixels that lie far apart are put together; a block is n x n neighbours"),
        (BLOCKS, f"{BLOCKS}.repeat(n, 0).repeat(n, 1)",
         "the picture keeps its size; a block becomes one pixel"),
    ],
    "4.7": [
        (" / n**2", "", "every pixel of a block gets the whole gradient, not its share"),
        ("n**2", "n", "it is divided by n; a block has n * n pixels"),
        (REPEATED, "np.tile(grad_output, (n, n, 1)) / n**2",
         "the whole picture is repeated; each of its pixels must be"),
        (REPEATED, "np.kron(grad_output, np.eye(n * n)[0].reshape(n, n, 1))",
         "the first pixel of a block gets all of the gradient"),
    ],
    "4.8": [
        ("i * width", "i * height", "pixel is row * H + column; it is row * W + column"),
        (">= 0", "> 0", FACE_0),
        ("if face_index[s, i, j] >= 0", "if True", "the background is shaded as if it were a face"),
        (PAIR, "i * width + j + s / 1000, face_index[s, i, j]", OWN_SHADES),
        (PAIR, f"next((p for p in pairs if p[1] == face_index[s, i, j]), ({PAIR}))",
         "a face is shaded once for the whole picture; it is once for each pixel"),
        (PAIR, f"next((p for p in pairs if p[0] == i * width + j), ({PAIR}))",
         "a pixel is shaded once, whatever faces its samples see"),
        ("np.full(face_index.shape, -1)", "np.full(face_index.shape, 0)",
         "a sample that sees no face has request 0 instead of -1"),
        ("setdefault(pair, len(pairs))", "setdefault(pair, len(pairs)) + 1",
         "requests are counted from 1; they start with 0"),
    ],
    "4.9": [
        (">= 0", "> 0", FACE_0),
        (" & (seen >= 0)", "", "in mixed pixels the background is shaded as if it were a face"),
        ("(last == np.arange(len(seen))[:, None]) & ", "", "in mixed pixels " + OWN_SHADES),
        ("len(pixel) + np.arange(len(k))", "np.arange(len(k))",
         "the pairs of mixed pixels are numbered from 0 again, as if there were no others"),
        ("(seen[1:] != seen[0]).any(0)", "(seen[1:] < -1).any(0)",
         "only the first sample of each pixel is looked at"),
        ("(seen[1:] != seen[0]).any(0)", "(seen[1:] != seen[0]).all(0)",
         "a pixel counts as mixed only if no sample is like the first; one other is enough"),
    ],
    "4.10": [
        (MIX, "picture[mixed] = sum(colour.take(sample, 0) for sample in used[:, mixed])"
         " / len(request)",
         "colours are summed and divided: equal ones do not come out to the last bit"),
        ("background[None]", "0 * background[None]", "the background counts as black"),
        (MIX, "seen = (used[:, mixed] >= 0)[..., None]\n    picture[mixed] = (colour.take(used"
         "[:, mixed], 0) * seen).sum(0) / np.maximum(seen.sum(0), 1)",
         "samples of the background are left out of the mean"),
        (MIX, "pass", "the first sample's colour is that of the pixel"),
        ("/ len(request)", "/ 4", "it is divided by 4, whatever the number of samples"),
        (MIX, "picture[mixed] = np.reshape([np.mean([colour[r] for r in set(used[:, m].tolist())],"
         " 0) for m in mixed], (len(mixed), -1))",
         "a face counts once, however many of the samples see it"),
    ],
    "4.11": [
        (" / len(request)\n", "\n", "every sample brings the whole gradient, not its share"),
        (SUMS, "grad_colour = np.zeros((len(shade) + 1, len(background)))\n"
         "    grad_colour[used] = parts",
         "a shade keeps the gradient of its last sample alone; they add up"),
        ("grad_colour[0]\n", "0 * grad_colour[0]\n", "the background has no gradient"),
        ("/ len(request)\n", "/ request.size\n",
         "it is divided by all samples of the picture, not by those of a pixel"),
        ("(used, part, ", "(used, parts.mean(1), ", "all channels have the same gradient"),
    ],
    "4.12": [
        ("ordered >= 0", "ordered > 0", FACE_0),
        ("ordered >= 0", "ordered >= -1", "the background is shaded as if it were a face"),
        ("np.sort(face_index, 0)", "face_index",
         "equal samples share a shade only if they are neighbours"),
        ("int(new.sum())", "len(set(face_index[face_index >= 0]))",
         "a face is shaded once for the whole picture; it is once for each pixel"),
        ("    new[1:] &= ordered[1:] != ordered[:-1]\n", "", OWN_SHADES),
        ("face_index.size * sample_bytes", "int((face_index >= 0).sum()) * sample_bytes",
         "only samples on faces take bytes; all of them are stored"),
    ],
}
