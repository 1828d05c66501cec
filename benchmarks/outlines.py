"""How right are gradients through outlines? python3 benchmarks/outlines.py

A loss is the picture times a smooth weight, summed. Its derivatives by eleven motions of a mesh are
compared with those of a fine picture, by differences. For each scene and method, in %:

    share   of the exact derivative by scale, mean over positions
    bias    |mean over positions - exact|, over all motions, relative
    spread  standard deviation over positions, over all motions, relative

Positions are shifts of the camera by parts of a pixel.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure, renderers
from course.given import mesh
from reference import interpolation, intersections, outline_walk, outlines, pipeline, transforms

EXACT = 2048             # pixels on a side of the pictures whose differences count as exact
STEP = 0.01              # of these differences
SIZES = {64: 100, 512: 5}  # pixels on a side, and positions; of a million faces a tenth
SCENES = [("ball", 1_000), ("ball", 10_000), ("ball", 100_000), ("ball", 1_000_000), ("box", 12),
          ("box", 10_000), ("bunny", 3_674), ("bumpy ball", 10_000), ("coloured torus", 30_000),
          ("small ball before a large one", 1_500), ("small ball before a large one", 30_000),
          ("balls through each other", 1_500)]


def main():
    facts = measure.begin()
    found = renderers.installed()
    peers = {name: found[name] for name in ("DRTK", "DEODR") if name in found}
    rows = [row for scene in SCENES for row in lines_of(*scene, peers)]
    measure.show(rows)
    measure.save("outlines", {**facts, "share / bias / spread": rows})


def lines_of(name, face_count, peers):
    """The lines of the table for one shape, one for each size."""
    positions, faces, colours, moves = shape(name, face_count)
    ways = moves[:, None, None] * motions(positions)
    exact = np.array([derivative(positions, faces, colours, ways[:, k]) for k in range(11)])
    for size, count in SIZES.items():
        found = {}
        count = count if len(faces) < 500_000 else -(-count // 10)
        for shift in np.random.default_rng(0).uniform(-0.5, 0.5, (count, 2)):
            camera = transforms.translate(np.append(2 * shift / size, 0)) @ measure.CLIP_FROM_WORLD
            clip = pipeline.to_clip(positions, camera)
            scene = renderers.scene(faces, clip, size)._replace(
                attributes=colours, gradient=weight(size, shift) * (EXACT / size)**2)
            for method, grad_clip in gradients(scene, peers):
                by_motion = np.einsum("vc,vkc->k", grad_clip @ camera[:, :3], ways)
                found.setdefault(method, []).append(by_motion)
        line = {"scene": name, "faces": len(faces), "pixels": size}
        yield {**line, **{method: told(values, exact) for method, values in found.items()}}


def told(values, exact):
    """share / bias / spread of derivatives (positions, motions)."""
    mean, length = np.mean(values, 0), np.linalg.norm(exact)
    parts = mean[0] / exact[0], np.linalg.norm(mean - exact) / length, np.linalg.norm(
        np.std(values, 0)) / length
    return " / ".join(f"{100 * part:.1f}" for part in parts)


def gradients(scene, peers):
    """Yield (method, grad_clip (V, 4)) of a renderers.Scene."""
    faces, clip, attributes, gradient, opposite = scene
    size, colours = len(gradient), pipeline.Colours(attributes)
    seen = pipeline.visible(clip, faces, size, size)
    seen = pipeline.shade(seen, faces, colours, np.zeros(3))
    edges = seen.face_index, seen.depth, clip, faces, opposite
    for method, pairs in ("nvdiffrast's rule", outlines.blended_pairs(*edges)), (
            "walk", intersections.all_pairs(*edges)):
        grad_colour, through_edges = intersections.all_pairs_backward(
            gradient, seen.colour, pairs, clip, faces)
        yield method, through_edges + pipeline.interior_backward(grad_colour, seen, faces,
                                                                 colours)[1]
    pull = outline_walk.outline_pull_backward(gradient, seen.colour,
                                              outline_walk.both_pairs(*edges)[0], clip)
    yield "pull", pull + pipeline.interior_backward(gradient, seen, faces, colours)[1]
    for name, peer in peers.items():
        yield name, peer(scene)["both ways"]()[1]


def derivative(positions, faces, colours, motion):
    """The loss of a hard picture of EXACT^2 pixels, by a motion (V, 3) of the positions."""
    def loss(x):
        clip = pipeline.to_clip(x, measure.CLIP_FROM_WORLD)
        seen = pipeline.visible(clip, faces, EXACT, EXACT)
        picture = interpolation.interpolate(colours, faces, seen.face_index, seen.barycentric)
        return (picture * weight(EXACT, np.zeros(2))).sum()

    return (loss(positions + STEP * motion) - loss(positions - STEP * motion)) / (2 * STEP)


def weight(size, shift):
    """The loss's weight (size, size, 3), which goes with a picture that is shifted by pixels."""
    x, y = (2 * (np.arange(size) + 0.5 - s) / size - 1 for s in shift)
    return np.repeat(1 + 1.3 * np.sin(2 * x + 0.5) * np.cos(3 * y[:, None] - 0.4), 3).reshape(
        size, size, 3)


def motions(x):
    """Of points (V, 3): growing, along x and y, turning, four waves, a bump -> (V, 11, 3)."""
    axes = np.eye(3)
    turns = [np.cross(axis, x) for axis in axes]
    waves = [np.sin(4 * x @ axes[[k % 3]].T + k) * axes[(k + 1) % 3] for k in range(4)]
    bump = np.exp(-((x - [0.8, 0.5, 0])**2).sum(1, keepdims=True) / 0.3**2) * x
    along = [np.tile(axis, (len(x), 1)) for axis in axes[:2]]
    return np.stack([x, *along, *turns, *waves, bump], 1)


def shape(name, face_count):
    """positions (V, 3), faces, colours (V, 3), and which vertices move (V,)."""
    if "one" in name or "other" in name:
        return two_balls(face_count, "through" in name)
    x, faces = {"ball": mesh.icosphere, "box": mesh.cube, "bumpy ball": mesh.icosphere,
                "coloured torus": mesh.torus}.get(name, lambda _: mesh.bunny())(face_count)
    if name == "bumpy ball":
        edge = np.sqrt(4 * np.pi / len(x))
        x = x + np.random.default_rng(0).uniform(-0.5, 0.5, x.shape) * edge
    x = x - (x.max(0) + x.min(0)) / 2
    turn = transforms.rotate(np.array([1.0, 1.0, 0.2]), 0.9)[:3, :3]
    x = x / np.linalg.norm(x, axis=1).max() @ turn.T
    is_coloured = name.startswith("coloured")
    colours = 0.6 + 0.4 * np.sin(5 * x) if is_coloured else np.ones(x.shape)
    return x, faces, colours, np.ones(len(x))


def two_balls(face_count, pass_through):
    """A small ball, which moves, before a larger one, or half in it."""
    x, faces = mesh.icosphere(face_count)
    small = 0.3 * x + ([0.5, 0.2, 0.55] if pass_through else [-0.1, 0.05, 1.0])
    positions = np.concatenate([small, 0.8 * x])
    colours = np.repeat([[1.0, 0.3, 0.2], [0.1, 0.5, 1.0]], len(x), 0)
    return (positions, np.concatenate([faces, faces + len(x)]), colours,
            np.repeat([1.0, 0.0], len(x)))


if __name__ == "__main__":
    main()
