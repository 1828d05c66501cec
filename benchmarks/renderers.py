"""The renderers of benchmarks/peers.py: ours twice, DRTK, DEODR and llvmpipe, each in its own way.

Each is a function scene -> {work: call}. WORK names what a call can do, from clip positions on.
None does quite the same as another; its docstring says what differs. "covered" is a call, too, and
tells what was seen: a face index, or a mask of pixels.
"""
from typing import NamedTuple

import numpy as np

from course.given.compiled import is_installed, without_kernels
from reference import (
    antialiasing,
    compiled_pipeline,
    interpolation,
    outlines,
    pipeline,
    rasterization,
    transforms,
)

WORK = {"visible": "Face index and depth",
        "interpolated": "With barycentrics and 3 attributes",
        "both ways": "Forward and backward, with silhouettes"}


class Scene(NamedTuple):
    """A mesh on a square screen."""

    faces: np.ndarray       # (F, 3)
    clip: np.ndarray        # (V, 4)
    attributes: np.ndarray  # (V, 3)
    gradient: np.ndarray    # (size, size, 3), of a loss with respect to the picture
    opposite: np.ndarray    # (F, 3) of lab 8, made once for a mesh


def scene(faces, clip, size):
    """A Scene with random attributes and a random gradient."""
    rng = np.random.default_rng(0)
    return Scene(faces, clip, rng.random((len(clip), 3)), rng.normal(size=(size, size, 3)),
                 antialiasing.opposite_corners(faces))


def plain(scene):
    """This course: NumPy, float64."""
    faces, clip, attributes, gradient, _ = scene
    size = len(gradient)

    def interpolated():
        seen = without_kernels(pipeline.visible)(clip, faces, size, size)
        return interpolation.interpolate(attributes, faces, seen.face_index, seen.barycentric)

    return {"visible": lambda: rasterization.rasterize(clip, faces, size, size),
            "interpolated": interpolated, "both ways": drawn_and_back(scene, without_kernels),
            "covered": lambda: rasterization.rasterize(clip, faces, size, size)[0]}


def compiled(scene):
    """This course: its kernels, compiled by numba, float64."""
    if not is_installed():
        raise ImportError("numba is not there")
    faces, clip, attributes, gradient, _ = scene
    size = len(gradient)

    def interpolated():
        points, face_index, _ = compiled_pipeline.seen(clip, faces, size, size)
        return compiled_pipeline.coloured(face_index, points, faces, attributes, (0.0, 0.0, 0.0))

    return {"visible": lambda: compiled_pipeline.rasterize(clip, faces, size, size),
            "interpolated": interpolated, "both ways": drawn_and_back(scene, lambda draw: draw),
            "covered": lambda: compiled_pipeline.rasterize(clip, faces, size, size)[0]}


def drawn_and_back(scene, form):
    """A call: this course's forward and backward. form: `without_kernels`, or as they are."""
    faces, clip, attributes, gradient, opposite = scene
    material, size = pipeline.Colours(attributes), len(gradient)

    def call():
        _, buffers = form(pipeline.draw)(clip, faces, opposite, material, size, size, np.zeros(3))
        return form(pipeline.draw_backward)(gradient, buffers, faces, material)

    return call


def drtk(scene):
    """C++, float32. It blends nothing: on the way back the nearer face's point at its own pixel's
    centre pulls, wherever neighbours see different surfaces, as its rule tells them apart.
    """
    import drtk
    import torch
    torch.set_num_threads(1)
    faces, clip, attributes, gradient, _ = scene
    size = len(gradient)
    c, a, g = (torch.tensor(values, dtype=torch.float32)[None]
               for values in (clip, attributes, gradient.transpose(2, 0, 1)))
    vi = torch.tensor(faces.astype(np.int32))[None]

    def on_screen(clip):
        x, y, _, w = clip.unbind(-1)
        half = size / 2
        return torch.stack([x / w * half + half - 0.5, y / w * half + half - 0.5, w], -1)

    def interpolated():
        v = on_screen(c)
        index = drtk.rasterize(v, vi, size, size)
        _, weights = drtk.render(v, vi, index)
        return drtk.interpolate(a, vi, index, weights)

    def both_ways():
        vertices, colours = (tensor.clone().requires_grad_() for tensor in (c, a))
        position = on_screen(vertices)
        index = drtk.rasterize(position, vi, size, size)
        _, weights = drtk.render(position, vi, index)
        picture = drtk.interpolate(colours, vi, index, weights) * (index >= 0)[:, None]
        picture = drtk.edge_grad_estimator(position, vi, weights, picture, index)
        picture.backward(g)
        return colours.grad[0].numpy(), vertices.grad[0].numpy()

    return {"visible": lambda: drtk.rasterize_with_depth(on_screen(c), vi, size, size),
            "interpolated": interpolated, "both ways": both_ways,
            "covered": lambda: drtk.rasterize(on_screen(c), vi, size, size)[0].numpy()}


def deodr(scene):
    """C++, float64. It starts from points on the screen, culls back faces and knows no perspective.
    Silhouettes are overdrawn by a pixel, and given to it. Its way back includes a squared error.
    """
    from deodr.differentiable_renderer import Scene2D
    faces, clip, attributes, gradient, opposite = scene
    size = len(gradient)
    x, y, w = rasterization.screen_points(clip, size, size)
    across = outlines.vertices_across(faces, opposite)
    silhouette = antialiasing.silhouette_edges(x, y, w, faces, across)
    corners = np.ascontiguousarray(faces, np.uint32)
    peer = Scene2D(
        ij=np.stack([x, y], -1), depths=w, faces=corners, faces_uv=corners,
        colors=attributes.copy(), shade=np.ones(len(w)), uv=np.zeros((len(w), 2)),
        texture=np.zeros((2, 2, 3)), textured=np.zeros(len(faces), bool),
        shaded=np.zeros(len(faces), bool),
        edgeflags=silhouette[:, [2, 0, 1]].copy(),  # from vertex k to the next one
        height=size, width=size, nb_colors=3, background_image=None,
        background_color=np.zeros(3), clockwise=False, backface_culling=True,
        integer_pixel_centers=False)
    if (peer.render(sigma=1)[0] != 0).any(-1).mean() < 0.1:  # it sees the back faces
        peer.clockwise = True
    target = peer.render(sigma=1)[0] - gradient / 2  # the error's gradient is twice the difference

    def both_ways():
        peer.clear_gradients()
        peer.render_compare_and_backward(sigma=1, antialiase_error=False, obs=target)
        grad_screen = np.column_stack([peer.ij_b, np.zeros(len(w))])
        return peer.colors_b, transforms.to_screen_backward(grad_screen, clip, size, size)

    return {"interpolated": lambda: peer.render(sigma=0), "both ways": both_ways,
            "covered": lambda: (peer.render(sigma=0)[0] != 0).any(-1)}


FACE = ("""#version 430
in vec4 position;
void main() { gl_Position = position; }""", """#version 430
layout(location = 0) out int face;
void main() { face = gl_PrimitiveID + 1; }""")
INTERPOLATED = ("""#version 430
in vec4 position;
in vec3 given;
out vec3 colour;
void main() { gl_Position = position; colour = given; }""", """#version 430
in vec3 colour;
layout(location = 0) out int face;
layout(location = 1) out vec3 mixed;
void main() { face = gl_PrimitiveID + 1; mixed = colour; }""")


def llvmpipe(scene):
    """OpenGL on the processor (Mesa), float32, vertices rounded to 1/256 pixel. Its time includes
    sending the positions and reading the pictures back. Attributes come without barycentrics.
    """
    import moderngl
    context = moderngl.create_context(standalone=True, backend="egl")
    if "llvmpipe" not in context.info["GL_RENDERER"]:
        raise RuntimeError(f"OpenGL is {context.info['GL_RENDERER']}, not llvmpipe")
    context.enable(moderngl.DEPTH_TEST)
    faces, clip, attributes, gradient, _ = scene
    size = gradient.shape[:2]
    face = context.texture(size, 1, dtype="i4")
    colour = context.texture(size, 3, dtype="f4")
    depth = context.depth_texture(size)
    indices = context.buffer(faces.astype("i4"))

    def drawing(shaders, pictures, **values):
        """A call that sends the positions, draws, and reads the pictures and the depth back."""
        buffer = context.buffer(clip.astype("f4"))
        content = [(buffer, "4f", "position")]
        content += [(context.buffer(value.astype("f4")), "3f", name)
                    for name, value in values.items()]
        mesh = context.vertex_array(context.program(*shaders), content, index_buffer=indices)
        target = context.framebuffer(pictures, depth)
        found = {texture: np.empty((*size, texture.components), texture.dtype)
                 for texture in [*pictures, depth]}

        def call():
            buffer.write(clip.astype("f4"))
            target.use()
            target.clear()
            mesh.render()
            for texture, pixels in found.items():
                texture.read_into(pixels)
            return found[face][..., 0] - 1

        return call

    visible = drawing(FACE, [face])
    return {"visible": visible, "covered": visible,
            "interpolated": drawing(INTERPOLATED, [face, colour], given=attributes)}


PEERS = {
    "compiled": (compiled, "pip install -r requirements-numba.txt"),
    "DRTK": (drtk, "build github.com/facebookresearch/DRTK, not the package of this name on PyPI"),
    "llvmpipe": (llvmpipe, "pip install moderngl, and Mesa (apt install libegl1 libgl1-mesa-dri)"),
    "DEODR": (deodr, "pip install deodr"),
}


def installed():
    """{name: function} of the PEERS that are there. What is missing or fails is told in a line."""
    triangle = np.array([[0, 1, 2]])
    clip = np.array([[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]])
    found = {}
    for name, (peer, how) in PEERS.items():
        try:
            for call in peer(scene(triangle, clip, 64)).values():
                call()
            found[name] = peer
        except Exception as error:  # no package, another version, no driver
            print(f"{name} is left out, {type(error).__name__}: {error}. For it, {how}")
    return found


def prepare(peers, scene):
    """{name: calls} of NumPy and of peers. RuntimeError if one draws another picture."""
    found = {name: peer(scene) for name, peer in {"NumPy": plain, **peers}.items()}
    expected = found["NumPy"]["covered"]()
    for name, calls in found.items():
        seen = calls["covered"]()
        wanted = expected >= 0 if seen.dtype == bool else expected
        different = (seen != wanted).mean()
        if different > 0.01:  # more than where vertices are rounded
            raise RuntimeError(f"{name} sees something else than NumPy in {different:.1%} of "
                               "pixels")
    return found
