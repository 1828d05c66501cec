"""Mistakes of lab 15: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
SLOPE = "np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)"
HALF_H = "np.maximum(1 - np.abs(a - b) / k, 0)"
BLEND = "np.minimum(a, b) - k * h**2 / 4"
SHARE = "np.where(a < b, 1 - h / 2, h / 2)"
BEFORE = "before * -np.expm1(-thickness)"
BEHIND = "spacing * (passed * along - behind)"
CASE_2 = "2: [(a, c), (a, d), (b, d), (b, c)]"
GRAD_S = "-grad_t * s_b / span**2, grad_t * s_a / span**2"
UNIQUE = "edge, faces = np.unique(edge, return_inverse=True)"

MISTAKES = {
    "15.1": [
        ("np.abs(points) - half_size", "np.abs(points) - half_size / 2",
         "half_size is taken for the whole size"),
        (" + np.minimum(beyond.max(-1), 0)", "", "inside it is 0: the negative part is missing"),
        ("np.linalg.norm(np.maximum(beyond, 0), axis=-1)", "np.linalg.norm(beyond, axis=-1)",
         "axes on which the point lies between the sides count outside, too"),
        ("np.linalg.norm(np.maximum(beyond, 0), axis=-1)", "np.maximum(beyond.max(-1), 0)",
         "at edges and corners it is the largest of three distances instead of the length"),
        ("np.abs(points) - half_size", "points - half_size", "only the positive sides are looked "
         "at"),
        ("np.minimum(beyond.max(-1), 0)", "np.where((beyond < 0).all(-1), beyond.min(-1), 0)",
         "inside the farthest side counts instead of the nearest"),
    ],
    "15.2": [
        ("np.where(points < 0, -1.0, 1.0)", "np.sign(points)",
         "in the middle of an axis the sign is 0: of two opposite sides the positive one counts"),
        (" * outward", "", "negative coordinates get no sign"),
        ("unit(np.maximum(beyond, 0))", "np.maximum(beyond, 0)", "outside the gradient's length is "
         "not 1"),
        (SLOPE, "nearest_side", "outside, at edges and corners, too, only one axis counts"),
        (SLOPE, "unit(np.maximum(beyond, 0))", "inside there is no gradient"),
        ("beyond.max(-1, keepdims=True) > 0", "beyond.max(-1, keepdims=True) >= 0",
         "on the surface the gradient is 0; it is that of the inside"),
        ("np.arange(3) == beyond.argmax(-1)[..., None]",
         "beyond == beyond.max(-1, keepdims=True)", "equally near sides all count; the first axis "
         "does"),
        ("grad_distance[..., None] * ", "", "grad_distance is left out"),
    ],
    "15.3": [
        ("points[..., 0], points[..., 2]", "points[..., 0], points[..., 1]",
         "the ring is around the z axis; it is around y"),
        (" - tube", "", "tube is not taken away: it is the distance to the circle"),
        ("from_axis - radius, points", "from_axis, points", "the radius is left out: a sphere"),
        ("np.hypot(from_axis - radius, points[..., 1]) - tube",
         "np.hypot(from_axis - tube, points[..., 1]) - radius", "radius and tube are swapped"),
        ("np.hypot(from_axis - radius, points[..., 1])",
         "np.hypot(np.maximum(from_axis - radius, 0), points[..., 1])",
         "the hole is filled: inside of the circle only the height counts"),
    ],
    "15.4": [
        ("g_axis = g * (from_axis - radius)", "g_axis = g * np.abs(from_axis - radius)",
         "in the hole the gradient points away from the axis; there it points to it"),
        (" / np.where(from_axis > 0, from_axis, 1)", "",
         "the way from from_axis to x and z is forgotten: its derivative is x / from_axis"),
        ("grad_distance / np.where(from_circle > 0, from_circle, 1)", "grad_distance",
         "it is not divided by the distance from the circle"),
        ("np.where(from_axis > 0, from_axis, 1)", "(from_axis + 1e-3)",
         "a small number is added to what is divided by: 0 is to be kept apart instead"),
        ("g * y", "g_axis * y", "y goes the way of x and z; it is not a part of from_axis"),
        ("grad_distance / np.where", "1 / np.where", "grad_distance is left out"),
    ],
    "15.5": [
        (HALF_H, "(1 - np.abs(a - b) / k)", "h is not kept at 0: far from the seam it swells, "
         "too"),
        ("h**2", "h", "h is not squared"),
        (" / 4", "", "the 4 is missing"),
        ("np.minimum(a, b) - k", "np.minimum(a, b) + k", "the seam is dented instead of filled"),
        ("k * h**2", "h**2", "the factor k is missing"),
        (BLEND, "np.minimum(a, b) - k * np.maximum(1 - (b - a) / k, 0)**2 / 4",
         "|a - b| lost its absolute value: right for a < b alone"),
    ],
    "15.6": [
        (SHARE, "np.where(a < b, h / 2, 1 - h / 2)", "the shares are swapped: the smaller distance "
         "is to have the larger one"),
        (SHARE, "np.where(a < b, 1.0, 0.0)", "it is the gradient of the plain union, which jumps "
         "where a = b"),
        (SHARE, "np.where(a < b, 1 - h, h)", "the half is missing: h^2 / 4 has the derivative h / "
         "2"),
        (SHARE, "np.full(np.shape(a), 0.5)", "both have half, wherever they are"),
        ("1 - np.abs(a - b) / k", "1 - np.abs(a - b)", "k is left out of h"),
        ("grad_distance * (1 - share)", "grad_distance * share", "both get the share of a"),
        (HALF_H, "(1 - np.abs(a - b) / k)", "h is not kept at 0: far from the seam shares become "
         "negative"),
    ],
    "15.7": [
        ("s / lipschitz", "s", "steps are not divided by L"),
        ("s / lipschitz", "s * lipschitz", "steps are multiplied by L instead of divided"),
        ("evaluations[active] += 1", "evaluations += 1", "rays that are done are counted on: all "
         "have the number of the slowest"),
        ("np.where(hit, t, np.inf)", "t", "a miss keeps the t where it ended; it is infinite"),
        ("np.where(hit, t, np.inf)", "np.where(t <= far, t, np.inf)",
         "a ray that did not hit in time counts as a hit"),
        ("t[active] <= far", "t[active] < far", "a ray that is just at far has missed; beyond it "
         "has"),
        ("s < epsilon", "s <= epsilon", "s = epsilon is a hit; it must be less"),
        ("hit[active[s < epsilon]]", "hit[active[np.abs(s) < epsilon]]",
         "a ray that is inside has not hit: |s| is compared"),
        ("range(most)", "range(most + 1)", "one evaluation more than `most` is made"),
    ],
    "15.8": [
        (BEFORE, "passed * -np.expm1(-thickness)", "T holds the sample's own density; it is that "
         "of those before it"),
        (BEFORE, "-np.expm1(-thickness)", "nothing hides what is behind: T is left out"),
        (BEFORE, "before * thickness", "sigma delta is taken for 1 - exp(-sigma delta)"),
        ("thickness = density * spacing", "thickness = density * spacing[:, :1]",
         "all samples have the spacing of the first"),
        ("thickness = density * spacing", "thickness = density", "the spacing is left out"),
        ("passed[:, -1]", "before[:, -1]", "remaining is T before the last sample; it is T behind "
         "it"),
        ("np.cumsum(thickness, -1)", "np.cumsum(thickness[:, ::-1], -1)[:, ::-1]",
         "T is taken from behind: the ray goes from front to back"),
    ],
    "15.9": [
        (BEHIND, "spacing * passed * along", "what becomes hidden does not count"),
        (BEHIND, "passed * along - behind", "the factor delta is missing"),
        ("(remaining * (grad_output @ background))[:, None]",
         "(0 * remaining * (grad_output @ background))[:, None]",
         "the background is not among what is hidden"),
        (BEHIND, "spacing * (passed * along + behind)", "what is hidden is added; it is lost"),
        ("behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]",
         "behind = np.cumsum(seen[:, ::-1], -1)[:, :0:-1]",
         "a sample hides itself: what is behind begins with the next one"),
        (BEHIND, "spacing * (weights / np.maximum(density * spacing, 1e-9) * along - behind)",
         "the opacity is taken to grow evenly; it grows by T behind the sample"),
        ("weights[..., None] * grad_output[:, None]",
         "-np.expm1(-density * spacing)[..., None] * grad_output[:, None]",
         "a colour gets the opacity of its sample; it is the weight"),
        ('np.einsum("rnc,rc->rn", colour, grad_output)',
         'np.einsum("rnc,rc->rn", colour, grad_output) / colour.shape[2]',
         "channels are averaged; they add up"),
    ],
    "15.10": [
        ("    if is_odd(order):", "    if False:", "odd permutations are taken for turns: these "
         "cases are wound the wrong way"),
        ("(a, b), (a, c), (a, d)]", "(b, a), (c, a), (d, a)]",
         "with one vertex inside the outside vertex comes first in a pair"),
        (CASE_2, "2: [(a, c), (a, d), (b, c), (b, d)]", "four corners are not in their order "
         "around: the two triangles cross as a bow tie"),
        ("[(a, d), (b, d), (c, d)]", "[(a, d), (c, d), (b, d)]",
         "three vertices inside are wound as the one outside would be"),
        (CASE_2, "2: [(a, c), (a, d), (b, d)]", "with two vertices inside there is one triangle; "
         "four edges are crossed"),
        ("(a, b), (a, c), (a, d)]", "(a, b), (a, d), (a, c)]", "a single vertex inside is wound "
         "the wrong way"),
        ("order = inside.sum(), np.argsort(~inside, kind=\"stable\")",
         "order = (~inside).sum(), np.argsort(inside, kind=\"stable\")",
         "inside and outside are swapped"),
    ],
    "15.11": [
        ("p_a * s_b[:, None] - p_b * s_a[:, None]", "p_a * s_a[:, None] - p_b * s_b[:, None]",
         "each point is weighted with its own distance; it is that of the other one"),
        (" / (s_b - s_a)[:, None]", "", "it is not divided by s_b - s_a"),
        ("(p_a * s_b[:, None] - p_b * s_a[:, None]) / (s_b - s_a)[:, None]",
         "(p_a + p_b) / 2 + 0 * s_a[:, None] * s_b[:, None]", "it is the middle, whatever the "
         "distances are"),
        ("(p_a * s_b[:, None] - p_b", "(p_a * s_b[:, None] + p_b", "a sign is wrong: s_a is "
         "negative"),
        ("(s_b - s_a)[:, None]", "(s_b + s_a)[:, None]", "it is divided by the sum; s_a is "
         "negative"),
    ],
    "15.12": [
        ("(1 - t) * grad_p, t * grad_p", "t * grad_p, (1 - t) * grad_p",
         "the weights of both ends are swapped"),
        (GRAD_S, "grad_t * s_b / span**2, -grad_t * s_a / span**2",
         "the gradients by the distances have the wrong sign"),
        (GRAD_S, "-grad_t * s_b / span, grad_t * s_a / span",
         "it is divided by s_b - s_a once; the derivative of the quotient has its square"),
        (GRAD_S, "-grad_t * s_a / span**2, grad_t * s_b / span**2",
         "s_a and s_b are swapped in the derivatives of t"),
        (GRAD_S, "-grad_t / span, grad_t / span",
         "the denominator is taken for a constant"),
        ("(grad_p * (p_b - p_a)).sum(-1)", "(grad_p * (p_b - p_a)).mean(-1)",
         "the gradient by t is the mean over x, y, z instead of the sum"),
    ],
    "15.13": [
        ("inside = distance < 0", "inside = distance <= 0", "0 counts as inside; it is outside"),
        ("[1, 2, 4, 8]", "[8, 4, 2, 1]", "the bits of a case are read in reverse"),
        (UNIQUE, "faces = np.arange(len(edge.ravel()))\n    edge = edge.ravel()",
         "each triangle has vertices of its own; tetrahedra share the points of their edges"),
        ("np.array([len(points), 1])", "np.array([1, len(points)])",
         "the outside end comes first"),
        (UNIQUE, UNIQUE + "\n    edge, faces = edge[::-1], len(edge) - 1 - faces",
         "edges descend; they are sorted by the inside end, then by the other"),
        ("distance[a], distance[b])", "-distance[b], -distance[a])",
         "the distances of both ends are swapped"),
        ("range(1, 15)", "range(1, 14)", "the last case, three vertices inside, is left out"),
        ("faces.reshape(-1, 3), np", "faces.reshape(-1, 3)[:, ::-1], np",
         "all faces are wound inward"),
        ("distance[a], distance[b])", "-np.ones(len(a)), np.ones(len(b)))",
         "vertices lie in the middle of their edges"),
    ],
}
