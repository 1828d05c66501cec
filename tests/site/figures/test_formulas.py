"""The figures of lectures 00 to 10 compute what the reference computes."""
import numpy as np
import pytest
from reading import each

from course.given import image
from reference import (
    antialiasing,
    interpolation,
    inverse_rendering,
    mipmapping,
    msaa,
    neural_renderer,
    outlines,
    rasterization,
    sampling,
    soft_rasterizer,
    sweep_gradient,
    texturing,
    transforms,
)


def test_descent(agrees):
    """The mean is over rows, or Adam's first steps are too short."""
    picture, target, x, grad, mean = np.random.default_rng(1).normal(size=(5, 1, 6))
    loss, grad_picture = inverse_rendering.squared_error(picture, target)
    agrees("blended", "squaredError", [loss], picture, target)
    agrees("blended", "squaredErrorBackward", grad_picture, picture, target)
    step = x, grad, mean, mean**2, 3, 0.25
    agrees("blended", "adamStep", np.swapaxes(inverse_rendering.adam_step(*step), 0, 1), *step)


def test_frustum(call, agrees):
    """A sign of (6) is turned, the aspect is height over width, or w is not minus z."""
    rng = np.random.default_rng(1)
    angle, aspect, near, depth = rng.uniform([0.01, 0.2, 0.01, 0.01], [3, 5, 5, 100], (100, 4)).T
    sides = np.array(each(transforms.frustum_sides, angle, aspect, near))
    agrees("frustum", "frustumSides", sides, angle, aspect, near)
    beside = *(sides + rng.uniform(-0.1, 0.1, sides.shape) * sides[:, 1:2]).T, near, near + depth
    matrices = each(transforms.frustum, *beside)
    agrees("frustum", "frustum", matrices, *beside)
    cameras = angle, aspect, near, near + depth
    agrees("frustum", "perspective", each(transforms.perspective, *cameras), *cameras)
    points = np.concatenate([rng.normal(size=(100, 3)), np.ones((100, 1))], 1)
    points[:20, :2] = 0                                               # on the axis
    points[20:40, 2] = -near[20:40]                                   # on the near plane
    clip = np.array(each(transforms.transform, points, matrices))
    agrees("frustum", "transform", clip, points, matrices)
    agrees("frustum", "perspectiveDivide", clip[:, :3] / clip[:, 3:], clip)
    half = call("frustum", "halfway", near, near + depth)
    ahead = np.stack([0 * near, 0 * near, np.negative(half), 0 * near + 1], 1)
    middles = transforms.to_screen(np.array(each(transforms.transform, ahead, matrices)), 2, 2)
    np.testing.assert_allclose(middles[:, 2], 0, atol=1e-9)


def test_alias(agrees):
    """A frequency of half the rate has the wrong sign, or the box is too wide."""
    frequency = np.concatenate([np.random.default_rng(3).uniform(-40, 40, 200),
                                np.arange(-24, 25, 6)])
    agrees("alias", "aliasFrequency", sampling.alias_frequency(frequency, 12.0), frequency, 12)
    for width, n in ((3, 4), (15, 180), (7, 20)):
        agrees("alias", "boxFactor", sampling.box_spectrum(width, n), range(n), width, n)


def seen_by(triangles, pattern, size=(16, 8)):
    """The reference's face of each sample, the first triangle nearest. Sizes that are powers of 2
    round no place on its way to clip space and back.
    """
    points = np.concatenate(triangles)
    depth = np.repeat(np.linspace(-0.5, 0.5, len(triangles)), 3)
    clip = np.column_stack([2 * points / size - 1, depth, np.ones(len(points))])
    return msaa.rasterize_samples(clip, np.arange(len(points)).reshape(-1, 3), *size, pattern)[0]


@pytest.mark.parametrize("count", [1, 4, 16])
def test_msaa_samples(call, agrees, count):
    """A sample lies in another place of its pixel, sees the farther face, or is shaded twice."""
    rng = np.random.default_rng(count)
    scenes = rng.uniform(0, [16, 8], (40, 2, 3, 2))
    scenes[:30] = np.round(scenes[:30] * 4) / 4                       # many ties
    turned = rasterization.signed_area(scenes) < 0
    scenes[turned] = scenes[turned][:, ::-1]
    scenes = scenes[(rasterization.signed_area(scenes) > 0).all(1)]
    pattern = msaa.standard_pattern(count)
    agrees("msaa_samples", "standardPattern", [pattern], [count])
    seen = [seen_by(triangles, pattern) for triangles in scenes]
    agrees("msaa_samples", "rasterizeSamples", seen, scenes, 16, 8, [pattern] * len(scenes))
    seen = [faces.reshape(count, -1) for faces in seen]
    behind = np.array([0.9, 0.8, 0.7])
    for faces, asked in zip(seen, call("msaa_samples", "shadingRequests", seen), strict=True):
        pixel, face, request = msaa.shading_requests(faces.reshape(count, 8, 16))
        asked = sorted(zip(asked["pixel"], asked["face"], strict=True))
        assert asked == [*zip(pixel, face, strict=True)]
        shade = rng.uniform(size=(len(pixel), 3))
        agrees("msaa_samples", "resolve", [msaa.resolve(shade, request, behind)],
               [shade], [request.reshape(count, -1)], [behind])


def test_light_is_encoded_as_in_the_course(agrees):
    """The greys of an edge are too dark."""
    light = np.concatenate([np.linspace(0, 1, 50), [0.0031306, 0.0031307]])
    agrees("picture", "toSrgb", image.to_srgb(light), light)


def test_perspective(call, agrees):
    """The weights are multiplied by w, or the w of the corners are those of other corners."""
    rng = np.random.default_rng(5)
    e, w = rng.uniform(0.1, 1, (2, 200, 3))
    b = interpolation.barycentric_from_screen(e, w)
    agrees("perspective", "barycentricFromScreen", b, e, w)
    corners = rng.normal(size=(3, 2))
    faces, seen = np.array([[0, 1, 2]]), np.zeros((1, 200), int)
    agrees("perspective", "interpolate",
           interpolation.interpolate(corners, faces, seen, b[None])[0], b, [corners] * 200)
    pixels = rng.uniform([100, 40], [220, 100], (100, 2)).tolist()
    there = [(p, one["right"]["uv"]) for p, one in
             zip(pixels, call("perspective", "seenAt", pixels, 50), strict=True) if one]
    assert len(there) > 50
    back = call("perspective", "project", [right for _, right in there], 50)
    np.testing.assert_allclose([one["point"] for one in back], [p for p, _ in there], atol=1e-9)


def test_mip_level(call, agrees):
    """J is transposed or not in texels, the fraction belongs to the lower level, or a mean is not
    of the footprint."""
    rng = np.random.default_rng(6)
    jacobian = rng.normal(size=(200, 2, 2)) * 2.0 ** rng.integers(-9, 2, (200, 1, 1))
    level = mipmapping.mip_level(jacobian, 64, 16)
    agrees("mip_level", "mipLevel", level, jacobian, 64, 16)
    texture, uv = rng.uniform(size=(8, 8, 1)), rng.uniform(-2, 2, (100, 2))
    levels, = call("mip_level", "pyramid", [texture[..., 0]])
    jacobian = rng.normal(size=(100, 2, 2)) * 2.0 ** rng.integers(-6, 1, (100, 1, 1))
    wanted = mipmapping.texture(texture, uv, jacobian, filter_mode="linear-mipmap-linear")[:, 0]
    agrees("mip_level", "trilinear", wanted, [levels] * 100, *uv.T,
           mipmapping.mip_level(jacobian, 8, 8))
    agrees("mip_level", "footprintMean", texturing.footprint_mean(texture, uv, jacobian, 6)[:, 0],
           [levels[0]] * 100, uv, jacobian, 6)


def test_the_floors_jacobian_is_its_derivative(call):
    """A term of the quotient rule is missing."""
    pixels, h = np.random.default_rng(60).uniform([0, 0], [336, 150], (50, 2)), 1e-4

    def floor(at, what):
        return np.array([one[what] for one in call("mip_level", "floorAt", at, 0.3)])

    columns = [(floor(pixels + step, "uv") - floor(pixels - step, "uv")) / (2 * h)
               for step in h * np.eye(2)]
    np.testing.assert_allclose(floor(pixels, "jacobian"), np.stack(columns, -1), rtol=1e-5,
                               atol=1e-7)



def test_a_pairs_colours(agrees):
    """At the kink the wrong pixel changes, or the pair is blended the other way round."""
    c = np.array([-0.05, 0, 0.2, 0.5, 0.7, 1, 1.05])
    pair, edge = np.array([[[0.3], [0.8]]]), ([[0], [1]], [[0.0], [0.0]], [[-1.0], [1.0]])
    wanted = [antialiasing.blend_pairs(pair, antialiasing.Pairs(*np.array(
        [[0], [1]]), np.array([one]), *map(np.array, edge), 0, 0)).ravel() for one in c]
    agrees("antialias", "blend", wanted, 0.3, 0.8, 0.5 - np.clip(c, 0, 1))


# Lecture 10: four gradients of one outline

WIDTH, HEIGHT = 16, 8
FACE, OPPOSITE = np.array([[0, 1, 2]]), np.array([[-1, -1, -1]])


def outlined():
    """Counter-clockwise triangles, on quarters of pixels and anywhere, some of them partly off the
    screen; the reference's clip positions, its faces, and gradients by a picture."""
    rng = np.random.default_rng(10)
    points = rng.uniform([-2, -2], [WIDTH + 2, HEIGHT + 2], (60, 3, 2))
    points[:30] = np.round(points[:30] * 4) / 4
    turned = rasterization.signed_area(points) < 0
    points[turned] = points[turned, ::-1]
    points = points[rasterization.signed_area(points) > 0.5]
    clip = [np.column_stack([2 * p / (WIDTH, HEIGHT) - 1, np.zeros(3), np.ones(3)]) for p in points]
    seen = [rasterization.rasterize(each_clip, FACE, WIDTH, HEIGHT) for each_clip in clip]
    return points, clip, seen, rng.normal(size=(len(points), HEIGHT, WIDTH))


def flat(pictures):
    """Pictures as the figures have them: a row of numbers each."""
    return np.reshape(pictures, (len(pictures), -1))


def test_the_exact_coverage_and_its_gradient(agrees):
    """A pixel is one to the left, or a piece on a border counts in no pixel."""
    points, _, _, grad = outlined()
    agrees("pixel_coverage", "pixelCoverage",
           [sampling.pixel_coverage(p, WIDTH, HEIGHT) for p in points], points, WIDTH, HEIGHT)
    agrees("pixel_coverage", "pixelCoverageBackward",
           each(sampling.pixel_coverage_backward, grad, points), flat(grad), points, WIDTH)


@pytest.mark.parametrize("eps", [1e-4, 0.1])
def test_the_sweep(agrees, eps):
    """The outside of an edge is taken for its inside, or columns for rows."""
    points, clip, seen, grad = outlined()
    wanted = [sweep_gradient.sweep_backward(g[..., None], face[..., None] + 1.0, face,
                                            neural_renderer.corners_of(at, FACE), eps)[0, :, :2]
              for g, (face, _), at in zip(grad, seen, clip, strict=True)]
    agrees("outline_gradients", "sweepBackward", wanted, flat(grad),
           flat([face + 1 for face, _ in seen]), points, WIDTH, HEIGHT, eps)


@pytest.mark.parametrize("sigma", [0.05, 5.0])
def test_the_soft_picture(agrees, sigma):
    """The inside is as pale as the outside, or an end gets the other end's gradient."""
    points, _, _, grad = outlined()
    agrees("outline_gradients", "softSilhouette",
           [soft_rasterizer.soft_silhouette(p[None], WIDTH, HEIGHT, sigma) for p in points],
           points, WIDTH, HEIGHT, sigma)
    agrees("outline_gradients", "softSilhouetteBackward",
           [soft_rasterizer.soft_silhouette_backward(g, p[None], sigma)[0]
            for g, p in zip(grad, points, strict=True)], flat(grad), points, WIDTH, sigma)


def test_the_blend(call, agrees):
    """A pair of pixels above each other is turned, an edge's gradient goes to the wrong end, or
    one half-way between two centres has a gradient of the side that the reference drops."""
    points, clip, seen, grad = outlined()
    found = call("blended", "render", points, WIDTH, HEIGHT)
    hard = [(face + 1.0)[..., None] for face, _ in seen]
    given = [(*one, at, FACE, OPPOSITE) for one, at in zip(seen, clip, strict=True)]
    pictures = [outlines.antialias(one, *rest) for one, rest in zip(hard, given, strict=True)]
    np.testing.assert_allclose([one["picture"] for one in found], flat(pictures), atol=1e-9)
    wanted = [outlines.antialias_backward(g[..., None], one, *rest)[1][:, :2]
              * [2 / WIDTH, 2 / HEIGHT] for g, one, rest in zip(grad, hard, given, strict=True)]
    agrees("blended", "renderBackward", wanted, flat(grad), [one["pairs"] for one in found])
