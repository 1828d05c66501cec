"""Small runs of the scenes of labs 11, 12 and 15 to 17: what a mistake must show in."""
import numpy as np

from course.given import mesh
from course.scenes import (
    drawing,
    fit_volume,
    hole,
    levels,
    portrait,
    reconstruct,
    representations,
    tiles,
    viewing,
)


def lab_11(labs):
    """A sheet and a ring made round, a house, and a cage through the vertices of a sheet."""
    sheet, ring = mesh.plane(8), mesh.torus(36)
    for name, shape in ("sheet", sheet), ("ring", ring):
        yield from zip((f"a rounded {name}", f"its faces, {name}"),
                       levels.loop_step(labs, *shape), strict=True)
    for step, house in enumerate(levels.houses(labs, 2)):
        yield f"the house after {step} steps", np.concatenate([np.ravel(part) for part in house])
    *_, (points, surface, _) = levels.pulled(labs, *sheet, 1, 2)
    yield "a cage and its surface", np.concatenate([points, surface])


def lab_12(labs):
    """A bumpy ball and a wavy sheet, in ever fewer faces."""
    sheet, squares = mesh.grid(72)
    ball, faces = mesh.icosphere(180)
    for name, shape in (("ball", (ball * (1 + 0.2 * np.sin(5 * ball[:, [1, 2, 0]])), faces)),
                        ("sheet", (sheet + 0.5 * np.sin(sheet[:, [2, 2, 0]]), squares))):
        for step, (vertices, left) in enumerate(levels.fewer(labs, *shape, 60)):
            yield f"the {name}'s faces, {step}", left
            yield f"the {name}'s vertices, {step}", vertices[np.unique(left)]


def lab_15(labs):
    """The wheel in three ways, a volume that is fitted, and a hole that opens."""
    lab15 = labs.shape_rendering
    view = labs.pipeline.View(representations.wheel_camera(labs), 16, 16, drawing.WHITE)
    scene = representations.WHEEL, view, lab15.Lighting(drawing.LIGHT, drawing.BRASS)
    picture, evaluations = lab15.render_distance(*scene)
    yield "the wheel as a distance", picture
    yield "its evaluations", evaluations
    yield "the wheel as fog", lab15.render_volume(*scene, 1.7, 3.9, 0.1, count=24)
    yield "the wheel as a mesh", lab15.render_mesh(*scene, n=10)
    *_, (vertices, _, distance) = hole.pushed(labs, 6, 3)
    yield "the vertices around a hole", vertices
    yield "the distances of a hole", distance
    rays = fit_volume.saturn_rays(labs, viewing.cameras_around(labs, 3), 8)
    *_, (volume, loss) = fit_volume.fit(labs, rays, 6, 3, batch=60)
    yield "the fit of a volume", np.append(volume.density, loss)


def lab_16(labs):
    """A search for a ring that has just begun."""
    lab16 = labs.multi_view_fit
    stages, weights = [lab16.Stage(6, 1, 1, 2, 1.0)], lab16.WEIGHTS._replace(coverage=0.5)
    fit = reconstruct.fit(labs, "ring", stages, size=12, count=4, weights=weights)
    (_, first), (x, last) = fit
    yield "two losses", np.array([first, last])
    yield from x._asdict().items()


def lab_17(labs):
    """The bunny, coarse, by fragments and by tiles, and its colours from behind."""
    vertices, faces = drawing.unit_bunny()
    vertices, faces = mesh.merge(np.round(6 * vertices) / 6, faces)
    faces = faces[(faces != faces[:, [1, 2, 0]]).all(1)]
    clip = viewing.clip_positions(labs, vertices, portrait.BUNNY_EYE)
    yield "the bunny by fragments", tiles.by_fragments(labs, clip, faces, 32)
    picture = tiles.by_tiles(labs, clip, faces, 1 + vertices, 32)
    yield "the bunny by tiles", picture
    yield "its colours at the vertices", tiles.vertex_colours(labs, picture, clip, faces)
