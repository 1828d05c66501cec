"""Reconstruction: what the fit of shape, albedo and light to pictures is made of.

    E(n) = sum_k Y_k(n) l_k,   k = 0 ... 8         light on a unit normal, order 2               (1)
    l_k = A_k Y_k(d) strength                      of a distant light in the direction d         (2)
    c = albedo * E(n),   albedo = albedo(p)        what leaves the surface, alike to all sides   (3)
    n_v = m / |m|,   m = sum of (b - a) x (c - a)  over the faces a, b, c at the vertex v        (4)
    L = mean (c - C)^2 + weight mean (o - O)^2     colours c, coverage o, targets C, O           (5)
    - sum of s / pixels, s = (1 - t) s_a + t s_b   carving: where the object is seen, and is not (6)
    H(s_a, s_b) + H(s_b, s_a) per crossed edge,    H(s, other) = log(1 + exp(-s sign(other)))    (7)
    (I + amount Laplacian)^-1 g                    a gradient spread over the grid               (8)
    genus = pieces - (V - E + F) / 2               holes through a closed surface                (9)

s are distances on lab 15's grid of G points, s_a < 0 <= s_b those at the ends of a crossed edge.
The light (9, C) has nine numbers for each colour. It comes from far away and casts no shadows.
multi_view_fit.py joins these pieces.

Sources: lecture "Differentiable graphics 1" (its last part), Ramamoorthi and Hanrahan 2001 (1) and
(2), Shen et al. 2021 and Munkberg et al. 2022 (7), Nicolet et al. 2021 (8).
"""
import numpy as np
import scipy.fft
import scipy.sparse.csgraph

from course.given import mesh

from . import inverse_rendering
from .rasterization import scatter

C0, C1, C2, C3, C4 = np.sqrt(np.array([1, 3, 15, 5 / 4, 15 / 4]) / (4 * np.pi))
A = np.pi * np.array([1, 2/3, 2/3, 2/3, 1/4, 1/4, 1/4, 1/4, 1/4])  # of eq. (2)

# --- light and shading: eq. (1) to (3) ----------------------------------------------------------


def sh_basis(normals):  # exercise 16.1 (2 points)
    """Y_0 ... Y_8 of eq. (1), spherical harmonics: normals (..., 3), n = (x, y, z) -> (..., 9).

    C0,  C1 y, C1 z, C1 x,  C2 x y, C2 y z, C3 (3 z^2 - 1), C2 x z, C4 (x^2 - y^2). These nine
    polynomials are meant also where n is not of unit length.

    >>> (sh_basis(np.array([0.0, 0.6, 0.8])) / [C0, C1, C1, C1, C2, C2, C3, C2, C4]).round(9)
    array([ 1.  ,  0.6 ,  0.8 ,  0.  ,  0.  ,  0.48,  0.92,  0.  , -0.36])
    """
    raise NotImplementedError("exercise 16.1: sh_basis")


def sh_basis_backward(grad_basis, normals):  # exercise 16.2 (2 points)
    """Backward of `sh_basis`: grad_basis (..., 9) -> grad_normals (..., 3).

    x, y and z count as free, so that the gradient need not be at right angles to n.

    >>> grad_basis = np.array([5.0, 0, 0, 0, 0, 1 / C2, 10 / C3, 0, 0])
    >>> sh_basis_backward(grad_basis, np.array([0.0, 0.6, 0.8])).round(9)
    array([ 0. ,  0.8, 48.6])
    """
    raise NotImplementedError("exercise 16.2: sh_basis_backward")


def distant_light(towards, strength):  # exercise 16.3 (2 points)
    """Eq. (2): the light of distant lamps together, as nine numbers for each colour.

    towards (N, 3), unit directions to N lamps, strength (N, C) -> light (9, C). A is given above.
    With it, a surface that faces a lamp of strength 1 gets not 1, but 17/16: order 2 comes near the
    lamp's true max(n . d, 0) for all n in the mean of squares, and goes a little below 0 about 120
    degrees from the lamp.

    >>> light = distant_light(np.array([[0.0, 0.0, 1.0]]), np.array([[16.0]]))
    >>> (sh_basis(np.array([[0, 0, 1.0], [0, 1.0, 0], [0, 0, -1.0]])) @ light).round(9)[:, 0]
    array([17. ,  1.5,  1. ])
    """
    raise NotImplementedError("exercise 16.3: distant_light")


def shade(albedo, normals, light):  # exercise 16.4 (1 point)
    """Eq. (3) with (1): albedo (V, C), normals (V, 3) of unit length, light (9, C) -> (V, C).

    >>> light = np.zeros((9, 2))
    >>> light[0], light[2] = [3 / C0, 2 / C0], [0.0, 1 / C1]
    >>> shade(np.array([[0.5, 0.5]]), np.array([[0.0, 0.6, 0.8]]), light).round(9)
    array([[1.5, 1.4]])
    """
    raise NotImplementedError("exercise 16.4: shade")


def shade_backward(grad_colour, albedo, normals, light):  # exercise 16.5 (3 points)
    """Backward of `shade`: grad_colour (V, C) -> grad_albedo (V, C), grad_normals (V, 3),
    grad_light (9, C). The normals count as free.

    >>> light = np.zeros((9, 1))
    >>> light[0], light[2] = 3 / C0, 2 / C1
    >>> given = np.array([[0.5]]), np.array([[0.0, 0.6, 0.8]]), light
    >>> grad_albedo, grad_normals, grad_light = shade_backward(np.array([[10.0]]), *given)
    >>> grad_albedo.round(9), grad_normals.round(9), (grad_light[:3, 0] / [C0, C1, C1]).round(9)
    (array([[46.]]), array([[ 0.,  0., 10.]]), array([5., 3., 4.]))
    """
    raise NotImplementedError("exercise 16.5: shade_backward")


def vertex_normals_backward(grad_normals, vertices, faces):  # exercise 16.6 (4 points)
    """Backward of eq. (4), which is `course.given.mesh.vertex_normals`.

    grad_normals, vertices (V, 3), faces (F, 3) -> grad_vertices (V, 3). Where m is 0 (a vertex has
    no face, or its faces cancel), the normal is 0 and hands nothing back. A longer m gives the same
    normal: grad_m is at right angles to it.

    >>> vertices = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> grad_normals = np.array([[8.0, 4.0, 7.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    >>> vertex_normals_backward(grad_normals, vertices, np.array([[0, 1, 2]]))
    array([[ 0.,  0.,  8.],
           [ 0.,  0., -4.],
           [ 0.,  0., -4.]])
    """
    raise NotImplementedError("exercise 16.6: vertex_normals_backward")


# --- what the pictures say: eq. (5) and (6) -----------------------------------------------------


def picture_loss(picture, target, weight):  # exercise 16.7 (1 point)
    """Eq. (5): the mean of squared differences of colour, and weight times that of coverage.

    picture, target (H, W, 4): red, green, blue, and how much of the pixel is covered -> a number.
    Each of the two is a mean over its own numbers, 3 H W of colour and H W of coverage.

    >>> picture, target = np.array([[[1.0, 2, 3, 1.0]]]), np.array([[[1.0, 2, 0, 0.5]]])
    >>> float(picture_loss(picture, target, 4.0))
    4.0
    """
    raise NotImplementedError("exercise 16.7: picture_loss")


def picture_loss_backward(grad_loss, picture, target, weight):  # exercise 16.8 (1 point)
    """Backward of eq. (5): grad_loss, a number -> grad_picture (H, W, 4).

    >>> picture, target = np.array([[[1.0, 2, 3, 1.0]]]), np.array([[[1.0, 2, 0, 0.5]]])
    >>> picture_loss_backward(10.0, picture, target, 4.0)
    array([[[ 0.,  0., 20., 40.]]])
    """
    raise NotImplementedError("exercise 16.8: picture_loss_backward")


def level_backward(grad_level, ends, distance):  # exercise 16.9 (2 points)
    """Backward of s at the vertices, eq. (6): grad_level (V,) -> grad_distance (G,).

    ends (V, 2), distance (G,): vertex v lies between the points a, b = ends[v] of the grid, where
    s = 0. Its place p = (1 - t) p_a + t p_b is held, and with it t. But s there changes, as the
    distances of a and b do. (Were p not held, s would stay 0.)

    >>> level_backward(np.array([10.0, 1.0]), np.array([[0, 1], [0, 2]]), np.array([-1.0, 4, 1]))
    array([8.5, 2. , 0.5])
    """
    raise NotImplementedError("exercise 16.9: level_backward")


# --- what every surface should be: eq. (7), and no bumps ----------------------------------------


def sign_changes(distance, edges):  # exercise 16.10 (2 points)
    """Eq. (7), summed over all edges that are crossed: the less surface, the less it is.

    distance (G,), here in cells of the grid, edges (E, 2), pairs of points -> a number. An edge is
    crossed if one of its ends is inside, s < 0, and the other is not. 0 has the sign +. Large
    numbers, such as 1000, are no trouble.

    >>> round(sign_changes(np.array([-1.0, 2.0, 0.5]), np.array([[0, 1], [1, 2], [2, 0]])), 6)
    np.float64(5.727528)
    """
    raise NotImplementedError("exercise 16.10: sign_changes")


def sign_changes_backward(grad_changes, distance, edges):  # exercise 16.11 (3 points)
    """Backward of eq. (7): grad_changes, a number -> grad_distance (G,). Which are crossed is held.

    A distance of 0 changes as a small positive one would.

    >>> sign_changes_backward(2.0, np.array([-np.log(3), np.log(3), 0.0]),
    ...                       np.array([[0, 1], [1, 2], [2, 0]])).round(9)
    array([-3. ,  1.5,  1. ])
    """
    raise NotImplementedError("exercise 16.11: sign_changes_backward")


def bumps(vertices, normals, edges):
    """How far vertices stand out from the mean of their neighbours: a mean of squares.

    normals (V, 3), edges (E, 2). Only the part along the normal counts: the rest is how marching
    spreads the vertices over the surface, and no matter of shape.
    """
    return ((inverse_rendering.uniform_laplacian(vertices, edges) * normals).sum(1)**2).mean()


def bumps_backward(grad_bumps, vertices, normals, edges):
    """Backward of `bumps`, normals held: grad_bumps, a number -> grad_vertices (V, 3)."""
    # With h = d . n at each of V vertices: dL = 2 / V h n . dd, and back through the Laplacian d.
    out = (inverse_rendering.uniform_laplacian(vertices, edges) * normals).sum(1, keepdims=True)
    grad_laplacian = 2 * grad_bumps / len(vertices) * out * normals
    return inverse_rendering.uniform_laplacian_backward(grad_laplacian, vertices, edges)


# --- the step: eq. (8) --------------------------------------------------------------------------


def spread(x, amount):  # exercise 16.12 (4 points)
    """Eq. (8): the y with y + amount * Laplacian(y) = x, on a grid. Its sum is that of x.

    x (G,) or (G, C): numbers on a grid of m^3 = G points, in the order of `tetrahedral_grid`, and
    amount >= 0 -> y, of the shape of x. Laplacian(y) at a point is the sum of y - y' over its
    neighbours y' along the three axes: 6 of them, fewer at the border. A sparse solve is slow for
    m = 49. But cosines diagonalise the Laplacian: of m numbers in a row, it multiplies coefficient
    k = 0 ... m - 1 by 2 - 2 cos(pi k / m). `scipy.fft.dctn` and `idctn` with norm="ortho" go there
    and back, along the axes that they are given.

    >>> spread(np.array([105.0, 0, 0, 0, 0, 0, 0, 0]), 1.0).round(6)
    array([36., 13., 13.,  8., 13.,  8.,  8.,  6.])
    """
    raise NotImplementedError("exercise 16.12: spread")


def genus(faces):  # exercise 16.13 (2 points)
    """Eq. (9) of a closed mesh: faces (F, 3) -> pieces, genus, two integers.

    Every edge has two faces, and every vertex one fan of them. pieces: how many parts hang together
    by vertices that they share. V counts those that some face names, E each edge once. A ball has
    genus 0, a ring 1. For several pieces it is the sum.

    >>> genus(np.array([[0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 0, 4]]))
    (1, 0)
    """
    raise NotImplementedError("exercise 16.13: genus")


def best_scale(found, truth):  # exercise 16.14 (1 point)
    """By what factors (C,) does found come nearest to truth? Both (V, C), least squares.

    No column of found is 0 throughout. (Half the albedo and twice the light are the same picture:
    one factor for each colour is what nobody can know.)

    >>> best_scale(np.array([[1.0, 2.0], [3.0, 0.0]]), np.array([[2.0, 1.0], [6.0, 5.0]]))
    array([2. , 0.5])
    """
    raise NotImplementedError("exercise 16.14: best_scale")
