"""The pictures of apps/bridge/README.md, one for each question: -m course.upkeep.questions.

Positions are x and y in pixels, and a depth from -1 to 1. Gradients are per pixel.
"""
import io

import matplotlib as mpl
import numpy as np

from ..given import mesh, places, plot, sketch
from ..given.whose import Labs
from . import pictures

labs = Labs()
pipeline, error = labs.pipeline, labs.inverse_rendering
TINY = 1e-6  # a step that no pixel's face or pair changes in
ONE = [[0, 1, 2]]
FAN = np.array([[k, (k + 1) % 6, 6] for k in range(6)])


def scene(positions, faces, paint, width=16, height=16, background=1.0):
    """What `render` takes: paint is (V, C)."""
    paint, screen = np.array(paint), labs.transforms.scale([2 / width, 2 / height, 1])
    view = pipeline.View(labs.transforms.translate([-1, -1, 0]) @ screen, width, height,
                         np.full(paint.shape[1], background))
    return pipeline.make_mesh(np.array(positions), np.array(faces)), pipeline.Colours(paint), view


def hexagon(x):
    """Six corners, and a seventh between them at (x, 8): (7, 3)."""
    angle = np.arange(6) * np.pi / 3 + 0.2
    return np.vstack([8 + 7 * np.stack([np.cos(angle), np.sin(angle)], 1), [x, 8]]) @ np.eye(2, 3)


def changes(mesh, paint, view, step):
    """Of each pixel (H, W) for a step of vertices: before antialiasing, and after it."""
    (after, buffers), (before, buffers_before) = (pipeline.render(mesh._replace(
        positions=mesh.positions + way * step), paint, view) for way in (0.5, -0.5))
    return (buffers.colour - buffers_before.colour).mean(2), (after - before).mean(2)


def no_gradient():
    """A vertex moves: the loss without and with antialiasing, and their slopes."""
    def at(x, target):
        triangle = scene([[2.6, 1.4, 0], [x, 2.3, 0], [5.2, 9.2, 0]], ONE, 3 * [[0.0]], 16, 11)
        picture, buffers = pipeline.render(*triangle)
        losses = [error.squared_error(each, target) for each in (buffers.colour, picture)]
        grad = error.squared_error_backward(1.0, picture, target)
        slope = pipeline.render_backward(grad, buffers, *triangle).positions[1, 0]
        return picture, np.array(losses), np.array([0, slope])

    target, xs = at(11.7, 0)[0], np.linspace(6.5, 14.2, 771)
    left, chart = plot.panels([(11, 16)] * 2)
    plot.image(left, at(7.3, target)[0][..., 0], "A vertex moves to its target, in red")
    sketch.line(left, (2.6, 1.4), (11.7, 2.3), (5.2, 9.2), color=plot.RED, closed=True)
    sketch.arrow(left, (7.3, 2.3), (11.5, 2.3), "x", plot.RED, width=2.4)
    plot.chart(chart).set(aspect="auto", xlabel="x of the vertex", title="Its loss, with slopes")
    chart.set_prop_cycle(color=[plot.PALE, plot.BLUE])
    chart.plot(xs, [at(x, target)[1] for x in xs], label=["without antialias", "with antialias"])
    for x, (_, loss, slope) in ((x, at(x, target)) for x in (7.3, 9.0, 13.2)):
        chart.plot([x - 0.6, x + 0.6], [loss - 0.6 * slope, loss + 0.6 * slope], plot.RED, zorder=3)
    chart.legend()
    return left


def inside():
    """What changes with a vertex: the inside, and by antialiasing the outline."""
    triangle = scene([[2.6, 2.4, 0], [12.1, 3.3, 0], [5.2, 13.6, 0]], ONE, [[0.9], [0.1], [0.5]])
    axes = plot.panels([(16, 16)] * 3)
    plot.image(axes[0], pipeline.render(*triangle)[0][..., 0], "A vertex moves right")
    sketch.arrow(axes[0], (12.1, 3.3), (14.9, 3.3), "", plot.RED, width=2.4)
    before, after = changes(*triangle, TINY * np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0]]))
    plot.signed(axes[1], before / TINY, "Through interpolate: the inside changes", 0.1)
    plot.signed(axes[2], (after - before) / TINY, "Through antialias: the outline changes", 0.1)
    return axes[0]


def attributes():
    """The colours that antialiased u and v look up, beside antialiased colours."""
    blended, buffers = pipeline.render(*scene(hexagon(8), FAN, 0.5 + hexagon(8)[:, :2] / 36,
                                              background=0.0))
    texture = mpl.colormaps["turbo"](np.broadcast_to(np.linspace(0, 1, 32), (32, 32)))[..., :3]
    right, wrong = (np.where(buffers.face_index[..., None] < 0, 1, labs.mipmapping.texture(
        texture, u_v)) for u_v in (buffers.colour, blended))
    axes = plot.panels([(32, 32), (16, 16), (16, 16)])
    plot.image(axes[0], texture, "A texture, and what is used of it")
    sketch.line(axes[0], *(16 + hexagon(8)[:6, :2] * 32 / 36), closed=True)
    plot.image(axes[1], labs.antialiasing.blend_pairs(right, buffers.pairs),
               "Right: looked up, then antialiased")
    plot.image(axes[2], wrong, "Wrong: u and v antialiased, then looked up")
    return axes[0]


def piercing():
    """Two triangles pierce each other: what changes as one moves, and what is known of it."""
    two, paint, view = scene([[1.6, 3.2, -0.5], [14.4, 2.3, 0.5], [7.4, 14.6, 0],
                              [2.2, 13.4, 0.7], [15.1, 12.6, -0.3], [8.6, 1.3, -0.2]],
                             [*ONE, [3, 4, 5]], [[0.1, 0.35, 0.6]] * 3 + [[0.95, 0.65, 0.1]] * 3)
    right, fine = np.repeat([[0, 0, 0], [1, 0, 0]], 3, 0), view._replace(width=512, height=512)
    samples = changes(two, paint, fine, 0.5 * right)[0] / 0.5
    axes = plot.panels([(16, 16)] * 3)
    plot.image(axes[0], pipeline.render(two, paint, view)[0], "Orange pierces blue, moves right")
    plot.signed(axes[1], samples.reshape(16, 32, 16, 32).mean((1, 3)),
                "What changes: outlines, and where orange pierces blue", 0.3)
    plot.signed(axes[2], changes(two, paint, view, TINY * right)[1] / TINY,
                "What has a gradient: outlines", 0.3)
    return axes[0]


def corners():
    """The pixels that are blended, with shared vertices and with three for each face."""
    ring, faces = mesh.torus(400)
    turned = ring @ labs.transforms.rotate([1, 0.3, 0], 0.9)[:3, :3].T
    placed = turned * [31, 31, -0.3] + [48, 44, 0]
    shades = 0.2 + 0.7 * np.clip(mesh.vertex_normals(ring, faces) @ [[-0.2], [0.9], [0.3]], 0, 1)
    axes = plot.panels([(96, 96)] * 3)
    for place, title, used, own in (
            (axes[1], "Shared vertices", np.arange(len(ring)), faces),
            (axes[2], "Three for each face", faces.ravel(), np.arange(faces.size).reshape(-1, 3))):
        picture, buffers = pipeline.render(*scene(placed[used], own, shades[used], 96, 96))
        pairs, marked = buffers.pairs, 0.5 + 0.5 * picture.repeat(3, -1)
        marked.reshape(-1, 3)[[pairs.owner, pairs.other]] = mpl.colors.to_rgb(plot.RED)
        plot.image(place, marked, f"{title}: {len(pairs.c):,} pairs are blended")
    plot.image(axes[0], picture[..., 0], "A ring")
    return axes[0]


def numbers():
    """One mesh, numbered in two orders: the number that a pixel sees, as a vertex moves."""
    *axes, chart = plot.panels([(16, 16)] * 3)
    plot.chart(chart).set(aspect="auto", yticks=range(6), xlabel="x of the vertex",
                          title="The dotted pixel's number")
    for place, order, color, title in (
            (axes[0], FAN, plot.BLUE, "Numbered in one order"),
            (axes[1], FAN[[4, 1, 5, 2, 0, 3]], plot.ORANGE, "The same triangles in another")):
        seen = {x: pipeline.render(*scene(hexagon(x), order, 7 * [[0.0]]))[1].face_index
                for x in np.linspace(7, 13, 601)}
        plot.face_index(place, seen[7], title)
        plot.wireframe(place, hexagon(7), order)
        sketch.arrow(place, (7, 8), (12, 8), "x", plot.RED)
        sketch.dot(place, (10.5, 12.5), color=color)
        for number, face in enumerate(order):
            sketch.label(place, hexagon(7)[face, :2].mean(0), str(number))
        chart.plot(seen.keys(), [face_index[12, 10] for face_index in seen.values()], color=color)
    return chart


if __name__ == "__main__":
    plot.style()
    for question in no_gradient, inside, attributes, piercing, corners, numbers:
        drawn = io.BytesIO()
        question().figure.savefig(drawn, dpi=200)
        (places.ROOT / "apps/bridge" / f"{question.__name__}.png").write_bytes(
            pictures.packed(drawn.getvalue())[0])
