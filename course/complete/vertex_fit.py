"""Vertex fit: the mesh that a multi-view fit has found, its vertices moved to meet the pictures.

    vertices, colours -> pictures -> loss     lab 9's pipeline, the loss (5) of reconstruction.py
    vertices <- (I + Laplacian)^-1 gradient   lab 13's large steps: see its (10), with lambda = 1

The grid of multi_view_fit.py has found the topology. Its cells are wider than a pixel, so that the
surface is uneven by a fifth of one. Here the faces stay, and each vertex goes where outlines and
colours send it. Where no picture says more, bumps decide. Vertices have the colours that pictures
show, (10) of intrinsic_decomposition.py, and no light: what (1) lacks would become dents.

Sources: Munkberg et al. 2022 (their second pass), Nicolet et al. 2021.
"""
from typing import NamedTuple

import numpy as np
import scipy.sparse.linalg

from course.given import mesh

from . import intrinsic_decomposition, pipeline, reconstruction, regularization
from .inverse_rendering import decay, descend
from .multi_view_fit import UNIFORM_ADAM, render_views, render_views_backward, targets_of


class Skin(NamedTuple):
    """The unknowns, or one thing for each of them: vertices, colours (V, 3)."""

    vertices: np.ndarray
    colours: np.ndarray


BUMPS = 0.02                              # weight beside the loss, lengths in those of an edge
RATES = Skin(vertices=1.0, colours=0.05)  # the first in lengths of an edge
LEFT = 0.1                                # of the rates, at the end
PER_STEP = 4                              # views


def loss_and_gradients(x, faces, views, bumps):
    """Eq. (5) of the Targets `views`, and a Skin of gradients, also of bumps times their weight."""
    shape = pipeline.make_mesh(x.vertices, faces)
    targets = np.stack([view.picture for view in views])
    pictures, buffers = render_views(shape, x.colours, views)
    loss, grad_pictures = reconstruction.picture_loss(pictures, targets, 1.0)

    grad_vertices, grad_colours, _ = render_views_backward(grad_pictures, buffers, shape, x.colours,
                                                           views)
    by_bumps = reconstruction.bumps_backward(
        bumps, x.vertices, mesh.vertex_normals(x.vertices, faces),
        reconstruction.closed_mesh_edges(faces))
    return loss, Skin(grad_vertices + by_bumps, grad_colours)


def large_steps(edges, vertex_count):
    """-> update, lab 13's `large_step` with weights and lambda 1, for edges (E, 2) that stay.

    So one factorization does for all steps.
    """
    system = scipy.sparse.eye_array(vertex_count) + regularization.laplacian(
        edges, np.ones(len(edges)), vertex_count)
    solve = scipy.sparse.linalg.factorized(system.tocsc())

    def update(x, grad_x, mean, square, step, rate):
        # (10) is linear: when u moves by d, x moves by (I + L)^-1 d.
        d, mean, square = UNIFORM_ADAM(np.zeros(x.shape), solve(grad_x), mean, square, step, rate)
        return x + solve(d), mean, square
    return update


def fit_vertices(surface, capture, steps=100, samples=4):
    """Yields a Surface, its albedo the colours seen, after each step, and the loss before it.

    surface is that of multi_view_fit.py, capture its Capture. Each step looks at PER_STEP views,
    with samples^2 a pixel.
    """
    rng = np.random.default_rng(0)
    targets = targets_of(capture, 1, samples)
    edges = reconstruction.closed_mesh_edges(surface.faces)
    a, b = surface.vertices[edges.T]
    length = np.linalg.norm(a - b, axis=1).mean()

    def gradient(x):
        drawn = [targets[k] for k in rng.permutation(len(targets))[:PER_STEP]]
        return loss_and_gradients(x, surface.faces, drawn, BUMPS / length**2)

    schedule = [Skin(length * rate * RATES.vertices, rate * RATES.colours)
                for rate in decay(1.0, LEFT, steps)]
    update = Skin(large_steps(edges, len(surface.vertices)), UNIFORM_ADAM)
    colours, _ = intrinsic_decomposition.seen_colours(surface, targets_of(capture, 1, 1))
    for x, loss in descend(Skin(surface.vertices, colours), gradient, schedule, update):
        yield surface._replace(vertices=x.vertices, albedo=x.colours,
                               normals=mesh.vertex_normals(x.vertices, surface.faces)), loss
