"""The figure of lecture 01: a camera's frustum, and the square that the divide makes of it."""
import re

import numpy as np
from hands import drag
from reading import opened, point_of, settled

from reference import transforms

POSTS = np.arange(1, 12) / 2


def test_the_camera_is_that_of_the_reference(call, agrees):
    """A sign of (6) is turned, the aspect is height over width, or w is not minus z."""
    rng = np.random.default_rng(1)
    angle, aspect = rng.uniform(0.01, 3, 100), rng.uniform(0.2, 5, 100)
    near = rng.uniform(0.01, 5, 100)
    far = near + rng.uniform(0.01, 100, 100)
    sides = np.array([transforms.frustum_sides(*one)
                      for one in zip(angle, aspect, near, strict=True)])
    agrees("frustum", "frustumSides", list(zip(angle, aspect, near, strict=True)), sides)
    beside = np.concatenate([sides + rng.uniform(-0.1, 0.1, sides.shape) * (sides[:, 1:2]),
                             near[:, None], far[:, None]], 1)
    matrices = [transforms.frustum(*one) for one in beside]
    agrees("frustum", "frustum", beside, matrices)
    cameras = list(zip(angle, aspect, near, far, strict=True))
    agrees("frustum", "perspective", cameras, [transforms.perspective(*one) for one in cameras])
    points = np.concatenate([rng.normal(size=(100, 3)), np.ones((100, 1))], 1)
    points[:20, :2] = 0                                               # on the axis
    points[20:40, 2] = -near[20:40]                                   # on the near plane
    seen = list(zip(points, matrices, strict=True))
    clip = np.array([transforms.transform(*one) for one in seen])
    agrees("frustum", "transform", seen, clip)
    agrees("frustum", "perspectiveDivide", [(one,) for one in clip],
           transforms.perspective_divide(clip))
    half = np.array(call("frustum", "halfway", list(zip(near, far, strict=True))))
    depth = [transforms.perspective_divide(transforms.transform(np.array([0, 0, -d, 1]), matrix))[2]
             for d, matrix in zip(half, matrices, strict=True)]
    np.testing.assert_allclose(depth, 0, atol=1e-9)
    assert (half < 2 * near).all()


def posts_in_ndc(page):
    """The posts of the right picture: z, and half of the height."""
    sheet = settled(page).locator(".sheet").last
    lines = sheet.locator(".post").evaluate_all("all => all.map(one => one.getAttribute('points'))")
    at = np.array([re.split("[ ,]", one) for one in lines], float).reshape(-1, 2, 2)
    at = at / sheet.evaluate("sheet => sheet.clientWidth") * 2.4         # it shows -1.2 to 1.2
    return at[:, 0, 0] - 1.2, (at[:, 0, 1] - at[:, 1, 1]) / 2


def check(page):
    """Both pictures and the sentence belong to the camera of the handles -> near, fov_y."""
    near = point_of(page.get_by_role("slider", name="Near plane"))[0]
    far, top = point_of(page.get_by_role("slider", name="Field of view"))
    fov_y = 2 * np.arctan(top / far)
    d = POSTS[near <= POSTS]
    points = np.stack([0 * d, 0 * d + 0.4, -d, 0 * d + 1], 1)
    clip = transforms.transform(points, transforms.perspective(fov_y, 1.0, near, far))
    _, y, z = transforms.perspective_divide(clip).T
    np.testing.assert_allclose(posts_in_ndc(page), [z, np.minimum(y, 1)], atol=1e-6)
    half = float(re.search(r"distance ([\d.]+)", page.inner_text(".verdict"))[1])
    assert abs(half - 2 * near * far / (near + far)) < 0.0051
    assert f"field of view {np.degrees(fov_y):.0f}" in page.locator(".sheet").first.inner_text()
    return near, fov_y


def test_posts_at_equal_steps_are_where_the_reference_puts_them(page, address):
    """The square belongs to the camera before, or what is before the near plane is in it."""
    opened(page, address, "frustum")
    first = check(page)
    drag(page, page.get_by_role("slider", name="Near plane"), 80, -40)
    second = check(page)
    assert second[0] > first[0] + 1 and second[1] == first[1]
    page.get_by_role("slider", name="Field of view").press("Shift+ArrowDown")
    third = check(page)
    assert third[0] == second[0] and third[1] < second[1]
