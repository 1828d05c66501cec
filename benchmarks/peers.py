"""Other differentiable renderers, for the same picture and its gradient, where they are installed.

A peer is a function (vertices, faces, clip, attributes, size) -> call: call() renders the scene of
benchmarks/pipeline.py once, forward and backward, from a picture of three attributes to vertices.
None of them does quite the same work; its docstring says what is different.
"""
import importlib.util

import numpy as np

from reference import antialiasing, rasterization

BACKGROUND = np.zeros(3)


def calls(*scene):
    """{name: call} of the peers that are installed and work; what fails is told in a line."""
    found = {}
    for name, peer in PEERS.items():
        if importlib.util.find_spec(name):
            try:
                found[name] = peer(*scene)
                found[name]()
            except Exception as error:  # another version, or no compiler for its kernels
                found.pop(name, None)
                print(f"{name} is installed, but failed: {type(error).__name__}: {error}")
    return found


def deodr(vertices, faces, clip, attributes, size):
    """Compiled; interpolates on the screen, without perspective; overdraws silhouettes by a pixel.

    Its time includes the squared error to a target. Which edges are silhouettes is given to it.
    """
    from deodr.differentiable_renderer import Scene2D
    x, y, w = rasterization.screen_points(clip, size, size)
    silhouette = antialiasing.silhouette_edges(x, y, w, faces,
                                               antialiasing.opposite_vertices(faces))
    edgeflags = silhouette[:, [2, 0, 1]].copy()  # from vertex k to the next one
    corners = np.ascontiguousarray(faces, np.uint32)
    scene = Scene2D(
        ij=np.stack([x, y], -1), depths=w, faces=corners, faces_uv=corners,
        colors=attributes.copy(), shade=np.ones(len(w)), uv=np.zeros((len(w), 2)),
        texture=np.zeros((2, 2, 3)), textured=np.zeros(len(faces), bool),
        shaded=np.zeros(len(faces), bool), edgeflags=edgeflags, height=size, width=size,
        nb_colors=3, background_image=None, background_color=BACKGROUND, clockwise=False,
        backface_culling=True, integer_pixel_centers=False)
    covered = (scene.render(sigma=1)[0] != 0).any(-1).mean()
    if covered < 0.1:  # it sees the back faces
        scene.clockwise = True
    target = np.zeros((size, size, 3))
    return lambda: scene.render_compare_and_backward(sigma=1, antialiase_error=False, obs=target)


def pytorch3d(vertices, faces, clip, attributes, size):
    """Compiled, on the CPU; one face for each pixel, with perspective; no silhouettes at all."""
    import torch
    from pytorch3d.ops import interpolate_face_attributes
    from pytorch3d.renderer.mesh.rasterize_meshes import rasterize_meshes
    from pytorch3d.structures import Meshes
    torch.set_num_threads(1)
    xyz = np.concatenate([-clip[:, :2] / clip[:, 3:], clip[:, 3:]], 1)  # its x runs left, y up
    position = torch.tensor(xyz, dtype=torch.float32, requires_grad=True)
    colour = torch.tensor(attributes, dtype=torch.float32, requires_grad=True)
    face = torch.tensor(faces.astype(np.int64))

    def call():
        seen, _, barycentric, _ = rasterize_meshes(
            Meshes([position], [face]), image_size=size, blur_radius=0.0, faces_per_pixel=1,
            perspective_correct=True)
        interpolate_face_attributes(seen, barycentric, colour[face]).sum().backward()

    return call


def mitsuba(vertices, faces, clip, attributes, size):
    """A path tracer, compiled, on the CPU's threads; 16 samples a pixel; silhouettes included."""
    import drjit
    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")
    ball = mi.Mesh("ball", len(vertices), len(faces))
    traversed = mi.traverse(ball)
    traversed["vertex_positions"] = vertices.astype(np.float32).ravel()
    traversed["faces"] = faces.astype(np.uint32).ravel()
    traversed.update()
    scene = mi.load_dict({
        "type": "scene", "ball": ball, "light": {"type": "constant"},
        "integrator": {"type": "direct_projective"},
        "sensor": {"type": "perspective", "fov": 48.0,
                   "to_world": mi.ScalarTransform4f().look_at([0, 0, 3], [0, 0, 0], [0, 1, 0]),
                   "film": {"type": "hdrfilm", "width": size, "height": size}}})
    parameters = mi.traverse(scene)
    key = next(name for name in parameters.keys() if name.endswith("vertex_positions"))

    def call():
        drjit.enable_grad(parameters[key])
        parameters.update()
        drjit.backward(drjit.sum(mi.render(scene, parameters, spp=16), axis=None))
        drjit.eval(drjit.grad(parameters[key]))
        drjit.sync_thread()

    return call


PEERS = {peer.__name__: peer for peer in (deodr, pytorch3d, mitsuba)}
