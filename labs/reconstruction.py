"""Reconstruction: what the fit of shape, albedo and light to pictures is made of.

    E(n) = sum_k Y_k(n) l_k,   k = 0 ... 8         light on a unit normal n = (x, y, z), where   (1)
    Y = C0, C1 y, C1 z, C1 x, C2 x y, C2 y z, C3 (3 z^2 - 1), C2 x z, C4 (x^2 - y^2)
    l_k = A_k Y_k(d) strength                      of a distant light in the direction d         (2)
    c = albedo * E(n),   albedo = albedo(p)        what leaves the surface, alike to all sides   (3)
    n_v = m / |m|,   m = sum of (b - a) x (c - a)  over the faces a, b, c at the vertex v        (4)
    L = mean (c - C)^2 + weight mean (o - O)^2     colours c, coverage o, targets C, O           (5)
    - sum of s / pixels, s = (1 - t) s_a + t s_b   carving: where the object is seen, and is not (6)
    H(s_a, s_b) + H(s_b, s_a) per crossed edge,    H(s, other) = log(1 + exp(-s sign(other)))    (7)
    (I + amount Laplacian)^-1 g                    a gradient spread over the grid               (8)
    genus = pieces - (V - E + F) / 2               holes through a closed surface                (9)

s are distances on lab 15's grid of G points. An edge is crossed where s_a < 0 <= s_b. The light
(9, C) has nine numbers for each colour. multi_view_fit.py joins these pieces.

Sources: lecture "Differentiable graphics 1" (its last part), Ramamoorthi and Hanrahan 2001 (1) and
(2), Shen et al. 2021 and Munkberg et al. 2022 (7), Nicolet et al. 2021 (8).
"""
import numpy as np
import scipy.fft
import scipy.sparse.csgraph

from course.given import mesh
from course.given.arrays import EDGES, scatter

from . import inverse_rendering

C0, C1, C2, C3, C4 = np.sqrt(np.array([1, 3, 15, 5 / 4, 15 / 4]) / (4 * np.pi))
A = np.pi * np.array([1, 2/3, 2/3, 2/3, 1/4, 1/4, 1/4, 1/4, 1/4])  # of eq. (2)

# --- light and shading: eq. (1) to (3) ----------------------------------------------------------


def sh_basis(normals):  # extra 16.1 (2 points)
    """The spherical harmonics Y_0 ... Y_8 of eq. (1): normals (..., 3) -> (..., 9).

    >>> (sh_basis(np.array([0.0, 0.6, 0.8])) / [C0, C1, C1, C1, C2, C2, C3, C2, C4]).round(9)
    array([ 1.  ,  0.6 ,  0.8 ,  0.  ,  0.  ,  0.48,  0.92,  0.  , -0.36])
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis_backward(grad_basis, normals):  # extra 16.2 (2 points)
    """Backward of `sh_basis`: grad_basis (..., 9) -> grad_normals (..., 3).

    n can move in all three directions, also along itself.

    >>> grad_basis = np.array([5.0, 0, 0, 0, 0, 1 / C2, 10 / C3, 0, 0])
    >>> sh_basis_backward(grad_basis, np.array([0.0, 0.6, 0.8])).round(9)
    array([ 0. ,  0.8, 48.6])
    """
    # The slopes of the nine polynomials with respect to x, y and z, each times its gradient g_k.
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)


def distant_light(towards, strength):
    """Eq. (2), summed over N lamps: nine numbers for each colour.

    towards (N, 3), unit directions to the lamps, strength (N, C) -> light (9, C).

    >>> light = distant_light(np.array([[0.0, 0.0, 1.0]]), np.array([[16.0]]))
    >>> (sh_basis(np.array([[0, 0, 1.0], [0, 1.0, 0], [0, 0, -1.0]])) @ light).round(9)[:, 0]
    array([17. ,  1.5,  1. ])
    """
    return A[:, None] * (sh_basis(towards).T @ strength)


def shade(albedo, normals, light):
    """Eq. (3), with E of eq. (1): what colour leaves each vertex?

    albedo (V, C), normals (V, 3), light (9, C) -> colours (V, C).

    >>> light = np.zeros((9, 2))
    >>> light[0], light[2] = [3 / C0, 2 / C0], [0.0, 1 / C1]
    >>> shade(np.array([[0.5, 0.5]]), np.array([[0.0, 0.6, 0.8]]), light).round(9)
    array([[1.5, 1.4]])
    """
    return albedo * (sh_basis(normals) @ light)


def shade_backward(grad_colour, albedo, normals, light):  # step 16.3
    """Backward of `shade`: grad_colour (V, C) -> grad_albedo (V, C), grad_normals (V, 3),
    grad_light (9, C). `sh_basis_backward` is of use. The demo `reconstruct` finds light by it.

    >>> light = np.zeros((9, 1))
    >>> light[0], light[2] = 3 / C0, 2 / C1
    >>> given = np.array([[0.5]]), np.array([[0.0, 0.6, 0.8]]), light
    >>> grad_albedo, grad_normals, grad_light = shade_backward(np.array([[10.0]]), *given)
    >>> grad_albedo.round(9), grad_normals.round(9), (grad_light[:3, 0] / [C0, C1, C1]).round(9)
    (array([[46.]]), array([[ 0.,  0., 10.]]), array([5., 3., 4.]))
    """
    raise NotImplementedError("exercise 16.3: shade_backward")


def vertex_normals_backward(grad_normals, vertices, faces):  # exercise 16.4 (6 points)
    """Backward of eq. (4), which is `course.given.mesh.vertex_normals`.

    grad_normals, vertices (V, 3), faces (F, 3) -> grad_vertices (V, 3). `mesh.area_vectors` gives
    the cross products. See `demo reconstruct`.

    >>> vertices = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> grad_normals = np.array([[8.0, 4.0, 7.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> vertex_normals_backward(grad_normals, vertices, np.array([[0, 1, 2]]))
    array([[ 0.,  0.,  8.],
           [ 0.,  0., -4.],
           [ 0.,  0., -4.]])

    Fine print. Where m is 0 (a vertex has no face, or its faces cancel), the normal is 0 and hands
    nothing back. One nan would spread over the whole surface.
    """
    raise NotImplementedError("exercise 16.4: vertex_normals_backward")


# --- what the pictures say: eq. (5) and (6) -----------------------------------------------------


def picture_loss(picture, target, weight):  # step 16.5
    """Eq. (5), of one picture or several of one size -> the loss, a number, and grad_picture
    (..., 4).

    picture, target (..., 4): red, green, blue, and how much of the pixel is covered. Each mean is
    over its own numbers: three times as many are of colour.

    >>> picture, target = np.array([[[1.0, 2, 3, 1.0]]]), np.array([[[1.0, 2, 0, 0.5]]])
    >>> picture_loss(picture, target, 4.0)
    (np.float64(4.0), array([[[0., 0., 2., 4.]]]))
    """
    raise NotImplementedError("exercise 16.5: picture_loss")


def level_backward(grad_level, ends, distance):  # extra 16.6 (2 points)
    """Backward of s at the vertices, eq. (6), with t held: grad_level (V,) -> grad_distance (G,).

    distance (G,), ends (V, 2): vertex v lies where s = 0 between the grid's points a, b = ends[v].

    >>> level_backward(np.array([10.0, 1.0]), np.array([[0, 1], [0, 2]]), np.array([-1.0, 4, 1]))
    array([8.5, 2. , 0.5])
    """
    # With t held, ds = (1 - t) ds_a + t ds_b. Several vertices can share an end.
    s_a, s_b = distance[ends.T]
    t = s_a / (s_a - s_b)
    shares = np.stack([(1 - t) * grad_level, t * grad_level], -1)
    return scatter(shares, ends, len(distance))


# --- what every surface should be: eq. (7), and no bumps ----------------------------------------


def sign_changes(distance, edges):  # exercise 16.7 (3 points)
    """Eq. (7): what do the changes of sign cost in all? -> price, grad_distance (G,)

    distance (G,), edges (E, 2), either end first. The edges that are crossed stay crossed. See
    `demo reconstruct`.

    >>> distance, edges = np.array([-np.log(3), np.log(3), 0.0]), np.array([[0, 1], [2, 0], [1, 2]])
    >>> price, grad_distance = sign_changes(distance, edges)
    >>> np.exp(price).round(9), grad_distance.round(9)
    (np.float64(128.0), array([-1.5 ,  0.75,  0.5 ]))

    Fine print. A distance of 0 has the sign +, as in lab 15, so that no edge has a third kind of
    end, and the slope of a small positive one. Large distances such as 1000 do not overflow.
    """
    raise NotImplementedError("exercise 16.7: sign_changes")


def closed_mesh_edges(faces):
    """The edges (E, 2) of a closed mesh, each once: it is walked once up and once down."""
    sides = faces[:, EDGES].reshape(-1, 2)
    return sides[sides[:, 0] < sides[:, 1]]


def bumps(vertices, normals, edges):
    """How far vertices stand out from the mean of their neighbours: a mean of squares.

    vertices, normals (V, 3), edges (E, 2). Only the part along the normal counts. The rest is how
    marching tetrahedra spread the vertices over the surface, and says nothing of its shape.
    """
    return ((inverse_rendering.uniform_laplacian(vertices, edges) * normals).sum(1)**2).mean()


def bumps_backward(grad_bumps, vertices, normals, edges):
    """Backward of `bumps`, normals held: grad_bumps, a number -> grad_vertices (V, 3)."""
    # With h = d . n at each of V vertices: dL = 2 / V h n . dd, and back through the Laplacian d.
    out = (inverse_rendering.uniform_laplacian(vertices, edges) * normals).sum(1, keepdims=True)
    grad_laplacian = 2 * grad_bumps / len(vertices) * out * normals
    return inverse_rendering.uniform_laplacian_backward(grad_laplacian, vertices, edges)


# --- the step: eq. (8) --------------------------------------------------------------------------


def spread(x, amount):  # extra 16.8 (4 points)
    """Eq. (8): y with y + amount * Laplacian(y) = x on a grid of m^3 points.

    x (G,) or (G, C), in `tetrahedral_grid`'s order -> y. The Laplacian sums y - y' over the
    neighbours along the axes. Of m numbers in a row it multiplies `scipy.fft.dctn`'s coefficient k,
    with norm="ortho", by 2 - 2 cos(pi k / m).

    >>> spread(np.array([105.0, 0, 0, 0, 0, 0, 0, 0]), 1.0).round(6)
    array([36., 13., 13.,  8., 13.,  8.,  8.,  6.])
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients /= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def genus(faces):  # extra 16.10 (2 points)
    """Eq. (9): of a closed mesh, faces (F, 3) -> how many pieces it has, and its genus.

    V counts the vertices that some face names, E each edge once. Pieces share no vertex. The genus
    of several pieces is their sum.

    >>> genus(np.array([[0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 0, 4]]))
    (1, 0)
    """
    named, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(faces, len(named)))
    # Each face has 3 halves of edges.
    return int(pieces), int(pieces - (len(named) - len(faces) // 2) // 2)


def best_scale(found, truth):
    """By what factor for each colour does found come nearest to truth, in the least squares?

    found, truth (V, C) -> (C,). Half the albedo in twice the light is the same picture, so nobody
    can know these factors.

    >>> best_scale(np.array([[1.0, 2.0], [3.0, 0.0]]), np.array([[2.0, 1.0], [6.0, 5.0]]))
    array([2. , 0.5])
    """
    return (found * truth).sum(0) / (found**2).sum(0)
