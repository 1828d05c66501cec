"""The figure of lecture 04: a picture of many samples and few shades."""
import re

import numpy as np
import pytest
from reading import opened, settled

from course.given import image
from reference import msaa

WIDTH, HEIGHT = 16, 8  # powers of 2: no place is rounded on its way to clip space and back
BACKGROUND = np.array([0.9, 0.8, 0.7])


def seen_by(triangles, pattern):
    """The reference's face of each sample, the first triangle nearest."""
    points = np.concatenate(triangles)
    depth = np.repeat(np.linspace(-0.5, 0.5, len(triangles)), 3)
    clip = np.column_stack([2 * points / [WIDTH, HEIGHT] - 1, depth, np.ones(len(points))])
    faces = np.arange(len(points)).reshape(-1, 3)
    return msaa.rasterize_samples(clip, faces, WIDTH, HEIGHT, pattern)[0]


def scenes():
    """Pairs of counter-clockwise triangles, on quarters of pixels (many ties) and anywhere."""
    rng = np.random.default_rng(4)
    points = rng.uniform(0, [WIDTH, HEIGHT], (40, 2, 3, 2))
    points[:30] = np.round(points[:30] * 4) / 4
    areas = np.linalg.det(np.stack([points[:, :, 1] - points[:, :, 0],
                                    points[:, :, 2] - points[:, :, 0]], -1))
    points[areas < 0] = points[areas < 0][:, ::-1]
    return points[(areas != 0).all(1)]


@pytest.mark.parametrize("count", [1, 4, 16])
def test_samples_and_shades_are_those_of_the_reference(call, agrees, count):
    """A sample lies in another place of its pixel, sees the farther face, or is shaded twice."""
    pattern, rng = msaa.standard_pattern(count), np.random.default_rng(count)
    agrees("msaa_samples", "standardPattern", [(count,)], pattern)
    seen = [seen_by(triangles, pattern) for triangles in scenes()]
    agrees("msaa_samples", "rasterizeSamples",
           [(triangles, WIDTH, HEIGHT, pattern) for triangles in scenes()], seen)
    found = call("msaa_samples", "shadingRequests", [(faces.reshape(count, -1),) for faces in seen])
    shaded = []
    for faces, asked in zip(seen, found, strict=True):
        pixel, face, request = msaa.shading_requests_loop(faces)
        assert (asked["pixel"], asked["face"]) == (pixel.tolist(), face.tolist())
        shaded.append((rng.uniform(size=(len(pixel), 3)), request, BACKGROUND))
    agrees("msaa_samples", "resolve",
           [(shade, request.reshape(count, -1), behind) for shade, request, behind in shaded],
           [msaa.resolve(*each) for each in shaded])


def test_light_is_encoded_as_in_the_course(agrees):
    """The greys of an edge are too dark."""
    light = np.concatenate([np.linspace(0, 1, 50), [0.0031306, 0.0031307]])
    agrees("picture", "toSrgb", light[:, None], image.to_srgb(light))


def prices(page):
    """MSAA's shades and supersampling's, of the bars; the samples tested."""
    settled(page)
    words = " ".join(page.locator(".sheet text").all_text_contents()) + page.inner_text(".pane")
    return [int(re.search(rf"([\d,]+) {what}", words)[1].replace(",", ""))
            for what in ("shades by MSAA", "by supersampling", "samples tested")]


def about(page):
    return settled(page).inner_text(".about")


def test_sixteen_times_the_samples_take_few_more_shades(page, address):
    """The price is that of the number of samples before, or counts samples without a face; or the
    pixel tells of the samples of the pixel above, or of the face behind."""
    opened(page, address, "msaa_samples")
    assert prices(page) == [150, 473, 1344]
    assert "2 see blue, 1 sees orange, 1 sees no face: 2 shades" in about(page)
    page.get_by_role("button", name="16").click()
    assert prices(page) == [166, 1890, 5376]
    assert "3 see blue, 3 see orange, 10 see no face: 2 shades" in about(page)
    page.locator(".probe").press("ArrowUp")
    assert about(page).startswith("16 see orange: 1 shade,")
    page.get_by_role("button", name="1", exact=True).click()
    assert prices(page) == [119, 119, 336]
    page.get_by_role("slider", name="The near triangle's vertex 2").press("ArrowDown")
    assert prices(page) != [119, 119, 336]
