"""The figure of lecture 14: flatland is the plane y = 0 of a world in three dimensions."""
import re

import numpy as np
from hands import drag
from reading import opened, point_of, verdict

from course.given import ray_casting
from reference import lights, shadow_mapping, transforms

WALL = [[5, 0], [5, 1.8], [5.12, 1.8], [5.12, 0]]
SCENE = np.array([[0, 0], *WALL, [12, 0]])
PLACES = np.random.default_rng(14).uniform([0.3, 2.6], [11.7, 4], (20, 2))


def in_space(points, y=0.0):
    """Flatland's (x, y) is (x, 0, y) of the world: the light's x axis then lies in flatland."""
    points = np.asarray(points, float)
    return np.insert(points, 1, y, axis=-1)


def in_flatland(light):
    return {"position": light.position[::2].tolist(), "c00": light.clip_from_light[0, 0],
            "rotation": light.rotation[::2, ::2].tolist()}


def made(place):
    """The reference's light at a place of flatland. Its cone holds the scene's directions, from
    a place so near that the reference refuses the scene."""
    to = SCENE - place
    light = lights.point_light(in_space(place),
                               in_space(place + to / np.linalg.norm(to, axis=1)[:, None]))
    angle = 2 * np.arctan(1 / light.clip_from_light[0, 0])
    return light._replace(clip_from_light=transforms.perspective(angle, 1.0, 0.1, 20.0))


def strips():
    """The scene, drawn out along the world's y: vertices (V, 3), faces (F, 3)."""
    vertices = np.concatenate([in_space(SCENE, -3), in_space(SCENE, 3)])
    n, k = len(SCENE), np.arange(len(SCENE) - 1)
    return vertices, np.concatenate([np.stack([k, k + 1, k + n + 1], 1),
                                     np.stack([k, k + n + 1, k + n], 1)])


def test_the_light_and_its_map_are_those_of_the_reference(call, agrees):
    """The axis is not in the middle of what is seen, or a texel holds the farthest depth."""
    made_lights = [made(place) for place in PLACES]
    found = call("flatland_shadow", "pointLight", [(place, SCENE) for place in PLACES])
    for ours, light in zip(found, made_lights, strict=True):
        for name, value in in_flatland(light).items():
            np.testing.assert_allclose(ours[name], value, atol=1e-9)
    agrees("flatland_shadow", "depthMap",
           [(SCENE, in_flatland(light), 25) for light in made_lights],
           [shadow_mapping.depth_map(*strips(), light, 25)[12] for light in made_lights])


def test_the_equations_are_those_of_the_reference(call, agrees):
    """A sign of the rotation is turned, a place beside the map is read, or a line seen edge-on has
    no bound."""
    rng = np.random.default_rng(3)
    light, points = made([2, 3]), rng.uniform([0, -1], [12, 1], (200, 2))
    there, c00 = in_flatland(light), light.clip_from_light[0, 0]
    q = shadow_mapping.to_light(in_space(points), light.position, light.rotation)
    agrees("flatland_shadow", "toLight",
           [(p, there["position"], there["rotation"]) for p in points], q[:, ::2])
    agrees("flatland_shadow", "mapPosition", [(p, c00, 18) for p in q[:, ::2]],
           shadow_mapping.map_position(q, light.clip_from_light, 18, 18)[:, 0])

    row, x = rng.uniform(2, 6, 18), np.array([-0.1, 0, 0.9, 1, 17.99, 18, *rng.uniform(0, 18, 50)])
    distance, bias = rng.uniform(2, 6, len(x)), rng.uniform(0, 1, len(x))
    distance[2], bias[2] = row[0] + 0.5, 0.5
    agrees("flatland_shadow", "isLit",
           [(row, *one) for one in zip(x, distance, bias, strict=True)],
           shadow_mapping.is_lit(row[None], np.stack([x, 0 * x], 1), distance, bias))

    angle = rng.uniform(0, 2 * np.pi, 200)
    normal = np.stack([np.cos(angle), np.sin(angle)], 1)
    normal[:50] = np.stack([-q[:50, 2], q[:50, 0]], 1) / np.hypot(q[:50, 0], q[:50, 2])[:, None]
    slope = shadow_mapping.distance_slopes(in_space(normal), q, light.clip_from_light, 18, 18)
    found = call("flatland_shadow", "distanceSlopes",
                 [(n, p, c00, 18) for n, p in zip(normal, q[:, ::2], strict=True)])
    np.testing.assert_allclose(np.abs(found[:50]), np.abs(slope[:50, 0]), atol=1e-9)  # n . ray = 0
    np.testing.assert_allclose(found[50:], slope[50:, 0], atol=1e-9)
    agrees("flatland_shadow", "slopeScaledBias", [(s, 0.2, 1.5) for s in slope[:, 0]],
           shadow_mapping.slope_scaled_bias(slope, 0.2, 1.5, np.inf))


def kinds(place, x, constant, factor):
    """What the reference says of the ground at x: the map's answer, and the truth's."""
    light, points = made(place), in_space(np.stack([x, 0 * x], 1))
    stored = shadow_mapping.depth_map(*strips(), light, 18)
    lit = shadow_mapping.hard_shadow(points, np.tile([0.0, 0.0, 1.0], (len(x), 1)), light,
                                     np.tile(stored[9], (18, 1)), constant, factor)
    truth = ray_casting.ray_cast(points, *strips(), light)
    return np.where(lit, np.where(truth, "lit", "leak"), np.where(truth, "acne", "dark"))


def test_acne_and_leaks_are_where_the_reference_has_them(call):
    """The truth is the map's, or the slope is that of the wall."""
    x = np.concatenate([np.linspace(0.011, 4.97, 200), np.linspace(5.151, 11.97, 300)])
    cases = [(place, *bias) for place in PLACES[:6] for bias in ((0, 0), (0.15, 0), (0.7, 0),
                                                                 (0.02, 1))]
    given = [(np.stack([x, 0 * x], 1), in_flatland(made(place)),
              shadow_mapping.depth_map(*strips(), made(place), 18)[9], *bias)
             for place, *bias in cases]
    seen = set()
    for found, case in zip(call("flatland_shadow", "shadowOf", given), cases, strict=True):
        wanted = kinds(case[0], x, *case[1:])
        assert [one["kind"] for one in found] == wanted.tolist()
        seen |= set(wanted)
    assert seen == {"lit", "dark", "acne", "leak"}


def told(page):
    """The two shares below the figure, in percent: acne, leak."""
    return [float(share) for share in re.findall(r"([\d.]+)%", verdict(page))]


def shares(place, constant, factor):
    """The same shares by the reference, in percent."""
    x = (np.arange(720) + 0.5) / 60
    found = kinds(place, x[(x < 5) | (x > 5.12)], constant, factor)
    return [100 * np.mean(found == kind) for kind in ("acne", "leak")]


def test_a_bias_trades_acne_for_leaks(page, address):
    """The sentence is that of the bias before, or the slope's share is not added."""
    opened(page, address, "flatland_shadow")
    bias = page.get_by_role("slider", name="bias")
    said = []
    for value in ("0", "0.15", "1"):
        bias.fill(value)
        said.append(told(page))
        np.testing.assert_allclose(said[-1], shares([1.6, 4], float(value), 0), atol=0.051)
    (acne, *_), _, (none, leak) = said
    assert acne > 30 and none < 1 and leak > 5
    bias.fill("0")
    page.get_by_role("button", name="slope").click()
    np.testing.assert_allclose(told(page), shares([1.6, 4], 0, 1), atol=0.051)


def test_the_light_follows_the_mouse_and_the_shadow_the_light(page, address):
    """The map is that of the light where it stood."""
    opened(page, address, "flatland_shadow")
    page.get_by_role("slider", name="bias").fill("0")
    light = page.get_by_role("slider", name="Light")
    before = told(page)
    drag(page, light, 300, 30)
    light.press("ArrowRight")
    place = point_of(light)
    assert place[0] > 4 and place[1] < 4
    np.testing.assert_allclose(told(page), shares(place, 0, 0), atol=0.051)
    assert told(page) != before
