"""Mistakes of lab 5: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
MISTAKES = {
    "5.1": [
        ("(1 - t) * a + t * b", "t * a + (1 - t) * b", "t runs from b to a"),
        ("(1 - t) * a + t * b", "(a + b) / 2 + 0 * t", "it is the middle, whatever t is"),
        ("(1 - t) * a + t * b", "a + t * b", "b is added to a, and a is not taken away"),
        ("(1 - t) * a + t * b", "a + np.clip(t, 0, 1) * (b - a)", "t is kept between 0 and 1; it "
         "may lie outside"),
    ],
    "5.2": [
        ("t * w_0 / lerp(w_1, w_0, t)", "t + 0 * w_0 * w_1",
         "the fraction on the screen is taken for that in space"),
        ("t * w_0 / lerp(w_1, w_0, t)", "t * w_1 / lerp(w_0, w_1, t)", "w_0 and w_1 are swapped"),
        ("t * w_0 / lerp(w_1, w_0, t)", "1 - t * w_0 / lerp(w_1, w_0, t)",
         "it is measured from the other end"),
        ("t * w_0 / lerp(w_1, w_0, t)", "t * w_0 / lerp(w_0, w_1, t)",
         "the denominator is the w at t, instead of t w_0 + (1 - t) w_1"),
    ],
    "5.3": [
        ("return grad * w_0 * w_1", "return grad_q * w_0 / v",
         "the denominator is taken for a constant"),
        ("-grad * t", "grad * t", "the gradient by w_1 has the wrong sign"),
        ("grad_q / v**2", "grad_q / v", "it is divided by v once instead of by v^2"),
        ("grad_q / v**2", "1 / v**2", "grad_q is left out"),
        ("lerp(w_1, w_0, t)", "lerp(w_0, w_1, t)", "w_0 and w_1 are swapped in the denominator"),
    ],
    "5.4": [
        (" / lerp(1 / w_0, 1 / w_1, t)", "", "A / w is not divided by 1 / w again"),
        ("lerp(a_0 / w_0, a_1 / w_1, t) / lerp(1 / w_0, 1 / w_1, t)",
         "lerp(a_0, a_1, t)",
         "the attributes are mixed as they look on the screen: that is not in perspective"),
        ("lerp(a_0 / w_0, a_1 / w_1, t) / lerp(1 / w_0, 1 / w_1, t)",
         "lerp(a_0 * w_0, a_1 * w_1, t) / lerp(w_0, w_1, t)", "the ends are multiplied by w "
         "instead of divided"),
        ("lerp(1 / w_0, 1 / w_1, t)", "(1 / lerp(w_0, w_1, t))",
         "1 / w is taken of the mixed w; what is linear is 1 / w itself"),
    ],
    "5.5": [
        ("e / w", "e * w", "the weights are multiplied by w instead of divided"),
        ("e / w", "e", "the weights on the screen are taken: 1 / w is missing"),
        ("n / n.sum(-1, keepdims=True)", "n", "the sum is not made 1"),
        ("n / n.sum(-1, keepdims=True)", "n / n.sum(0, keepdims=True)",
         "the sum is over the points instead of the three corners"),
        ("n / n.sum(-1, keepdims=True)", "n / e.sum(-1, keepdims=True)",
         "it is divided by the sum of e, not by that of e / w"),
    ],
    "5.6": [
        ("(grad_b - (grad_b * n / s).sum(-1, keepdims=True)) / s", "grad_b / s",
         "the sum s is taken for a constant, but every n_k is in it"),
        ("(grad_b * n / s)", "(grad_b * n)", "the mean of grad_b is not divided by s"),
        ("-grad_n * n / w", "grad_n * n / w", "the gradient by w has the wrong sign"),
        ("-grad_n * n / w", "-grad_n * e / w", "the gradient by w is divided by w once; n / w "
         "is e / w^2"),
        ("return grad_n / w", "return grad_n", "the gradient by e is not divided by w"),
    ],
    "5.7": [
        ("(dn - n[..., None] / s * ds) / s", "dn / s", "the sum s is taken for a constant"),
        ("de / w[..., None]", "de", "de is not divided by w"),
        ("(dn - n[..., None]", "(dn + n[..., None]", "a sign in the quotient rule is wrong"),
        ("n[..., None] / s * ds", "n[..., None] * ds", "n was taken for b in eq. (4): b is n / s"),
    ],
    "5.8": [
        ("barycentric[i, j], strict", "barycentric[i, j, ::-1], strict",
         "the weights go to the corners in reverse order"),
        ("face_index >= 0", "face_index > 0", "face 0 is taken for no face"),
        ("output[i, j] += b * attributes[vertex]", "output[i, j] = b * attributes[vertex]",
         "only the last corner counts"),
        ("output[i, j] += b * attributes[vertex]", "output[i, j] += attributes[vertex] / 3",
         "it is the mean of the three corners: the weights are not used"),
        ("faces[face_index[i, j]]", "range(3)", "every pixel shows the first three vertices"),
    ],
    "5.9": [
        ("grad_attributes[vertex] +=", "grad_attributes[vertex] =",
         "a vertex keeps the gradient of its last pixel alone; they add up"),
        ("barycentric[i, j, k] * grad_output[i, j]", "grad_output[i, j] / 3",
         "the gradient is shared out evenly, without the weights"),
        ("grad_barycentric[i, j, k] = grad_output[i, j] @ attributes[vertex]",
         "grad_barycentric[i, j, k] = attributes[vertex].sum()",
         "grad_output is left out of the weights' gradient"),
        ("face_index >= 0", "face_index > 0", "face 0 is taken for no face"),
        ("return grad_attributes, grad_barycentric", "return grad_barycentric, grad_attributes",
         "the two gradients are returned in the wrong order"),
    ],
    "5.10": [
        ("np.append(0, np.cumsum(3 * (face >= 0)))", "np.append(np.cumsum(3 * (face >= 0)), 0)",
         "start begins with the end of the first row; it begins with 0"),
        ("3 * (face >= 0)", "(face >= 0)", "a row is counted as one entry; it has three"),
        ("face >= 0", "face > 0", "face 0 is taken for no face"),
        ("return start, vertex.reshape(-1), weight.reshape(-1)",
         "return start, vertex.T.reshape(-1), weight.T.reshape(-1)",
         "all first corners come first; the entries of a pixel stand together"),
        ("face_index.reshape(-1)", "face_index.T.reshape(-1)",
         "pixels are counted column by column; they go row by row"),
    ],
    "5.11": [
        (".reshape(*face_index.shape, attributes.shape[1])",
         ".reshape(*face_index.shape[::-1], attributes.shape[1]).swapaxes(0, 1)",
         "pixels are counted column by column; they go row by row"),
        (".reshape(*face_index.shape, attributes.shape[1])", "", "the pixels are not put back into "
         "the rows of the picture"),
        ("(weights @ attributes)", "(abs(weights) @ attributes)",
         "negative weights lose their sign"),
        ("barycentric)\n", "barycentric[..., ::-1])\n", "the weights are in reverse order"),
    ],
    "5.12": [
        ("return weights.T @ grad_pixels,", "return abs(weights).T @ grad_pixels,",
         "negative weights lose their sign"),
        ("return weights.T @ grad_pixels,", "return (weights != 0).T @ grad_pixels,",
         "every corner gets the whole gradient, without its weight"),
        ('np.einsum("nc,nc->n", grad_seen, at_corner)', "at_corner.sum(1)",
         "grad_output is left out of the weights' gradient"),
        ('np.einsum("nc,nc->n", grad_seen, at_corner)', "(grad_seen * at_corner).mean(1)",
         "the weights' gradient is the mean over the channels instead of the sum"),
        ("for k, vertex in enumerate(corners)", "for k, vertex in enumerate(corners[::-1])",
         "the weights' gradients are in reverse order"),
    ],
    "5.13": [
        ("(0, 1))", "(1, 0))", "the derivatives by x and by y are swapped"),
        ("[by_x, by_y], -1", "[by_x, by_y], -2", "the derivatives stand before the channels; they "
         "are the last axis"),
        ("[by_x, by_y], -1", "[by_x, by_x], -1", "both are the derivative by x"),
        ("[by_x, by_y], -1", "[by_x, -by_y], -1", "y points down"),
    ],
    "5.14": [
        ("by_x[0] + by_y[0]", "by_x[0]", "only the derivatives by x reach the attributes"),
        ("by_x[0] + by_y[0]", "(by_x[0] + by_y[0]) / 2", "the attributes' gradient is the mean of "
         "both directions; they add up"),
        ("[by_x[1], by_y[1]]", "[by_y[1], by_x[1]]", "the derivatives by x and by y are swapped"),
        ("[by_x[1], by_y[1]], -1", "[by_x[1], by_y[1]], -2", "the derivatives stand before the "
         "corners; they are the last axis"),
    ],
}
