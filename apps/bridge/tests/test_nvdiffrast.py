"""nvdiffrast's interface: its kernels' numbers through tensors (tests/golden/README.md)."""
import numpy as np
import pytest
from look_up_goldens import configs, require_look_ups

torch = pytest.importorskip("torch", reason="PyTorch is not installed: requirements.txt")
from torch.autograd import gradcheck  # noqa: E402

from apps.bridge.nvdiffrast import pixels  # noqa: E402
from apps.bridge.nvdiffrast import torch as dr  # noqa: E402

PIXELS, BACK, ATTRIBUTES, TEXTURES, CUBES, OUTLINES = (
    dict(np.load(f"tests/golden/{name}.npz")) for name in (
        "rasterize", "rasterize_gradients", "interpolate", "texture", "cube_maps", "antialias"))
TEXTURES |= {key.replace("faces", "image").replace("directions", "uv"): array
             for key, array in CUBES.items()}
CONTEXT = dr.RasterizeCudaContext()


def scenes(golden):
    return pytest.mark.parametrize("scene", sorted({key.split("/")[0] for key in golden}))


def of(golden, scene, *keys):
    """These arrays of a scene, each as a batch of one float32 tensor that takes gradients."""
    return [torch.tensor(golden[f"{scene}/{key}"][None], dtype=torch.float32, requires_grad=True)
            for key in keys]


def faces_of(golden, scene):
    return torch.tensor(golden[f"{scene}/faces"].astype(np.int32))


def rast_of(golden, scene):
    """What rasterize() gives, made of a scene's parts."""
    face_index = golden[f"{scene}/face_index"].astype(np.float32)
    uv = golden.get(f"{scene}/uv", np.zeros((*face_index.shape, 2)))
    depth = golden.get(f"{scene}/depth", face_index)
    rast = np.dstack([uv, np.where(face_index < 0, 0, depth), face_index + 1])
    return torch.tensor(rast[None], dtype=torch.float32, requires_grad=True)


def require_near(got, expected, tolerance):
    """tolerance: of the largest."""
    np.testing.assert_allclose(got.detach(), expected, 0, tolerance * np.abs(expected).max())


@scenes(PIXELS)
def test_pixels_are_those_of_nvdiffrast(scene):
    """A channel or a face's number is another one."""
    pos, = of(PIXELS, scene, "clip")
    size = PIXELS[f"{scene}/face_index"].shape
    rast, rast_db = dr.rasterize(CONTEXT, pos, faces_of(PIXELS, scene), size)
    assert rast.dtype == torch.float32
    np.testing.assert_array_equal(rast[0, ..., 3].detach(), PIXELS[f"{scene}/face_index"] + 1)
    np.testing.assert_allclose(rast[0, ..., :2].detach(), PIXELS[f"{scene}/uv"], 0, 1e-4)
    np.testing.assert_allclose(rast[0, ..., 2].detach(), rast_of(PIXELS, scene)[0, ..., 2].detach(),
                               0, 2e-5)
    require_near(rast_db[0].reshape(*size, 2, 2), PIXELS[f"{scene}/derivatives"], 3e-5)


@scenes({key for key in OUTLINES if key.startswith("gridaligned") or "snapped" in key})
def test_rounded_vertices_are_where_nvdiffrast_rounds_them(scene, monkeypatch):
    """Ties go wrong, on a screen where their places are not exact, or rounding is another one."""
    monkeypatch.setattr(pixels, "GRID", 16)
    pos, face_index = of(OUTLINES, scene, "clip", "face_index")
    # The same pixels, in a corner of a larger screen:
    pos.data[..., :2] = (pos[..., :2] + pos[..., 3:]) * torch.tensor([0.64, 0.8]) - pos[..., 3:]
    rast, _ = dr.rasterize(CONTEXT, pos, faces_of(OUTLINES, scene), (80, 100))
    assert torch.equal(rast[:, :64, :64, 3], face_index + 1)


@scenes(BACK)
def test_gradients_of_pixels_are_those_of_nvdiffrast(scene):
    """What comes by z/w or by a face's number counts; grad_db=False is not heard."""
    for grad_db, key in (True, "grad_clip_derivatives_32"), (False, "grad_clip_32"):
        pos, = of(PIXELS, scene, "clip")
        rast, rast_db = dr.rasterize(CONTEXT, pos, faces_of(PIXELS, scene),
                                     PIXELS[f"{scene}/face_index"].shape, grad_db=grad_db)
        upstream = torch.ones_like(rast)
        upstream[0, ..., :2] = torch.tensor(BACK[f"{scene}/twice_grad_uv"] / 2)
        by_db = torch.tensor(BACK[f"{scene}/twice_grad_derivatives"] / 2).reshape(rast_db.shape)
        torch.autograd.backward((rast, rast_db), (upstream, by_db))
        require_near(pos.grad[0], BACK[f"{scene}/{key}"], 1e-4)


@scenes(ATTRIBUTES)
def test_attributes_are_those_of_nvdiffrast(scene):
    """diff_attrs are taken in another order, or their gradients do not add to the attributes'."""
    attr, rast_db, grad = of(ATTRIBUTES, scene, "attributes", "derivatives", "grad_output")
    rast, tri = rast_of(ATTRIBUTES, scene), faces_of(ATTRIBUTES, scene)
    rast_db = rast_db.detach().flatten(-2).requires_grad_()
    chosen = ATTRIBUTES[f"{scene}/chosen"].tolist()
    out, out_da = dr.interpolate(attr, rast, tri, rast_db, chosen)
    require_near(out[0], ATTRIBUTES[f"{scene}/output"], 2e-6)
    require_near(out_da[0].reshape(*out.shape[1:3], -1, 2),
                 ATTRIBUTES[f"{scene}/output_derivatives"], 2e-6)
    by_attr, by_rast = torch.autograd.grad(out, (attr, rast), grad, retain_graph=True)
    require_near(by_attr[0], ATTRIBUTES[f"{scene}/grad_attributes"], 3e-5)
    require_near(by_rast[0, ..., :2], ATTRIBUTES[f"{scene}/grad_uv"], 3e-6)
    assert not by_rast[..., 2:].any()
    by_da = of(ATTRIBUTES, scene, "grad_output_derivatives")[0].flatten(-2)
    by_attr, by_db = torch.autograd.grad((out, out_da), (attr, rast_db), (grad, by_da))
    require_near(by_attr[0], ATTRIBUTES[f"{scene}/grad_attributes_both"], 3e-5)
    require_near(by_db[0].reshape(rast_db.shape[1:]),
                 ATTRIBUTES[f"{scene}/grad_derivatives"].reshape(rast_db.shape[1:]), 3e-6)


def look_up(image, uv, jacobian=None, bias=None, *, filter_mode, boundary, max_level):
    """dr.texture as `mipmapping.texture` -> the colours' tensor, and what it was given."""
    given = [None if part is None else torch.tensor(part.reshape(1, *shape), dtype=torch.float32,
                                                    requires_grad=True)
             for part, shape in ((image, image.shape), (uv, uv.shape), (bias, uv.shape[:2]),
                                 (jacobian, (*uv.shape[:2], -1)))]
    image, uv, bias, jacobian = given
    colour = dr.texture(image, uv, jacobian, bias, filter_mode=filter_mode, boundary_mode=boundary,
                        max_mip_level=max_level)
    return colour, (image, uv, jacobian, bias)


def gradients(grad, *arguments, jacobian=None, **how):
    """As of `mipmapping.texture_backward`, 0 where PyTorch gives none."""
    colour, given = look_up(*arguments, jacobian=jacobian, **how)
    colour.backward(torch.tensor(grad, dtype=torch.float32)[None])
    found = [None if part is None else (0 * part if part.grad is None else part.grad)[0]
             .detach().numpy() for part in given]
    return [*found[:2], None if jacobian is None else found[2].reshape(jacobian.shape), found[3]]


@pytest.mark.parametrize(("scene", "config"), configs(TEXTURES))
def test_textures_are_those_of_nvdiffrast(scene, config):
    """A filter, boundary or level is another one, an axis is another, or a gradient is lost."""
    require_look_ups(lambda **given: look_up(**given)[0][0].detach().numpy(), gradients,
                     ("image", "uv"), TEXTURES, scene, config,
                     boundary=str(TEXTURES.get(f"{scene}/boundary", "cube")))


@scenes(OUTLINES)
def test_outlines_are_those_of_nvdiffrast(scene):
    """The background is not the farthest, or the gradient is not boosted."""
    color, pos, grad = of(OUTLINES, scene, "colour", "clip", "grad_output")
    out = dr.antialias(color, rast_of(OUTLINES, scene), pos, faces_of(OUTLINES, scene),
                       pos_gradient_boost=3.0)
    require_near(out[0], OUTLINES[f"{scene}/output"], 1e-5)
    out.backward(grad)
    require_near(color.grad[0], OUTLINES[f"{scene}/grad_colour"], 1.5e-5)
    require_near(pos.grad[0] / 3, OUTLINES[f"{scene}/grad_clip"], 3e-6)


def made_scene(dtype=torch.float64):
    """Two pictures of two triangles, one before the other: clip (2, 6, 4), faces, size."""
    rng = np.random.default_rng(3)
    clip = np.concatenate([rng.uniform(-1, 1, (2, 6, 2)), np.full((2, 6, 1), 0.5),
                           rng.uniform(1, 1.5, (2, 6, 1))], -1)
    clip[:, 3:, :2] = 0.7 * clip[:, :3, :2] + 0.1
    clip[:, 3:, 2] = -0.5
    faces = torch.tensor([[0, 1, 2], [3, 4, 5]], dtype=torch.int32)
    return torch.tensor(clip, dtype=dtype, requires_grad=True), faces, (9, 12)


def test_gradients_are_central_differences():
    """In float64: by attributes, weights, their derivatives, textures, places, levels, colours."""
    torch.manual_seed(0)
    pos, tri, size = made_scene()
    attr = torch.rand(1, 6, 2, dtype=torch.float64, requires_grad=True)
    seen = dr.rasterize(CONTEXT, pos, tri, size)
    rast, rast_db = (part.detach().requires_grad_() for part in seen)
    free = torch.ones_like(rast) * torch.tensor([1.0, 1, 0, 0])  # z/w and numbers are not moved
    assert gradcheck(lambda attr, move, db: dr.interpolate(
        attr, rast.detach() + free * move, tri, db, "all"),
        (attr, torch.zeros_like(rast).requires_grad_(), rast_db))
    assert gradcheck(lambda pos: [part[..., :2] for part in dr.rasterize(CONTEXT, pos, tri, size)],
                     pos)
    tex = torch.rand(2, 4, 8, 2, dtype=torch.float64, requires_grad=True)
    mips = [torch.rand(2, 2, 4, 2, dtype=torch.float64, requires_grad=True)]
    uv = torch.rand(2, 3, 4, 2, dtype=torch.float64, requires_grad=True)
    uv_da = (0.4 * torch.rand(2, 3, 4, 4, dtype=torch.float64)).requires_grad_()
    bias = torch.rand(2, 3, 4, dtype=torch.float64, requires_grad=True)
    assert gradcheck(dr.texture, (tex, uv, uv_da, bias))
    assert gradcheck(lambda *given: dr.texture(*given[:4], mip=list(given[4:])),
                     (tex, uv, uv_da, bias, *mips))
    color = torch.rand(2, *size, 3, dtype=torch.float64, requires_grad=True)
    assert gradcheck(lambda color: dr.antialias(color, rast.detach(), pos.detach(), tri), color)


def test_a_batch_is_its_pictures_and_ranges_are_meshes():
    """Pictures mix, one texture's gradients are not summed, or a range counts faces from its own.
    """
    pos, tri, size = made_scene(torch.float32)
    both, _ = dr.rasterize(CONTEXT, pos, tri, size)
    for n in (0, 1):
        alone, _ = dr.rasterize(CONTEXT, pos[n:n + 1], tri, size)
        torch.testing.assert_close(both[n:n + 1], alone, rtol=0, atol=0)
    ranges = torch.tensor([[1, 1], [0, 2], [2, 0]], dtype=torch.int32)
    ranged, _ = dr.rasterize(CONTEXT, pos[0], tri, size, ranges)
    assert set(ranged[0, ..., 3].unique().tolist()) == {0, 2} and not ranged[2].any()
    torch.testing.assert_close(ranged[1], both[0], rtol=0, atol=0)
    attr = torch.rand(6, 3, requires_grad=True)
    out, _ = dr.interpolate(attr, ranged.detach(), tri)
    expected, _ = dr.interpolate(attr[None], ranged.detach(), tri)
    torch.testing.assert_close(out, expected, rtol=0, atol=0)
    color = dr.antialias(out, ranged, pos[0], tri)
    color.sum().backward()
    assert attr.grad.abs().sum() > 0 and pos.grad[0].abs().sum() > 0


def test_depth_layers_come_from_near_to_far():
    """A layer is seen twice or left out, or another rasterization gets between."""
    pos, tri, size = made_scene(torch.float32)
    with dr.DepthPeeler(CONTEXT, pos, tri, size) as peeler:
        layers = [peeler.rasterize_next_layer()[0].detach() for _ in range(3)]
        with pytest.raises(RuntimeError, match="DepthPeeler has this context"):
            dr.rasterize(CONTEXT, pos, tri, size)
    alone = [dr.rasterize(CONTEXT, pos, tri[n:n + 1], size)[0][..., 3] > 0 for n in (0, 1)]
    far, near = alone  # the second triangle is nearer
    torch.testing.assert_close(layers[0][..., 3], torch.where(near, 2.0, far.float()))
    torch.testing.assert_close(layers[1][..., 3], (near & far).float())
    assert (near & far).any() and not layers[2].any()
    with pytest.raises(RuntimeError, match="has ended"), peeler:
        pass


def test_levels_can_be_made_before():
    """texture_construct_mip gives other levels than texture makes itself, or no gradient."""
    tex = torch.rand(1, 6, 4, 4, 3, requires_grad=True)
    uv, bias = torch.randn(2, 3, 5, 3), torch.full((2, 3, 5), 1.3)
    found = []
    for mip in None, dr.texture_construct_mip(tex, cube_mode=True):
        colour = dr.texture(tex, uv, mip_level_bias=bias, mip=mip, boundary_mode="cube")
        colour[:, :1] = 0  # as a program may, in a result that has a gradient
        found.append((colour, *torch.autograd.grad(colour.sum(), tex)))
    for one, other in zip(*found, strict=True):
        torch.testing.assert_close(one, other)


@pytest.mark.parametrize("filter_mode", ["nearest", "linear", "linear-mipmap-nearest",
                                         "linear-mipmap-linear"])
def test_a_cube_map_is_the_same_whether_or_not_its_directions_have_gradients(filter_mode):
    """Compiled, it takes another texel beyond an edge or at a corner, another level, or loses one
    on the way back. NumPy looks up where directions have gradients.
    """
    torch.manual_seed(0)
    tex = torch.rand(1, 6, 8, 8, 5, requires_grad=True)
    uv, uv_da = torch.randn(1, 40, 50, 3), 0.4 * torch.randn(1, 40, 50, 6)
    uv[0, 0] = torch.sign(uv[0, 0]) + 0.05 * uv[0, 1]  # around the corners
    uv[0, 1, 0], uv[0, 1, 1], uv[0, 1, 2] = 0, torch.nan, torch.inf
    bias, grad = torch.randn(1, 40, 50), torch.randn(1, 40, 50, 5)
    found = []
    for place in uv, uv.clone().requires_grad_():
        colour = dr.texture(tex, place, uv_da, bias, filter_mode=filter_mode, boundary_mode="cube")
        found.append((colour, *torch.autograd.grad(colour, tex, grad)))
    for one, other in zip(*found, strict=True):
        assert one.any()
        torch.testing.assert_close(one, other, rtol=1e-5, atol=1e-5)


def seen(*given, **named):
    return dr.rasterize(CONTEXT, *given, **named)


def attributes(pos, tri, size, chosen):
    """Of which out_da shows some."""
    return dr.interpolate(pos, *seen(pos, tri, size)[:1], tri, torch.zeros(2, *size, 4), chosen)


ODD = torch.ones(1, 6, 4, 1), torch.zeros(1, 2, 2, 2), torch.ones(1, 2, 2, 4)  # has level 1 alone


@pytest.mark.parametrize(("call", "said"), [
    (lambda pos, tri, size: seen(pos.half(), tri, size), "pos must be of torch.float32, not"),
    (lambda pos, tri, size: seen(pos, tri.long(), size), "tri must be of torch.int32, not"),
    (lambda pos, tri, size: seen(pos.mT.contiguous().mT, tri, size), "pos must be contiguous"),
    (lambda pos, tri, size: seen(pos[..., :3].contiguous(), tri, size), r"the shape \(n, v, 4\)"),
    (lambda pos, tri, size: seen(pos[:0], tri, size), r"nothing of it empty; it has \(0, 6, 4\)"),
    (lambda pos, tri, size: seen(pos[0], tri, size), "or ranges must be given"),
    *((lambda pos, tri, size, row=row: seen(pos[0], tri, size, torch.tensor([row]).int()),
       "first faces and counts, within the 2 of tri; they are") for row in ([1, 2], [-1, 1])),
    (lambda pos, tri, size: seen(pos.to("meta"), tri, size), "pos is on meta: this code works on"),
    *((lambda pos, tri, _, size=size: seen(pos, tri, size), r"\(height, width\), whole numbers")
      for size in ((8.7, 8.2), "88", (8, 0), (8,), 8)),
    (lambda *given: dr.DepthPeeler(CONTEXT, *given, grad_db=1), "must be True or False; it is 1"),
    (lambda *given: attributes(*given, 0), 'be None, "all" or a list of whole numbers; it is 0'),
    (lambda *given: attributes(*given, [0.5]), "list of whole numbers; it is .0.5"),
    (lambda *given: attributes(*given, [4]), "must number some of 4 attributes; it is .4"),
    (lambda pos, tri, size: dr.interpolate(pos, seen(pos, tri, size)[0], tri[:1]),
     "rast sees face 1, and tri has 1: give the faces that rast was made of"),
    (lambda pos, tri, size: dr.interpolate(pos, seen(pos, tri, size)[0], tri + 10**8),
     "face 0 names vertex 100000000"),
    (lambda pos, tri, size: dr.antialias(*2 * seen(pos, tri, size)[:1], pos, tri[:1]), "rast see"),
    (lambda *_: dr.texture(torch.ones(1, 4, 4, 3), torch.ones(4, 4, 2)), r"shape \(n, h, w, 2\)"),
    (lambda *_: dr.texture(torch.ones(1, 4, 4, 3), np.ones((1, 4, 4, 2))), "uv must be a tensor"),
    (lambda *_: dr.texture(*ODD, mip=[]), "mip must be a list of tensors or come from"),
    (lambda *_: dr.texture(*ODD), "no mip level 2, as 3 x 2 cannot be halved"),
    (lambda pos, tri, size: dr.antialias(
        *2 * seen(pos, tri, size)[:1], pos, tri, dr.antialias_construct_topology_hash(tri[:1])),
     r"come from antialias_construct_topology_hash\(tri\)")])
def test_what_does_not_fit_is_said(call, said):
    """A wrong tensor ends deep in the labs, or is taken."""
    pos, tri, size = made_scene(torch.float32)
    with pytest.raises((RuntimeError, ValueError), match=said):
        call(pos.detach(), tri, size)


@pytest.mark.parametrize(("chosen", "channels"), [
    (None, 0), ([], 0), ("all", 4), (np.array([0]), 1), (torch.tensor([0, -1]), 2)])
def test_diff_attrs_may_be_any_list_of_numbers(chosen, channels):
    """An array [0] is as good as False, and gives no derivatives."""
    pos, tri, size = made_scene(torch.float32)
    assert attributes(pos, tri, size, chosen)[1].shape == (2, *size, 2 * channels)


def test_a_face_beyond_2_to_24_has_a_number_of_its_own():
    """float32 holds no whole numbers beyond it: face 2^24 is taken for the one before it.

    Codes: triidx_to_float in nvdiffrast's common.h.
    """
    face = np.array([-1, 0, 2**24 - 1, 2**24, 2**24 + 1, 889192446])
    coded = pixels.coded(face + 1, np.float32)
    np.testing.assert_array_equal(coded[:3], [0, 1, 2**24])
    np.testing.assert_array_equal(coded[3:].view(np.int32) - 0x4A800000, face[3:] + 1)
    rast = np.zeros((6, 4), np.float32)
    rast[:, 3] = coded
    np.testing.assert_array_equal(pixels.faces_of(rast), face)
    tri = torch.zeros((2**24 + 2, 3), dtype=torch.int32)
    tri[-1] = torch.arange(3)
    pos, ranges = made_scene(torch.float32)[0], torch.tensor([[2**24, 2]], dtype=torch.int32)
    rast, _ = seen(pos[0], tri, (9, 12), ranges)
    assert set(pixels.faces_of(rast.detach().numpy()).ravel()) == {-1, 2**24 + 1}


@pytest.mark.parametrize("boundary", ["wrap", "zero", "clamp"])
@pytest.mark.parametrize("odd", [torch.nan, torch.inf, -torch.inf])
def test_a_place_that_is_no_number_spoils_its_pixel_alone(odd, boundary):
    """0 / 0 in the background ends the program. Or it comes back to all texels."""
    tex = torch.rand(1, 4, 4, 1, requires_grad=True)
    uv, uv_da, bias = torch.rand(1, 3, 3, 2), torch.rand(1, 3, 3, 4), torch.zeros(1, 3, 3)
    expected = dr.texture(tex, uv, uv_da, bias, boundary_mode=boundary)
    uv[0, 0, 0], uv_da[0, 1, 1], bias[0, 2, 2] = odd, odd, odd
    found = dr.texture(tex, uv, uv_da, bias, boundary_mode=boundary)
    same = (found == expected)[0, ..., 0]
    assert same.sum() >= 6 and found.isfinite().sum() == (9 if boundary == "clamp" else 8)
    assert torch.autograd.grad(found[:, 1:].sum(), tex)[0].isfinite().all()


def test_the_first_derivative_may_have_a_graph():
    """create_graph=True ends in PyTorch's words about numpy(), or a second derivative is 0."""
    pos, tri, size = made_scene(torch.float32)
    rast, rast_db = dr.rasterize(CONTEXT, pos, tri, size)
    out, out_da = dr.interpolate(pos[..., :2].contiguous(), rast, tri, rast_db, "all")
    colour = dr.antialias(dr.texture(torch.rand(1, 4, 4, 3), out, out_da), rast, pos, tri)
    grad, = torch.autograd.grad((colour**2).sum(), pos, create_graph=True)
    assert grad.any()
    with pytest.raises(RuntimeError, match="once_differentiable"):
        grad.sum().backward()


@pytest.mark.parametrize(("filter_mode", "count"), [
    ("nearest", 1), ("linear-mipmap-nearest", 2), ("linear-mipmap-linear", 4)])
def test_what_a_filter_does_not_follow_has_no_gradient(filter_mode, count):
    """It has zeros, with which Adam decays weights."""
    given = [each.clone().requires_grad_() for each in (*ODD, torch.zeros(1, 2, 2))]
    dr.texture(*given, filter_mode=filter_mode, max_mip_level=1.9).sum().backward()
    assert [each.grad is None for each in given] == [n >= count for n in range(4)]
