"""Mistakes of lab 8: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
MISTAKES = {
    "8.1": [
        ("np.minimum(*ends), np.maximum(*ends)", "ends",
         "an edge from a to b is taken for another one than that from b to a"),
        ("[second, first], -1", "[first, first], -1", "a face's own vertex is taken for the one "
         "across"),
        ("[second, first], -1", "[second, first], 0", "a boundary gives vertex 0 instead of -1"),
        ("first[edge[::-1]] = own[::-1]", "first[edge] = own",
         "of three faces at an edge the last ones count; it is the first two"),
        ("sound = (low != high).all(1)", "sound = np.ones(len(faces), bool)",
         "faces that name a vertex twice take part"),
    ],
    "8.2": [
        ("((wing < 0) == (own < 0)) | (opposite[:, k] < 0)",
         "((wing < 0) != (own < 0)) | (opposite[:, k] < 0)",
         "folds and flat places are swapped: same winding means a fold"),
        (" | (opposite[:, k] < 0)", "", "the surface's border is no silhouette"),
        (" * side[faces].prod(1)", "", "w of the face's corners is not looked at: each corner "
         "behind the camera turns the winding over"),
        (" * turned", "", "w of the triangle across is not looked at: each corner behind the "
         "camera turns the winding over"),
        ("((wing < 0) == (own < 0)) | (opposite[:, k] < 0)", "True", "all edges are silhouettes"),
        ("(wing < 0) == (own < 0)", "(wing <= 0) == (own <= 0)",
         "a triangle without area counts as clockwise"),
    ],
    "8.3": [
        ("            first = first[first % width < width - 1]\n", "            pass\n",
         "the end of a row is taken for the neighbour of the next one's beginning"),
        ("outlined[:-step] | outlined[step:]", "outlined[:-step] & outlined[step:]",
         "both pixels must be outlined; one is enough"),
        ("outlined[:-step] | outlined[step:]", "outlined[:-step]",
         "only the first pixel's outline is looked at"),
        (" & (outlined[:-step] | outlined[step:])", "", "outlined is not looked at"),
        ("(face[:-step] != face[step:]) & ", "", "pixels of the same face are paired"),
        ("for step in 1, width", "for step in (1,)", "pixels above each other are left out"),
    ],
    "8.4": [
        ("depth[first] < depth[second]", "depth[first] > depth[second]",
         "the farther pixel owns the edge"),
        ("depth[first] < depth[second]", "depth[first] <= depth[second]",
         "of equally deep ones the first is the owner; it is the second"),
        ("np.where(is_first, first, second), np.where(is_first, second, first)", "first, second",
         "the first is always the owner"),
        ("np.where(is_first, first, second), np.where(is_first, second, first)",
         "np.where(is_first, second, first), np.where(is_first, first, second)",
         "owner and other are swapped"),
    ],
    "8.5": [
        ("screen_x - (column + 0.5), screen_y - (row + 0.5)", "screen_x - column, screen_y - row",
         "the corner of the pixel is taken for its centre"),
        ("dx * x + dy * y", "np.abs(dx) * x + np.abs(dy) * y",
         "nothing is mirrored where the other pixel comes before the owner"),
        ("np.abs(dy) * x + np.abs(dx) * y", "dy * x + dx * y",
         "y is mirrored, too; only x ever is"),
        ("dx * x + dy * y, np.abs(dy) * x + np.abs(dx) * y", "dx * x, dy * y",
         "x and y are not swapped for two pixels above each other"),
        ("row, column = np.divmod", "column, row = np.divmod", "rows and columns are swapped"),
    ],
    "8.6": [
        ("dx * grad_x + np.abs(dy) * grad_y, dy * grad_x + np.abs(dx) * grad_y", "grad_x, grad_y",
         "gradients are not turned back into the picture's directions"),
        ("dx * grad_x", "np.abs(dx) * grad_x", "the mirror is forgotten on the way back, for "
         "pixels side by side"),
        ("dy * grad_x", "np.abs(dy) * grad_x", "the mirror is forgotten on the way back, for "
         "pixels above each other"),
        ("dx * grad_x + np.abs(dy) * grad_y, dy * grad_x + np.abs(dx) * grad_y",
         "dx * grad_x + dy * grad_y, np.abs(dy) * grad_x + np.abs(dx) * grad_y",
         "the forward's formula is used: the way back is its transpose"),
    ],
    "8.7": [
        ("x - y *", "x + y *", "the sign of the step along the edge is wrong"),
        ("(x1 - x0) / (y1 - y0)", "(y1 - y0) / (x1 - x0)", "the slope is upside down"),
        ("nearer = np.abs(y1) < np.abs(y0)", "nearer = np.zeros(np.shape(y0), bool)",
         "it is always measured from the first end, even if that is near infinity"),
        ("np.abs(y1) < np.abs(y0)", "np.abs(y1) > np.abs(y0)", "it is measured from the farther end"),
        ("x - y * (x1 - x0) / (y1 - y0)", "(x0 + x1) / 2", "it is the middle of the edge"),
    ],
    "8.8": [
        ("np.copysign(epsilon, y1 - y0)", "epsilon", "epsilon makes an edge that goes down shorter; "
         "it must keep the sign of y1 - y0"),
        ("-slope * y0", "slope * y0", "the gradient by x1 has the wrong sign"),
        ("slope * (c - x1)", "slope * (x1 - c)", "the gradient by y0 has the wrong sign"),
        ("slope * y1, slope * (c - x1), -slope * y0", "-slope * y0, slope * (c - x1), slope * y1",
         "the gradients by x0 and x1 are swapped"),
        ("grad_c * r", "r", "grad_c is left out"),
    ],
    "8.9": [
        ("c.argmax(0)", "c.argmin(0)", "the first crossing is taken; it is the last"),
        ("above = np.full(x.shape, -np.inf), y * w", "above = np.full(x.shape, -np.inf), y",
         "the sign of w is left out: a corner behind the camera is mirrored"),
        ("        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0\n", "",
         "crossings behind the camera count"),
        ("(above[i] < 0) != (above[j] < 0)", "(above[i] <= 0) != (above[j] <= 0)",
         "an end on the line counts as below; it counts as above"),
        ("-np.inf", "0.0", "an edge that does not cross has c = 0 instead of minus infinity"),
    ],
    "8.10": [
        ("is_silhouette & ", "", "every edge is taken for a silhouette"),
        (" & is_steep", "", "edges that are not steep are blended in both directions"),
        ("np.abs(y1 - y0) >= np.abs(x1 - x0)", "np.abs(y1 - y0) <= np.abs(x1 - x0)",
         "flat edges are taken instead of steep ones"),
        ("np.abs(y1 - y0) >= np.abs(x1 - x0)", "np.abs(y1 - y0) > np.abs(x1 - x0)",
         "an edge of 45 degrees is not steep; as long in y as in x is enough"),
        ("(c > -WINDOW) & (c < 1 + WINDOW)", "(c >= 0) & (c <= 1)",
         "crossings less than WINDOW outside are left out"),
        (" & (c > -WINDOW) & (c < 1 + WINDOW)", "", "crossings anywhere count; they must lie "
         "between the centres"),
    ],
    "8.11": [
        ("0.5 - np.clip(c, 0, 1)", "np.clip(c, 0, 1) - 0.5", "alpha has the wrong sign"),
        ("np.clip(c, 0, 1)", "c", "a c outside of [0, 1] is not brought back"),
        ("0.5 - np.clip(c, 0, 1)", "1 - np.clip(c, 0, 1)", "1/2 is missing: alpha is 0 where the "
         "edge is in the middle"),
        ("0.5 - np.clip(c, 0, 1)", "np.clip(c, 0, 1)", "c itself is taken for alpha"),
    ],
    "8.12": [
        ("-grad_alpha", "grad_alpha", "the gradient has the wrong sign: alpha falls where c grows"),
        ("np.where((0 < c) & (c < 1), -grad_alpha, 0.0)", "-grad_alpha",
         "there is a gradient outside of 0 < c < 1, too, where alpha does not change"),
        ("(0 < c) & (c < 1)", "(0 <= c) & (c <= 1)", "c = 0 and c = 1 have a gradient; they have "
         "none"),
        ("-grad_alpha", "-1.0", "grad_alpha is left out"),
    ],
    "8.13": [
        ("np.add.at(output, changed, alpha[:, None] * (pixels[other] - pixels[owner]))",
         "output[changed] += alpha[:, None] * (pixels[other] - pixels[owner])",
         "a pixel of several pairs keeps only one of its changes; they add up"),
        ("alpha > 0, owner, other", "alpha > 0, other, owner", "the wrong one of the two pixels "
         "changes"),
        ("pixels[other] - pixels[owner]", "pixels[owner] - pixels[other]",
         "colours move away from each other: the sign of the change is wrong"),
        ("np.where(alpha > 0, owner, other)", "owner", "the owner changes in any case"),
        ("alpha[:, None] * (", "np.abs(alpha[:, None]) * (",
         "the sign of alpha is lost in the change"),
    ],
    "8.14": [
        ("np.add.at(grad_colour, owner, -alpha[:, None] * grad_changed)",
         "grad_colour[owner] += -alpha[:, None] * grad_changed",
         "a pixel of several pairs keeps only one of its gradients; they add up"),
        ("-alpha[:, None] * grad_changed", "alpha[:, None] * grad_changed",
         "the owner's gradient has the wrong sign"),
        ("grad_pixels.copy()", "np.zeros(grad_pixels.shape)",
         "the pixel's own colour is left out: without a blend its gradient is grad_output"),
        (".sum(1)", ".mean(1)", "grad_alpha is the mean over the channels instead of the sum"),
        ("alpha >= 0, owner, other", "alpha > 0, owner, other",
         "at alpha = 0 the other pixel's change counts; it is the owner's"),
        ("pixels[other] - pixels[owner]", "pixels[owner] - pixels[other]",
         "grad_alpha has the wrong sign"),
    ],
}
