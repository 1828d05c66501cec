"""Small runs of the scenes of labs 3, 4 and 10 to 17: what a mistake must show in."""
import numpy as np
from what_draws import BUMPY, FACES

from course.given import mesh, ray_casting
from course.scenes import (
    aliasing,
    cubes,
    drawing,
    fit_volume,
    hole,
    large_steps,
    levels,
    mixed,
    portrait,
    reconstruct,
    relaxation,
    representations,
    shadow,
    tiles,
    viewing,
)


def lab_3(labs):
    """A zone plate made smaller, and a triangle that is pulled to its place."""
    yield from aliasing.smaller(labs.sampling, aliasing.zone_plate(39)[..., 0]).items()
    coverage = labs.sampling.pixel_coverage_loop(9 * aliasing.GOAL, 9, 9)
    yield "exact coverage", coverage
    *_, triangle = aliasing.pulled(labs.sampling, 9 * aliasing.START, coverage, 5)
    yield "a triangle pulled to its place", triangle


def lab_4(labs):
    """A ball with four samples in a pixel, and its colours, found in mixed pixels."""
    vertices, faces = mesh.icosphere(80)
    clip = viewing.clip_positions(labs, vertices, portrait.BUNNY_EYE)
    pattern = labs.msaa.standard_pattern(4)
    yield "a ball, shaded by pixel and face", labs.msaa.msaa(
        clip, faces, 20, 16, pattern, lambda *place: np.stack(place, -1), drawing.BACKGROUND)
    seen = mixed.sampled_ball(labs, vertices, faces, 12)
    goal = mixed.painted(labs, seen, np.append(1 + vertices[faces].mean(1), np.eye(3)[:1], 0))
    yield "a ball with flat colours", goal
    *_, found = mixed.colours_found(labs, seen, goal, len(faces), 3)
    yield "its colours, found", found


def lab_10(labs):
    """A small ball of texture cubes, and the first steps of its way."""
    ball = cubes.striped(labs, *cubes.small_ball())
    yield "the ball", cubes.picture(labs, ball, 24)
    yield "its way", np.array(cubes.fit(labs, ball, 24, 3))


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


def lab_13(labs):
    """A bumpy ball made smooth and round, and a bunny begun by large steps."""
    thin = BUMPY * [1, 1, 3]
    _, *smoothed = relaxation.without_noise(labs.regularization, thin, FACES, 0.05)
    yield "a ball made smooth, and restored", np.array(smoothed)
    yield from zip(("the relaxed vertices", "the relaxed faces"),
                   labs.remeshing.relax(thin, FACES, 0.1, 1), strict=True)
    path, losses = large_steps.fit(labs, 3.0, (0.2, 0.1), steps=2, size=32)
    yield "large steps", np.append(path[-1], losses)


def lab_14(labs):
    """A ball's shadow, hard and soft, and the begin of a search for its light."""
    shape, lab14 = shadow.on_the_ground(*mesh.icosphere(80), lift=0.4), labs.variance_shadows
    light = labs.lights.point_light(shadow.PLACE, shape[0])
    camera = viewing.clip_from_world(labs, [0.6, 3.6, 2.2], [0.4, -0.8, -0.2])
    _, *seen = labs.shadow_mapping.visible_points(*shape, camera, 32, 32)
    given = *seen, light, labs.shadow_mapping.depth_map(*shape, light, 64)
    yield "the hard shadow", labs.shadow_mapping.hard_shadow(*given, 2e-3, most=0.1)
    places = ray_casting.disc_offsets(16)
    yield "the soft shadow", labs.soft_shadows.soft_shadow(*given, 0.4, 1e-2, places)
    _, *given = shadow.given_shadow(labs, *shape, 16)
    yield "the search for the light", lab14.fit_position(
        *given, *shape, shadow.GUESS, lab14.Settings(48, 3, 1e-3), [0.1, 0.05, 0.02])


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
