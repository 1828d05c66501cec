"""What fits gain by the gradient of whole outlines: python3 benchmarks/fits.py

The scenes' own fits, with pairs of pixels found by nvdiffrast's rule, by the walk, and, where the
pictures are masks, with hard pictures and the pull. For three seeds: how far off the end is, how
much of silhouettes in new views is shared (IoU), and after how many steps a fit is as near as
nvdiffrast's rule comes at last. rate is a factor of the scene's own rates.
"""
import contextlib
import functools
import itertools
import sys
from pathlib import Path
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import mesh
from course.given.whose import Labs
from course.scenes import drawing, fit_bunny, fit_cube, fit_outlines, fit_pose, large_steps
from course.scenes import reconstruct as searches
from course.scenes.photographs import Painted, found_object

LABS, SEEDS, RATES = Labs("reference"), range(3), (1, 0.5, 2)
BALLS = [(1_280, 64), (1_280, 128), (5_120, 64)]  # faces, and pixels on a side
ICOSPHERE, DESCEND = mesh.icosphere, LABS.inverse_rendering.descend


def main():
    facts, fits = measure.begin(), {}
    for name, (fit, meshes, rules) in FITS.items():
        fits[name] = [row for at in meshes for row in lines_of(fit, rules, at, at == meshes[0])]
        print(f"\n{name}")
        measure.show(fits[name])
    measure.save("fits", {**facts, "fits": fits})


def lines_of(fit, rules, at, with_rates):
    """The lines of the table of a fit with faces and pixels `at`, one for each rule and rate."""
    for rule, rate in itertools.product([*RULES][:rules], RATES if with_rates else RATES[:1]):
        with exchanged(*RULES[rule], *given(at[0], rate)):
            errors, ious = zip(*(fit(seed, at[1]) for seed in SEEDS), strict=True)
        ends = [error[-1] for error in errors]
        if (rule, rate) == ("nvdiffrast's rule", 1):
            goals = ends
        near = [np.flatnonzero(error <= goal) for error, goal in zip(errors, goals, strict=True)]
        yield {"faces": at[0], "pixels": at[1], "rule": rule, "rate": rate,
               "off": np.round(ends, 4).tolist(), "mean": round(np.mean(ends), 4),
               "IoU": [iou and round(float(iou), 4) for iou in ious],
               "steps": [10 * int(found[0]) if len(found) else None for found in near]}


# --- what is exchanged ------------------------------------------------------------------------


@contextlib.contextmanager
def exchanged(*attributes):
    """With other values for the attributes (module, name, value)."""
    with contextlib.ExitStack() as stack:
        for attribute in attributes:
            stack.enter_context(mock.patch.object(*attribute))
        yield


def given(face_count, rate):
    """For all rules alike: the ball at first, the targets of silhouettes, and the rates."""
    def descend(x, gradient, schedule, *rest, **settings):
        return DESCEND(x, gradient, [rate * each for each in schedule], *rest, **settings)

    return ((mesh, "icosphere", lambda count: ICOSPHERE(face_count or count)),
            (fit_bunny, "silhouettes", photographs),
            (LABS.inverse_rendering, "descend", descend))


def photographs(labs, vertices, faces, cameras, size):
    """`fit_bunny.silhouettes` as means of 8 x 8 samples."""
    masks = [drawing.seen_mask(labs, vertices, faces, camera, 8 * size) for camera in cameras]
    return [labs.msaa.box_resolve(mask[..., None] * 1.0, 8) for mask in masks]


def hard(clip, faces, opposite, material, width, height, background):
    """`pipeline.draw` without a blend. Its pairs are all that have an outline."""
    seen = LABS.pipeline.shade(LABS.pipeline.visible(clip, faces, width, height), faces, material,
                               background)
    pairs, _ = LABS.outline_walk.both_pairs(seen.face_index, seen.depth, clip, faces, opposite)
    return seen.colour, seen._replace(pairs=pairs)


def pull(grad_picture, buffers, faces, material, grad_depth=None):
    """`pipeline.draw_backward` for `hard`."""
    grad_material, grad_clip = LABS.pipeline.interior_backward(grad_picture, buffers, faces,
                                                               material)
    return grad_material, grad_clip + LABS.outline_walk.outline_pull_backward(
        grad_picture, buffers.colour, buffers.pairs, buffers.clip)


def pulled_outline(labs, clip, faces, size):
    """An outline as those of fit_outlines.py: a mask, and its pull."""
    white = labs.pipeline.Colours(np.ones((len(clip), 1)))
    picture, buffers = hard(clip, faces, labs.antialiasing.opposite_corners(faces), white, size,
                            size, np.zeros(1))
    return picture[..., 0], lambda grad: pull(grad[..., None], buffers, faces, white)[1]


WITHOUT_WALKS = functools.partial(LABS.compiled_pipeline.all_pairs, walks=False)
RULES = {"nvdiffrast's rule": [(LABS.intersections, "all_pairs", LABS.outlines.blended_pairs),
                               (LABS.outline_walk, "walked_pairs", LABS.outlines.blended_pairs),
                               (LABS.compiled_pipeline, "all_pairs", WITHOUT_WALKS)],
         "walk": [],
         "pull": [(LABS.pipeline, "draw", hard), (LABS.pipeline, "draw_backward", pull),
                  (fit_outlines, "blend_outline", pulled_outline)]}


# --- the fits: (seed, size) -> how far off every tenth step is, and IoU at the end ----------------


def bunny(seed, size):
    """Lab 9's, with its penalty's weight for this number of faces: % of the diagonal."""
    weight = 0.02 * 1280 / len(fit_bunny.ball()[1])
    return of_bunny(fit_bunny.fit(LABS, weight, 150, size, seed)[0])


def bunny_in_large_steps(seed, size):
    """Lab 13's: % of the diagonal."""
    amount = 3.0 * len(fit_bunny.ball()[1]) / 1280
    return of_bunny(large_steps.fit(LABS, amount, (0.2, 0.1), 150, size, seed)[0])


def of_bunny(path):
    _, faces = fit_bunny.ball()
    truth = Painted(*drawing.unit_bunny(), None)
    off = [searches.relative_distance(Painted(x, faces, None), truth) for x in path[::10]]
    return 100 * np.array(off), fit_bunny.new_views(LABS, path[-1]).mean()


def teapot(seed, size):
    """Lab 10's, from balls of three sizes and one view: % of both silhouettes not shared."""
    path, faces = fit_outlines.teapot(LABS, fit_outlines.blend_outline, size=size,
                                      radius=(0.5, 0.4, 0.6)[seed])
    iou = np.array([fit_outlines.teapot_iou(LABS, x, faces) for x in path[::10]])
    return 100 * (1 - iou), iou[-1]


def cube(seed, size):
    """Lab 9's: its corners, in % of a side."""
    return 100 * fit_cube.fit(LABS, size, seed, 900)[0][::10], None


def pose(seed, size):
    """Lab 9's: degrees, from the end of the random search on."""
    path, goal = fit_pose.fit(LABS, seed, stages=((size, 40, 5e-3), (4 * size, 40, 3e-4)))
    return np.degrees([LABS.inverse_rendering.rotation_angle(q, goal) for q in path[400::10]]), None


def searched(name, stages):
    """Lab 16's search for an object: % of the diagonal, at the end alone."""
    def search(seed, size):
        *_, (x, _) = searches.fit(LABS, name, stages, size, seed=seed)
        truth = searches.unseen(LABS, name)
        return 100 * np.array([searches.relative_distance(found_object(LABS, x), truth)]), None
    return search


RINGS, FINE = searches.ring_stages(LABS), searches.fine_stages(LABS)
FITS = {"bunny": (bunny, BALLS, 3), "bunny in large steps": (bunny_in_large_steps, BALLS, 3),
        "teapot": (teapot, [(320, 64), (5_120, 64)], 3), "cube": (cube, [(12, 16)], 2),
        "pose": (pose, [(12, 64)], 2), "ring": (searched("ring", RINGS), [(None, 128)], 2),
        "reconstructed bunny": (searched("bunny", FINE), [(None, 128)], 2)}

if __name__ == "__main__":
    main()
