"""What a figure shows of several formulas together: the numbers and colours on the page."""
import numpy as np
from reading import numbers, opened, point_of, settled

from reference import antialiasing, outlines


def test_an_edge_that_moves_shows_the_references_gradient(page, address):
    """The gradient is shown of the edge before it moved, or of the other pixel; or it is not 0
    where c is clamped, or where nothing is blended."""
    opened(page, address, "antialias")
    handles, seen = page.locator(".handle").all(), []
    keys = 15 * ["ArrowLeft"] + 40 * ["ArrowRight"]
    flatter = 12 * [(1, "Shift+ArrowLeft"), (0, "Shift+ArrowDown")]
    for end, key in [(end, key) for key in keys for end in (0, 1)] + flatter:
        handles[end].press(key)
        ends = np.ravel([point_of(handle) for handle in handles])
        c = np.array([antialiasing.crossing(*ends)])
        grad_c = -(0.9 - 0.2) * (0 < c[0] < 1)
        is_blended = (abs(ends[3] - ends[1]) >= abs(ends[2] - ends[0])
                      and -outlines.WINDOW < c[0] < 1 + outlines.WINDOW)
        wanted = -np.array(antialiasing.crossing_backward(grad_c * is_blended, *ends))
        found = ", ".join(settled(page).locator(".descent.label").all_text_contents())
        np.testing.assert_allclose(numbers(found), wanted, atol=5.1e-4)
        is_clamped = is_blended and not 0 < c[0] < 1
        assert ("clamped" in page.inner_text(".verdict")) == is_clamped
        seen.append("clamped" if is_clamped else "none" if not is_blended else c[0] < 0.5)
    assert set(seen) == {"none", "clamped", True, False}


def test_the_boards_pixels_have_the_colours_of_their_places(call, page, address):
    """What is fast enough to draw is not what the equations say."""
    pixels = np.random.default_rng(51).integers([60, 45], [260, 130], (300, 2))
    seen = call("perspective", "seenAt", pixels + 0.5, 55)
    opened(page, address, "perspective")
    for k, name in enumerate(("affine", "right")):
        found = page.evaluate("""([k, pixels]) => {
            const context = document.querySelectorAll("canvas")[k].getContext("2d");
            return pixels.map(([x, y]) => context.getImageData(x, 175 - y, 1, 1).data[0]);
        }""", [k, pixels.tolist()])
        squares = [np.floor(8 * np.array(s[name]["uv"])) if s else None for s in seen]
        wanted = [204 if at is None else 229 if (at == [5, 2]).all() else
                  244 if at.sum() % 2 else 40 for at in squares]
        assert found == wanted and len(set(wanted)) == 4


def test_the_descent_finds_the_triangle(page, address):
    """It circles round the target, or ends beside it."""
    opened(page, address, "descent")
    page.get_by_role("button", name="Play").click()
    page.get_by_text("Found").wait_for(timeout=60_000)
    assert numbers(settled(page).inner_text(".told"))[1] < 1e-4
    places = [point_of(page.locator(f".handle:text-is('{k}')")) for k in range(3)]
    np.testing.assert_allclose(places, [[5.3, 3.1], [20.4, 5.8], [9.6, 14.2]], atol=0.051)
