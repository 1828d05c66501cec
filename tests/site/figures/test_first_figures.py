"""The figures of lectures 02 to 08: their functions, their numbers."""
import numpy as np
from hands import spot
from reading import numbers, opened, point_of, settled, verdict

from reference import (
    antialiasing,
    interpolation,
    mipmapping,
    rasterization,
    sampling,
    texturing,
)

# Functions

def test_edge_functions_are_those_of_the_reference(agrees):
    """The edge is walked the other way round, a sample on an edge belongs to both triangles or to
    none, or the weights belong to other vertices."""
    rng = np.random.default_rng(2)
    whole = rng.integers(0, 7, (400, 4, 2)).astype(float)
    points = np.concatenate([whole, rng.normal(size=(100, 4, 2))])
    cases = [(p, triangle) for p, *triangle in points]
    wanted = [rasterization.edge_function(p, t[0], t[1]) for p, t in cases]
    assert sum(e == 0 for e in wanted) > 30, "these inputs have hardly any ties"
    agrees("edge_functions", "edgeFunction", [(p, t[0], t[1]) for p, t in cases], wanted)
    areas = rasterization.signed_area(points[:, 1:])
    agrees("edge_functions", "signedArea", [(t,) for _, t in cases], areas)
    agrees("edge_functions", "isCovered", cases,
           [rasterization.is_covered(p, np.array(t)) for p, t in cases])
    solid = [case for case, area in zip(cases, areas, strict=True) if area != 0]
    agrees("edge_functions", "screenWeights", solid,
           [rasterization.screen_weights(p, np.array(t)) for p, t in solid])


def test_the_blend_and_its_gradient_are_those_of_the_reference(agrees):
    """A sign of the gradient is turned, or at the kink the wrong pixel changes."""
    rng = np.random.default_rng(8)
    ends = rng.uniform(-1, 2, (200, 4))
    ends[:, 1], ends[:, 3] = rng.uniform(0.1, 1, 200), rng.uniform(-1, -0.1, 200)
    c = np.array([antialiasing.crossing(*end) for end in ends])
    agrees("antialias", "crossing", ends, c)
    agrees("antialias", "crossingBackward", [(1.7, *end) for end in ends],
           [antialiasing.crossing_backward(np.array(1.7), *end) for end in ends])
    agrees("antialias", "isBlended", np.column_stack([c, ends]),
           antialiasing.is_blended(c, np.full(200, True), *ends.T))
    c = np.concatenate([c, [0, 0.5, 1, -0.05, 1.05]])
    alpha = antialiasing.blend_weight(c)
    agrees("antialias", "blendWeight", c[:, None], alpha)
    agrees("antialias", "blendWeightBackward", [(3.0, x) for x in c],
           antialiasing.blend_weight_backward(np.full(len(c), 3.0), c))
    pair, grad = np.array([[[0.3], [0.8]]]), np.array([[[5.0], [7.0]]])
    two = np.array([0]), np.array([1])
    agrees("antialias", "blend", [(0.3, 0.8, a) for a in alpha],
           [antialiasing.blend(pair, *two, np.array([a])).ravel() for a in alpha])
    wanted = [antialiasing.blend_backward(grad, pair, *two, np.array([a])) for a in alpha]
    agrees("antialias", "blendBackward", [([5, 7], 0.3, 0.8, a) for a in alpha],
           [[*colour.ravel(), *by_alpha] for colour, by_alpha in wanted])


def test_the_weights_of_the_face_are_those_of_the_reference(agrees):
    """The weights are multiplied by w, or not normalised."""
    rng = np.random.default_rng(5)
    e, w = rng.uniform(0.1, 1, (2, 200, 3))
    b = interpolation.barycentric_from_screen(e, w)
    agrees("perspective", "barycentricFromScreen", list(zip(e, w, strict=True)), b)
    faces, seen, corners = np.array([[0, 1, 2]]), np.zeros((1, 200), int), rng.normal(size=(3, 2))
    agrees("perspective", "interpolate", [(weights, corners) for weights in b],
           interpolation.interpolate_loop(corners, faces, seen, b[None])[0])


def test_what_a_pixel_sees_in_perspective_is_projected_back_to_it(call):
    """The w of the corners are those of other corners."""
    pixels = np.random.default_rng(50).uniform([100, 40], [220, 100], (100, 2)).tolist()
    seen = call("perspective", "seenAt", [(p, 50) for p in pixels])
    there = [(p, s["right"]["uv"], s["affine"]["uv"])
             for p, s in zip(pixels, seen, strict=True) if s]
    assert len(there) > 50
    back = call("perspective", "project", [(right, 50) for _, right, _ in there])
    np.testing.assert_allclose([b["point"] for b in back], [p for p, _, _ in there], atol=1e-9)
    assert max(np.abs(np.subtract(right, affine)).max() for _, right, affine in there) > 0.1


def test_levels_are_those_of_the_reference(call, agrees):
    """J is transposed or not in texels, or the fraction belongs to the lower level, or a mean is
    not of the footprint."""
    rng = np.random.default_rng(6)
    jacobian = rng.normal(size=(200, 2, 2)) * 2.0 ** rng.integers(-9, 2, (200, 1, 1))
    level = mipmapping.mip_level(jacobian, 64, 16)
    agrees("mip_level", "mipLevel", [(j, 64, 16) for j in jacobian], level)
    level = np.concatenate([level, np.arange(8)])
    agrees("mip_level", "blendLevels", [(x, 6) for x in level],
           np.transpose(mipmapping.blend_levels(level, 6)))
    image = rng.uniform(size=(8, 8, 1))
    levels, = call("mip_level", "pyramid", [(image[..., 0],)])
    for found, wanted in zip(levels, mipmapping.pyramid(image), strict=True):
        np.testing.assert_allclose(found, wanted[..., 0], atol=1e-9)
    uv = rng.uniform(-2, 2, (100, 2))
    agrees("mip_level", "bilinear", [(levels[0], *x) for x in uv],
           mipmapping.texture(image, uv)[:, 0])
    jacobian = rng.normal(size=(100, 2, 2)) * 2.0 ** rng.integers(-6, 1, (100, 1, 1))
    level = mipmapping.mip_level(jacobian, 8, 8)
    agrees("mip_level", "trilinear", [(levels, *x, at) for x, at in zip(uv, level, strict=True)],
           mipmapping.texture(image, uv, jacobian, filter="linear-mipmap-linear")[:, 0])
    agrees("mip_level", "footprintMean",
           [(levels[0], x, j, 6) for x, j in zip(uv, jacobian, strict=True)],
           texturing.footprint_mean(image, uv, jacobian, 6)[:, 0])


def test_the_floors_jacobian_is_its_derivative(call):
    """A term of the quotient rule is missing."""
    rng, h = np.random.default_rng(60), 1e-4
    pixels = rng.uniform([0, 0], [336, 150], (50, 2))

    def uv(at):
        return np.array([s["uv"] for s in call("mip_level", "floorAt", [(p, 0.3) for p in at])])

    jacobian = [s["jacobian"] for s in call("mip_level", "floorAt", [(p, 0.3) for p in pixels])]
    columns = [(uv(pixels + step) - uv(pixels - step)) / (2 * h) for step in h * np.eye(2)]
    np.testing.assert_allclose(jacobian, np.stack(columns, -1), rtol=1e-5, atol=1e-7)


def test_aliases_are_those_of_the_reference(agrees):
    """A frequency of half the rate has the wrong sign, or the box is too wide."""
    frequency = np.concatenate([np.random.default_rng(3).uniform(-40, 40, 200),
                                np.arange(-24, 25, 6)])
    agrees("alias", "aliasFrequency", [(f, 12) for f in frequency],
           sampling.alias_frequency(frequency, 12.0))
    for width, n in ((3, 4), (15, 180), (7, 20)):
        agrees("alias", "boxFactor", [(k, width, n) for k in range(n)],
               sampling.box_spectrum(width, n))


# What they show

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
        grad_c = antialiasing.blend_weight_backward(np.array([0.9 - 0.2]), c)[0]
        is_blended = antialiasing.is_blended(c, np.array([True]), *ends[:, None])[0]
        wanted = -np.array(antialiasing.crossing_backward(grad_c * is_blended, *ends))
        found = ", ".join(settled(page).locator(".descent.label").all_text_contents())
        np.testing.assert_allclose(numbers(found), wanted, atol=5.1e-4)
        said = page.inner_text(".verdict")
        is_clamped = is_blended and not 0 < c[0] < 1
        assert ("no gradient" in said) == (not wanted.any()) and ("clamped" in said) == is_clamped
        seen.append("clamped" if is_clamped else "none" if not is_blended else c[0] < 0.5)
    assert set(seen) == {"none", "clamped", True, False}


def weights(page):
    """The weights at the corners in both pictures: of the screen and of the face."""
    texts = settled(page).locator(".sheet text").all_text_contents()
    return np.reshape(numbers(" ".join(texts)), (2, -1))


def test_the_pixel_in_perspective_shows_the_references_weights(page, address, call):
    """The weights are those of another pixel than the one pointed at, or of another tilt."""
    opened(page, address, "perspective")
    for tilt in (40, 70):
        page.get_by_label("tilt").fill(str(tilt))
        probe = page.locator(".probe").last
        probe.press("Shift+ArrowDown")
        seen, = call("perspective", "seenAt", [(point_of(probe), tilt)])
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])[seen["face"]]
        w = [corner["w"] for corner in call("perspective", "project",
                                            [(uv, tilt) for uv in corners])]
        screen, face = weights(page)
        np.testing.assert_allclose(screen, seen["affine"]["weights"], atol=5.1e-3)
        wanted = interpolation.barycentric_from_screen(np.array(seen["affine"]["weights"]),
                                                       np.array(w))
        np.testing.assert_allclose(face, wanted, atol=5.1e-3)


def test_the_boards_pixels_have_the_colours_of_their_places(page, address, call):
    """What is fast enough to draw is not what the equations say."""
    opened(page, address, "perspective")
    pixels = np.random.default_rng(51).integers([60, 45], [260, 130], (300, 2))
    seen = call("perspective", "seenAt", [(p + 0.5, 55) for p in pixels])
    for k, name in enumerate(("affine", "right")):
        found = page.evaluate("""([k, pixels]) => {
            const context = document.querySelectorAll("canvas")[k].getContext("2d");
            return pixels.map(([x, y]) => context.getImageData(x, 175 - y, 1, 1).data[0]);
        }""", [k, pixels.tolist()])
        squares = [np.floor(8 * np.array(s[name]["uv"])) if s else None for s in seen]
        wanted = [204 if at is None else 229 if (at == [5, 2]).all() else
                  244 if at.sum() % 2 else 40 for at in squares]
        assert found == wanted and len(set(wanted)) == 4


def test_the_floors_pixel_shows_the_references_level(page, address, call):
    """The level is that of the pixel before, or the mixture is turned round."""
    pixels = [[x, y] for x in (20.5, 250.5) for y in (10.5, 120.5, 150.5)]
    seen = call("mip_level", "floorAt", [(p,) for p in pixels])
    level = mipmapping.mip_level(np.array([s["jacobian"] for s in seen]), 128, 128)
    lower, upper, f = mipmapping.blend_levels(level, 7)
    opened(page, address, "mip_level")
    floor = page.get_by_role("img", name="A floor")
    for k, (x, y) in enumerate(pixels):
        page.mouse.click(*spot(floor, x / 336, 1 - y / 192))
        length, shown, *mixed = numbers(verdict(page))
        wanted = [1 - f[k], lower[k], f[k], upper[k]] if f[k] else [lower[k]]
        np.testing.assert_allclose([shown, *mixed], [level[k], *wanted], atol=5.1e-3)
        assert abs(length - 2 ** level[k]) < 5.1e-3
    assert level.min() < 0 and level.max() > 4


def test_only_the_half_without_the_pyramid_flickers_in_a_walk(page, address):
    """The walk does nothing, or both halves read one texel."""
    opened(page, address, "mip_level")
    page.evaluate("""() => {
        const canvas = document.querySelector("canvas");
        window.far = (left) => [...canvas.getContext("2d").getImageData(left, 20, 150, 15).data];
    }""")

    def both():
        return np.array([page.evaluate("far(5)"), page.evaluate("far(180)")], float)

    before = both()
    page.get_by_role("button", name="Walk").click()
    page.wait_for_function("before => far(5).join() !== before.join()", arg=before[0].tolist())
    page.get_by_role("button", name="Pause").click()
    left, right = np.abs(both() - before).mean(1)
    assert left > 20 * right


def test_a_pixel_chosen_in_one_picture_is_chosen_in_the_other(page, address):
    """The mouse crosses the other picture on its way, and the chosen pixel is forgotten."""
    opened(page, address, "perspective")
    left, right = page.get_by_role("slider", name="Pixel").all()
    first = left.get_attribute("aria-valuetext")
    left.focus()
    for _ in range(9):
        page.keyboard.press("ArrowLeft")
    chosen, shown = left.get_attribute("aria-valuetext"), weights(page)
    assert chosen != first and right.get_attribute("aria-valuetext") == chosen
    x, y = spot(right)
    page.mouse.move(x + 30, y + 10)
    assert not np.array_equal(weights(page), shown)
    page.mouse.move(1, 1)
    np.testing.assert_array_equal(weights(page), shown)


def test_the_slider_shows_the_alias(page, address):
    """The alias is that of the wave before."""
    opened(page, address, "alias")
    page.get_by_role("slider", name="periods").fill("16.5")
    assert "the samples show 4.5" in verdict(page)
    assert "= 4.5." in page.inner_text(".pane")
    page.get_by_role("slider", name="periods").fill("5.5")
    assert verdict(page) == "5.5 periods, seen correctly."
