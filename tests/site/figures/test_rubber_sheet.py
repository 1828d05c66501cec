"""The rubber sheet: a pixel's derivatives, and what it sees when a vertex moves."""
import re

import numpy as np
from hands import spot
from reading import MINUS, opened, settled, verdict

from reference import rasterization, rasterizer_gradients, vertex_gradients

VALUES, PIXEL = np.array([0.9, 0.1, 0.4]), np.array([[6.5, 5.5]])


def test_the_edge_functions_are_those_of_the_reference(agrees):
    """Two vertices are exchanged, or a triangle without area has no edges."""
    rng = np.random.default_rng(7)
    triangles = rng.uniform(0, 16, (60, 3, 2))
    triangles[0, 2] = triangles[0, :2].mean(0)
    triangles[1] = triangles[1, :1]
    points = rng.uniform(0, 16, (60, 2))
    matrices = np.stack([vertex_gradients.vertex_matrix(each) for each in triangles], -1)
    agrees("rubber_sheet", "edgeNormals", [(t,) for t in triangles],
           np.moveaxis(rasterizer_gradients.edge_normals(matrices), -1, 0))
    agrees("rubber_sheet", "edgeFunctionsAt", list(zip(points, triangles, strict=True)),
           rasterization.edge_functions_at(*points.T, *triangles.T).T)


def test_the_derivatives_are_those_of_the_reference(call):
    """The arrow points uphill in the picture, or has the weight of another vertex."""
    rng = np.random.default_rng(8)
    triangles = rng.uniform(0, 16, (40, 3, 2))  # half of them clockwise
    triangles[0] = [[1, 1], [15, 1], [8, 1 + 1e-3]]
    points = rng.uniform(0, 16, (40, 5, 2))
    cases = list(zip(rng.uniform(size=(40, 3)), triangles, points, strict=True))
    for case, found in zip(cases, call("rubber_sheet", "residualsJacobian", cases), strict=True):
        for part, wanted in zip(found, vertex_gradients.residuals_jacobian(*case), strict=True):
            np.testing.assert_allclose(part, wanted, rtol=1e-9, atol=1e-9)


def told(page):
    """What the pixel saw, sees, changed by, and what the arrow said."""
    text = settled(page).inner_text(".told").replace(MINUS, "-")
    return [float(t) for t in re.findall(r"[+-]?\d\.\d{3}", text)[:4]]


def test_the_pixel_changes_as_the_arrow_says(page, address):
    """The arrow is that of the triangle after the move, or the pixel goes with the sheet."""
    opened(page, address, "rubber_sheet")
    handle = page.locator(".handle:text-is('1')")
    for key in ["ArrowRight"] * 6 + ["ArrowUp"] * 3:
        handle.press(key)
    was, now, change, said = told(page)
    triangle = np.array([[2.5, 2.5], [13.0, 4.0], [5.5, 10.5]])
    weights, gradients = vertex_gradients.residuals_jacobian(VALUES, triangle, PIXEL)
    assert np.isclose(was, weights[0] @ VALUES, atol=6e-4)
    assert np.isclose(said, gradients[0, 1] @ [0.6, 0.3], atol=6e-4)
    assert 0 <= said - change < 0.002 and np.isclose(now - was, change, atol=2e-3)
    assert "0.29 · 0.67 = 0.19" in page.inner_text(".verdict")


def test_the_chosen_pixel_stays_until_another_is_chosen(page, address):
    """A mouse on its way to a vertex takes the pixel along, or one outside has arrows."""
    opened(page, address, "rubber_sheet")
    before = page.inner_text(".told")
    page.mouse.move(*spot(page.locator(".sheet")))
    assert settled(page).inner_text(".told") == before
    assert page.locator(".sheet polygon.pull").count() == 3
    probe = page.get_by_role("slider", name="Pixel")
    probe.press("Shift+ArrowUp")
    probe.press("Shift+ArrowLeft")
    assert "does not see" in verdict(page)
    assert page.locator(".sheet polygon.pull").count() == 0
