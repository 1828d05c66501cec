"""What the exercise of multi_view_fit.py must do: the step of the search, there and back."""
import numpy as np

from labkit.checks import assert_close, assert_equal, exercise

Y0, Y1 = np.sqrt(np.array([1, 3]) / np.pi) / 2
IN_FRONT = np.array([[2.0, 0, 0, 0], [0, 2, 0, 0], [0, 0, -1, 0], [0, 0, -1, 3]])
FROM_BELOW = np.array([[1.0, 0, 0, 0.1], [0, 0.8, 0.6, 0], [0, -0.6, 0.8, 0], [0, 0, 0, 1]])
FROM_THE_SIDE = IN_FRONT @ np.array([[0.6, 0, -0.8, 0], [0, 1, 0, 0.1], [0.8, 0, 0.6, 0],
                                     [0, 0, 0, 1]])


def view_of(impl, camera, target):
    """What `see` takes, a Target: one sample a pixel, and all of its pixels outside."""
    height, width, _ = target.shape
    view = impl.pipeline.View(camera, width, height, np.array([0.3, 0.1, 0.2, 0.0]))
    return impl.Target(target, view, 1, np.full((height, width), True))


def solid(rng):
    """A tetrahedron, its albedo, and a light: vertices, faces, albedo (4, 3), light (9, 3)."""
    vertices = np.array([[0.9, 0.1, -0.2], [-0.7, 0.6, -0.3], [-0.3, -0.8, -0.1], [0.1, 0.2, 0.8]])
    faces = np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 2, 1]])
    light = rng.uniform(-0.3, 0.3, (9, 3))
    light[0] = 3.0, 2.5, 2.0
    return vertices, faces, rng.uniform(0.2, 0.8, (4, 3)), light


def several_views(impl, rng, cameras=(IN_FRONT, FROM_THE_SIDE)):
    targets = rng.uniform(0, 1, (len(cameras), 7, 8, 4))
    views = tuple(view_of(impl, camera, target) for camera, target in
                  zip(cameras, targets, strict=True))
    return views, targets


def full_picture(impl):
    """A face that fills a picture of 2 x 3 pixels, whose colour is (1.5, 0.75, 1): what
    `views_loss_and_gradients` takes. E is (3 + z, 1, 2), and z is 1.
    """
    vertices = np.array([[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]])
    light, albedo = np.zeros((9, 3)), np.tile([0.375, 0.75, 0.5], (3, 1))
    light[0], light[2, 0] = np.array([3, 1, 2]) / Y0, 1 / Y1
    target = np.tile([1.0, 0.5, 0.25, 0.6], (2, 3, 1))
    views = (view_of(impl, np.eye(4), target),)
    return vertices, np.array([[0, 1, 2]]), albedo, light, views, target[None], 5.0


@exercise("16.9")
def test_five_outputs_have_the_shapes_of_their_inputs(impl):
    """An output is missing, such as the loss, or the outputs are in another order: loss, then the
    gradients of vertices, albedo and light, and grad_level.
    """
    found = impl.views_loss_and_gradients(*full_picture(impl))
    assert_equal(tuple(map(np.shape, found)), ((), (3, 3), (3, 3), (9, 3), (3,)))


@exercise("16.9")
def test_the_loss_of_a_full_picture_on_paper(impl):
    """The loss: the albedo is rendered as it is, without the light, for shade is left out.
    Coverage's weight is left out, another picture is the target, or a sum stands for a mean.
    """
    loss = impl.views_loss_and_gradients(*full_picture(impl))[0]
    assert_close(loss, (0.5**2 + 0.25**2 + 0.75**2) / 3 + 5 * 0.4**2)


@exercise("16.9")
def test_the_gradient_of_the_albedo_of_a_full_picture_on_paper(impl):
    """grad_albedo: grad_colours does not go back through shade_backward, and lacks the light. The
    loss itself is handed to picture_loss_backward as grad_loss, which is 1. Picture and target are
    swapped there. Or their difference alone goes back.
    """
    grad_albedo = impl.views_loss_and_gradients(*full_picture(impl))[2]
    grad_colours = 2 / 3 * np.array([0.5, 0.25, 0.75])
    assert_close(np.sum(grad_albedo, 0), grad_colours * [4, 1, 2])


@exercise("16.9")
def test_the_gradient_of_the_light_of_a_full_picture_on_paper(impl):
    """grad_light: the albedo is missing in shade_backward, or the shaded colours stand for it. Or
    grad_light and grad_albedo are exchanged.
    """
    grad_light = impl.views_loss_and_gradients(*full_picture(impl))[3]
    grad_irradiance = 2 / 3 * np.array([0.5, 0.25, 0.75]) * [0.375, 0.75, 0.5]
    assert_close(np.array(grad_light)[:3], np.array([[Y0], [0], [Y1]]) * grad_irradiance)


@exercise("16.9")
def test_the_level_and_vertices_of_a_full_picture_on_paper(impl):
    """grad_level: carving's gradient, which comes with grad_colours, is left out, scaled, or added
    to grad_vertices. Those have none here, where light is even. They are no normals' gradients:
    vertex_normals_backward takes those to the vertices.
    """
    _, grad_vertices, _, _, grad_level = impl.views_loss_and_gradients(*full_picture(impl))
    assert_close(np.sum(grad_level), -1.0)  # every pixel asks the surface to go
    assert_close(np.abs(grad_vertices).max(), 0.0)


@exercise("16.9")
def test_three_views_are_the_mean_of_each_alone(impl):
    """One view alone decides, such as the last or the first, views add up and are no mean, or are
    divided by their number once more, or one is compared with the other's target.
    """
    rng = np.random.default_rng(0)  # not drawn: what is always the same passes
    vertices, faces, albedo, light = solid(rng)
    views, targets = several_views(impl, rng, (IN_FRONT, FROM_THE_SIDE, IN_FRONT @ FROM_BELOW))

    def found(chosen):
        return impl.views_loss_and_gradients(vertices, faces, albedo, light, views[chosen],
                                             targets[chosen], 0.7)

    alone = zip(*(found(slice(k, k + 1)) for k in range(3)), strict=True)
    for got, parts in zip(found(slice(0, 3)), alone, strict=True):
        assert_close(got, sum(map(np.asarray, parts)) / 3)


def check_gradient(impl, rng, gradcheck, of):
    """Gradcheck the loss along a random direction of vertices (0), albedo (1), light (2), or of
    several together.
    """
    vertices, faces, albedo, light = solid(rng)
    views, targets = several_views(impl, rng)
    directions = [rng.normal(size=part.shape) for part in (vertices, albedo, light)]

    def moved(steps):
        places = [vertices, albedo, light]
        for part, step in zip(of, steps, strict=True):
            places[part] = places[part] + step * directions[part]
        return impl.views_loss_and_gradients(places[0], faces, *places[1:], views, targets, 0.7)

    def backward(grad_loss, steps):
        gradients = moved(steps)[1:4]
        return grad_loss * np.array([(np.asarray(gradients[part]) * directions[part]).sum()
                                     for part in of])

    gradcheck(lambda steps: np.array(moved(steps)[0]), backward, (np.zeros(len(of)),),
              name="the step")


@exercise("16.9")
def test_the_gradient_of_the_albedo_is_central_differences(impl, rng, gradcheck):
    """grad_albedo: grad_colours comes as it is, without the light of shade_backward; or views,
    pictures or the forward pass's normals are not those of the way there.
    """
    check_gradient(impl, rng, gradcheck, [1])


@exercise("16.9")
def test_the_gradient_of_the_light_is_central_differences(impl, rng, gradcheck):
    """grad_light: it is wrong where light comes from several sides or the albedo is uneven."""
    check_gradient(impl, rng, gradcheck, [2])


@exercise("16.9")
def test_the_gradient_of_the_vertices_is_central_differences(impl, rng, gradcheck):
    """grad_vertices: of its two ways, that through the normals or that through the pictures is
    missing, overwrites the other or has a minus: they are to be added. Coverage's weight is not
    passed to picture_loss_backward. render_views_backward gets the albedo for the colours.
    """
    check_gradient(impl, rng, gradcheck, [0])


@exercise("16.9")
def test_the_whole_step_is_central_differences(impl, rng, gradcheck):
    """A way back is missing: through outlines, normals, shading, or paint."""
    check_gradient(impl, rng, gradcheck, [0, 1, 2])
