"""The grid of signs: where its outline runs, and what comes back to its numbers."""
import numpy as np
from hands import spot
from reading import opened, settled

from reference import implicit_surfaces, marching_tetrahedra


def test_the_ring_and_the_crossings_are_those_of_the_reference(agrees):
    """The crossing is nearer to the wrong end, or its gradient has the other's sign."""
    rng = np.random.default_rng(15)
    points = rng.normal(size=(50, 2))
    flat = np.insert(points, 2, 0, axis=1)
    agrees("sign_grid", "torus", [(p, 0.7, 0.3) for p in points],
           implicit_surfaces.torus(flat, 0.7, 0.3))
    p_a, p_b, grad_p = rng.normal(size=(3, 50, 3))
    s_a, s_b = -rng.uniform(0.1, 1, 50), rng.uniform(0, 1, 50)
    cases = list(zip(p_a, p_b, s_a, s_b, strict=True))
    agrees("sign_grid", "zeroCrossing", cases,
           marching_tetrahedra.zero_crossing(p_a, p_b, s_a, s_b))
    wanted = marching_tetrahedra.zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b)[2:]
    agrees("sign_grid", "zeroCrossingBackward",
           [(g, *case) for g, case in zip(grad_p, cases, strict=True)], np.transpose(wanted))


def outline(call, distance):
    found, = call("sign_grid", "marchingTriangles", [(distance,)])
    return found["vertices"], found["segments"]


def area(vertices, segments):
    p, q = (np.array([vertices[s[end]]["p"] for s in segments]) for end in (0, 1))
    return ((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]) / 2).sum()


def test_the_outline_is_closed_and_has_the_inside_on_its_left(call):
    """A case of a triangle is turned, or two triangles do not share a vertex."""
    rng = np.random.default_rng(3)
    grid = np.ones((17, 25))
    grid[1:-1, 1:-1] = rng.normal(size=(15, 23))
    vertices, segments = outline(call, grid.ravel())
    assert len(vertices) > 300
    begins, ends = np.transpose(segments)
    every = np.arange(len(vertices))
    assert (np.sort(begins) == every).all() and (np.sort(ends) == every).all()
    assert 0 < area(vertices, segments) < 24 * 16 / 64


def test_the_areas_gradient_is_that_of_the_area(call):
    """The two segments of a vertex pull in opposite directions."""
    x, y = np.meshgrid((np.arange(25) - 12) / 8, (np.arange(17) - 8) / 8)
    vertices, segments = outline(call, (np.hypot(x, y) - 0.83).ravel())
    assert abs(area(vertices, segments) - np.pi * 0.83**2) < 0.03
    gradient, = call("sign_grid", "areaBackward", [(vertices, segments)])
    for n in 0, 7, 30:
        for axis in 0, 1:
            before, h = vertices[n]["p"][axis], 1e-4
            areas = []
            for vertices[n]["p"][axis] in before + h, before - h, before:
                areas.append(area(vertices, segments))
            assert np.isclose(gradient[n][axis], (areas[0] - areas[1]) / (2 * h), atol=1e-9)


def test_a_flip_makes_a_hole_and_play_two_pieces_of_one(page, address):
    """The sentence counts the pieces where two closed lines are seen. The outline shrinks to
    nothing, or a flipped sign is forgotten."""
    opened(page, address, "sign_grid")
    assert "1 piece" in page.inner_text(".told") and "One outline" in page.inner_text(".told")
    chosen = page.get_by_role("slider", name="Grid point")
    page.mouse.click(*spot(chosen))
    told = settled(page).inner_text(".told")
    assert "1 piece" in told and "2 outlines" in told
    page.get_by_role("button", name="Reset").click()
    page.get_by_role("button", name="Play").click()
    page.get_by_text("2 pieces").wait_for(timeout=60_000)
    page.get_by_role("button", name="Pause").click()
    for key in 6 * ["ArrowUp"] + ["Enter"]:
        chosen.press(key)
    assert "3 pieces" in settled(page).inner_text(".told")
