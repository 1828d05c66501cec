"""The figure of lecture 10: four gradients of one outline."""
import numpy as np
import pytest
from reading import numbers, opened, point_of, settled

from reference import (
    neural_renderer,
    outlines,
    rasterization,
    sampling,
    scanline,
    soft_rasterizer,
    sweep_gradient,
)

WIDTH, HEIGHT = 16, 8
FACE, OPPOSITE = np.array([[0, 1, 2]]), np.array([[-1, -1, -1]])


def triangles():
    """Counter-clockwise, on quarters of pixels and anywhere, some of them partly off the screen."""
    rng = np.random.default_rng(10)
    points = rng.uniform([-2, -2], [WIDTH + 2, HEIGHT + 2], (60, 3, 2))
    points[:30] = np.round(points[:30] * 4) / 4
    turned = rasterization.signed_area(points) < 0
    points[turned] = points[turned, ::-1]
    return points[rasterization.signed_area(points) > 0.5]


def clip_of(points, size=(WIDTH, HEIGHT)):
    return np.column_stack([2 * points / size - 1, np.zeros(3), np.ones(3)])


def cases():
    """Triangles, hard pictures of them, and gradients of a loss by a picture."""
    points = triangles()
    seen = np.array([scanline.rasterize(clip_of(p), FACE, WIDTH, HEIGHT)[0] for p in points])
    return points, seen, np.random.default_rng(3).normal(size=seen.shape)


def test_the_exact_coverage_and_its_gradient_are_those_of_the_reference(agrees):
    """A pixel is one to the left, or a piece on a border counts in no pixel."""
    points, _, grad = cases()
    agrees("pixel_coverage", "pixelCoverage", [(p, WIDTH, HEIGHT) for p in points],
           [sampling.pixel_coverage(p, WIDTH, HEIGHT) for p in points])
    both = list(zip(grad, points, strict=True))
    agrees("pixel_coverage", "pixelCoverageBackward", [(g.ravel(), p, WIDTH) for g, p in both],
           [sampling.pixel_coverage_backward(g, p) for g, p in both])


@pytest.mark.parametrize("eps", [1e-4, 1e-2, 0.1])
def test_the_sweep_is_that_of_the_reference(agrees, eps):
    """The outside of an edge is taken for its inside, or columns for rows."""
    each = list(zip(*cases(), strict=True))
    agrees("outline_gradients", "sweepBackward",
           [(g.ravel(), (face + 1).ravel(), p, WIDTH, HEIGHT, eps) for p, face, g in each],
           [sweep_gradient.sweep_backward(g[..., None], face[..., None] + 1.0, face,
                                          neural_renderer.corners_of(clip_of(p), FACE),
                                          eps)[0, :, :2] for p, face, g in each])


@pytest.mark.parametrize("sigma", [0.05, 0.5, 5.0])
def test_the_soft_picture_is_that_of_the_reference(agrees, sigma):
    """The inside is as pale as the outside, or an end gets the other end's gradient."""
    points, _, grad = cases()
    agrees("outline_gradients", "softSilhouette", [(p, WIDTH, HEIGHT, sigma) for p in points],
           [soft_rasterizer.soft_silhouette(p[None], WIDTH, HEIGHT, sigma) for p in points])
    both = list(zip(grad, points, strict=True))
    agrees("outline_gradients", "softSilhouetteBackward",
           [(g.ravel(), p, WIDTH, sigma) for g, p in both],
           [soft_rasterizer.soft_silhouette_backward(g, p[None], sigma)[0] for g, p in both])


def test_the_blend_is_that_of_the_reference(call):
    """A pair of pixels above each other is turned, an edge's gradient goes to the wrong end, or
    one half-way between two centres has a gradient of the side that the reference drops."""
    points, _, grad = cases()
    found = call("blended", "render", [(p, WIDTH, HEIGHT) for p in points])
    back = call("blended", "renderBackward",
                [(g.ravel(), one["pairs"]) for g, one in zip(grad, found, strict=True)])
    for p, g, one, gradient in zip(points, grad, found, back, strict=True):
        clip = clip_of(p)
        edges = *scanline.rasterize(clip, FACE, WIDTH, HEIGHT), clip, FACE, OPPOSITE
        hard = (edges[0] + 1.0)[..., None]
        np.testing.assert_allclose(one["picture"], outlines.antialias(hard, *edges).ravel(),
                                   atol=1e-9)
        wanted = outlines.antialias_backward(g[..., None], hard, *edges)[1][:, :2]
        np.testing.assert_allclose(gradient, wanted * [2 / WIDTH, 2 / HEIGHT], atol=1e-9)


START = np.array([[7.0, 2.5], [14.0, 4.75], [9.0, 11.25]])
GOAL = START + [8, 0]


def pulls_by_reference(points, eps, sigma):
    """How strongly truth, sweep, soft and blend pull towards the goal, in 24 x 14 pixels."""
    size = width, height = 24, 14
    target = sampling.pixel_coverage(GOAL, width, height)
    way = GOAL.mean(0) - points.mean(0)
    clip = clip_of(points, size)
    truth = sampling.pixel_coverage_backward(
        2 * (sampling.pixel_coverage(points, width, height) - target), points)
    seen, depth = scanline.rasterize(clip, FACE, width, height)
    hard = seen + 1.0
    corners = neural_renderer.corners_of(clip, FACE)
    sweep = sweep_gradient.sweep_backward((2 * (hard - target))[..., None], hard[..., None], seen,
                                          corners, eps)[0, :, :2] * 2 / size
    soft = soft_rasterizer.soft_silhouette(points[None], width, height, sigma)
    soft = soft_rasterizer.soft_silhouette_backward(2 * (soft - target), points[None], sigma)[0]
    edges = seen, depth, clip, FACE, OPPOSITE
    smooth = outlines.antialias(hard[..., None], *edges)
    blend = outlines.antialias_backward(2 * (smooth - target[..., None]), hard[..., None],
                                        *edges)[1][:, :2] * 2 / size
    return [-(g @ way).sum() / np.linalg.norm(way) for g in (truth, sweep, soft, blend)]


def shown_pulls(page):
    return numbers(" ".join(settled(page).locator(".four b").all_inner_texts()))


def test_the_triangle_shows_the_pulls_of_the_reference(page, address):
    """The pulls are those of the place before, of an ascent, or of another setting."""
    opened(page, address, "four_gradients")
    points, whole = START.copy(), page.get_by_role("slider", name="The triangle")
    for eps, sigma in ((1e-2, 5.0), (1e-1, 0.5)):
        page.get_by_role("button", name="sweep").click()
        page.get_by_role("slider", name="log₁₀ ε").fill(str(np.log10(eps)))
        page.get_by_role("button", name="soft").click()
        page.get_by_role("slider", name="\N{GREEK SMALL LETTER SIGMA}").fill(str(sigma))
        for _ in range(3):
            np.testing.assert_allclose(shown_pulls(page), pulls_by_reference(points, eps, sigma),
                                       atol=0.5001)
            whole.press("Shift+ArrowRight")
            points += [1, 0]
        settled(page).get_by_role("slider", name="Vertex 2").press("ArrowUp")
        points[2, 1] += 0.25
    np.testing.assert_allclose(shown_pulls(page), pulls_by_reference(points, 0.1, 0.5),
                               atol=0.5001)


def test_the_triangle_stays_whole_in_the_picture(page, address):
    """At the border it is squeezed, or its vertices are turned round."""
    opened(page, address, "four_gradients")
    whole, vertex = (page.get_by_role("slider", name=name) for name in ("The triangle", "Vertex 2"))
    for _ in range(10):
        whole.press("Shift+ArrowDown")
    assert point_of(vertex) == [9, 8.75]
    for _ in range(12):
        vertex.press("Shift+ArrowDown")
    assert rasterization.signed_area(np.array([[7, 0], [14, 2.25], point_of(vertex)])) > 2
