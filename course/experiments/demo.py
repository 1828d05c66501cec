"""The scenes of `python3 -m course demo`: what the labs can do, on meshes that nobody here made.

A scene is a function of the labs' modules that yields (what was made, path or None) as it goes, and
where there is a goal, a third thing: (the goal, whether it is met). All of the rendering is the
labs' own code; this file chooses cameras and colours.
"""
import functools
import importlib
import time

import numpy as np
from rich import box
from rich.console import Console
from rich.progress import track
from rich.table import Table

from ..given import image, mesh, places, plot, ray_casting
from . import captures, fits

SIZE = 512
LIGHT = np.array([-0.4, 0.6, 0.7])  # direction towards the light, in world space
BACKGROUND = np.array([0.93, 0.95, 0.97])
WHEEL = ("intersection",
         ("smooth union", 0.1, ("torus", 0.72, 0.14),
          ("smooth union", 0.1,
           ("union", ("box", np.array([0.72, 0.06, 0.06])), ("box", np.array([0.06, 0.06, 0.72]))),
           ("intersection", ("sphere", 0.34), ("box", np.array([0.3, 0.16, 0.3]))))),
         ("complement", ("box", np.array([0.11, 1.0, 0.11]))))  # a hand wheel, of five holes
BRASS = np.array([0.85, 0.66, 0.48])
EARS = slice(340, 420), slice(150, 230)  # rows and columns for a close up of the bunny


class Labs:
    """The labs' modules of one package, loaded when first used."""

    def __init__(self, package):
        self.package = package

    def __getattr__(self, topic):
        return importlib.import_module(f"{self.package}.{topic}")


def run(names, implementation="reference"):
    """Render the named scenes, or all quick ones -> exit status: 1 if a goal was missed, else 0.

    ValueError: a name that is no scene's.
    """
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        raise ValueError(f"there is no scene {unknown[0]}: choose from {', '.join(SCENES)}")
    console, missed = Console(), 0
    for name in names or [name for name in SCENES if name not in SLOW]:
        rows = list(timed(SCENES[name](Labs(implementation))))
        table = Table(title=f"{name}: {scenes()[name]}", box=box.SIMPLE_HEAD, title_justify="left",
                      title_style="bold", pad_edge=False, min_width=72)
        for column in "step", "goal" if any(row[1] for row in rows) else "", "ms", "picture":
            table.add_column(column, justify="right" if column == "ms" else "left")
        for row in rows:
            table.add_row(*row)
        missed += sum("MISSED" in row[1] for row in rows)
        console.print(table)
    console.print(f"The pictures are in {places.out('demo')}", soft_wrap=True)
    if not names:
        console.print("Half a minute to five minutes each, asked for by name: "
                      f"python3 -m course demo {' '.join(SLOW)}", soft_wrap=True)
    return 1 if missed else 0


def timed(steps):
    """What a scene yields, as rows of text: step, goal, milliseconds, picture."""
    start = time.perf_counter()
    for step, path, *goals in steps:
        milliseconds = 1000 * (time.perf_counter() - start)
        picture = str(path.relative_to(places.ROOT)) if path else ""
        goal = " ".join(goal if met else f"{goal} MISSED" for goal, met in goals)
        yield step, goal, f"{milliseconds:.1f}", picture
        start = time.perf_counter()


def scenes():
    """{name: what it shows}, in the order of the labs."""
    return {name: scene.__doc__.splitlines()[0] for name, scene in SCENES.items()}


def bunny(labs):
    """The Stanford bunny through labs 1 and 2."""
    yield from portrait(labs, "bunny", mesh.bunny, eye=np.array([-1.3, 0.7, 2.2]))


def teapot(labs):
    """The Utah teapot through labs 1 and 2."""
    yield from portrait(labs, "teapot", mesh.teapot, eye=np.array([0.6, 1.2, 2.2]))


def portrait(labs, name, load, eye):
    """What lab 2 says about a mesh, pixel by pixel, as pictures."""
    vertices, faces = load()
    vertices = mesh.normalize(vertices)
    yield f"read {len(vertices):,} vertices, {len(faces):,} faces", None

    clip = clip_positions(labs, vertices, eye)
    yield "vertices to clip space", None
    face_index, depth = labs.scanline.rasterize(clip, faces, SIZE, SIZE)
    yield "rasterize: face index and depth", None
    barycentric = labs.rasterization.barycentrics(face_index, clip, faces)
    yield "barycentrics", None
    derivatives = labs.rasterization.barycentrics_derivatives(face_index, clip, faces)
    yield "derivatives of the barycentrics", None

    yield "face index", save(name, "face_index", plot.face_colours(face_index))
    yield "depth", save(name, "depth", plot.depth_colours(depth))
    seen = face_index >= 0
    yield "barycentrics", save(name, "barycentric", painted(seen, barycentric[seen]))
    yield "wireframe", save(name, "wireframe", wireframe(seen, barycentric, derivatives))
    yield "normals", save(name, "normals", shaded(vertices, faces, face_index, barycentric))


def flight(labs):
    """A camera flies into the bunny, up to its back wall; nothing was clipped."""
    vertices, faces = mesh.bunny()
    vertices = mesh.normalize(vertices)
    frames = []
    for x in track(np.linspace(-2.2, 0.2, 48), "flight", transient=True):
        eye = np.array([x, -0.1, 0.0])
        clip = clip_positions(labs, vertices, eye, target=eye + [1.0, 0.0, 0.0], near=0.01)
        face_index, _ = labs.scanline.rasterize(clip, faces, SIZE // 2, SIZE // 2)
        barycentric = labs.rasterization.barycentrics(face_index, clip, faces)
        frames.append(shaded(vertices, faces, face_index, barycentric))
    path = places.out("demo", "flight.png")
    image.write_animation(path, frames, 1 / 12)
    yield f"{len(frames)} frames", path


def aliasing(labs):
    """A picture made smaller: sampled, filtered before, blurred afterwards (lab 3)."""
    sampling, step = labs.sampling, 3
    rings = np.arange(SIZE + 1) - SIZE // 2
    plate = 0.5 + 0.5 * np.cos(np.pi * (rings**2 + rings[:, None]**2) / len(rings))
    yield "zone plate", save("aliasing", "zone_plate", plate)

    for name, step_name, picture in (
            ("sampled", "every third pixel", plate[::step, ::step]),
            ("filtered", "filtered, then sampled", sampling.filter_then_sample(plate, step)),
            ("blurred", "sampled, then blurred", sampling.sample_then_blur(plate, step))):
        yield step_name, save("aliasing", name, enlarged(picture, step))
        size = np.abs(np.fft.fftshift(sampling.spectrum_of(picture)))
        decades = np.log10(np.maximum(size / size.max(), 1e-5))
        yield "its spectrum", save("aliasing", f"{name}_spectrum", enlarged(1 + decades / 5, step))

    corners = SIZE / 8 * np.array([[0.08, 0.15], [0.93, 0.31], [0.33, 0.9]])
    coverage = sampling.pixel_coverage(corners, SIZE // 8, SIZE // 8)
    yield "exact coverage", save("aliasing", "coverage", enlarged(1 - coverage, 8))


def enlarged(picture, times):
    """Each pixel of a picture (H, W) as a square of times x times."""
    return picture.repeat(times, 0).repeat(times, 1)


def msaa(labs):
    """The bunny's silhouette with 1, 4 and 16 samples in a pixel, and by exact areas."""
    vertices, faces = mesh.bunny()
    vertices = mesh.normalize(vertices)
    clip = clip_positions(labs, vertices, eye=np.array([-1.3, 0.7, 2.2]))
    normals = mesh.vertex_normals(vertices, faces)
    background, shades, ears = image.to_linear(BACKGROUND), [], []
    yield f"read {len(vertices):,} vertices, {len(faces):,} faces", None

    def shade(px, py, face):
        shades.append(len(face))
        barycentric = labs.msaa.barycentric_at(px, py, face, clip, faces, SIZE, SIZE)
        return lit(barycentric, normals[faces[face]])

    for count in 1, 4, 16:
        pattern = labs.msaa.standard_pattern(count)
        picture = labs.msaa.msaa(clip, faces, SIZE, SIZE, pattern, shade, background)
        ears.append(picture)
        yield f"{count} in a pixel", None
        samples = count * SIZE * SIZE / 1e6
        yield (f"  {samples:.1f}M samples, {shades[-1] / 1e3:,.0f}k shades, {8 * samples:.0f} MB",
               save("msaa", f"{count}x", image.to_srgb(picture)))

    exact, area = by_area(labs, clip, faces, shade, background)
    layers = area > 1 + 1e-9
    exact[layers] = ears[-1][layers]
    yield (f"exact areas; of {layers.mean():.1%}, with several layers, the 16x",
           save("msaa", "exact", image.to_srgb(exact)))
    ears = [image.to_srgb(picture[EARS]) for picture in [*ears, exact]]
    ears = np.concatenate(ears, axis=1).repeat(6, axis=0).repeat(6, axis=1)
    yield "close up of all four", save("msaa", "close_up", ears)


def shadow(labs):
    """The bunny's shadow on the ground, hard and soft (lab 14)."""
    shadow_mapping = labs.shadow_mapping
    vertices, faces = mesh.bunny()
    vertices = mesh.normalize(vertices)
    ground, ground_faces = mesh.plane(2)
    ground = 2 * ground + [0.4, vertices[:, 1].min(), -0.2]
    faces = np.concatenate([faces, ground_faces + len(vertices)])
    vertices = np.concatenate([vertices, ground])
    light = labs.lights.point_light(np.array([-2.6, 2.4, 1.4]), vertices)
    camera = clip_from_world(labs, np.array([-0.7, 1.3, 3.3]), np.array([0.1, -0.15, 0.0]))
    yield f"read {len(vertices):,} vertices, {len(faces):,} faces", None

    face_index, points, normals = shadow_mapping.visible_points(vertices, faces, camera, SIZE, SIZE)
    yield "what the eye sees, as points in the world", None
    distance_map = shadow_mapping.depth_map(vertices, faces, light, 2 * SIZE)
    lit = shadow_mapping.hard_shadow(points, normals, light, distance_map, 2e-3)
    yield "hard shadow: the light's map, comparison", None
    soft = labs.soft_shadows.soft_shadow(points, normals, light, distance_map, 0.2, 1e-2,
                                         ray_casting.disc_offsets(32))
    yield "soft shadow of a disc, PCSS with 32 places", None

    seen, corners = face_index >= 0, face_index[face_index >= 0]
    toward = light.position - points
    toward /= np.linalg.norm(toward, axis=1, keepdims=True)
    colour = np.where(corners[:, None] < len(faces) - 2, [0.85, 0.66, 0.48], [0.62, 0.66, 0.70])
    facing = np.clip((toward * normals).sum(1), 0, 1)
    for name, share in ("hard", lit), ("soft", soft):
        shades = image.to_srgb((0.12 + 0.88 * share * facing)[:, None] * colour)
        yield f"{name} shadow", save("shadow", name, painted(seen, shades))
    distance = shadow_mapping.depth_map(vertices, faces, light, SIZE)
    yield "the light's map", save("shadow", "map", plot.depth_colours(distance))


def by_area(labs, clip, faces, shade, background):
    """Each front face by its exact area in every pixel: picture (SIZE, SIZE, 3), sum of areas.

    Right where the faces in a pixel lie side by side; where some hide others, the sum is above 1.
    """
    x, y, _ = labs.rasterization.screen_points(clip, SIZE, SIZE)
    corners, parts = np.stack([x, y], -1)[faces], []
    for face in np.flatnonzero(labs.rasterization.signed_area(corners) > 0):
        low = np.floor(corners[face].min(0)).astype(int)
        width, height = np.floor(corners[face].max(0)).astype(int) + 1 - low
        coverage = labs.sampling.pixel_coverage(corners[face] - low, width, height)
        row, column = np.nonzero(coverage)
        parts.append((row + low[1], column + low[0], 0 * row + face, coverage[row, column]))
    row, column, face, part = (np.concatenate(values) for values in zip(*parts, strict=True))
    picture, area = np.zeros((SIZE, SIZE, 3)), np.zeros((SIZE, SIZE))
    colour = shade(column + 0.5, row + 0.5, face)
    np.add.at(picture, (row, column), part[:, None] * colour)
    np.add.at(area, (row, column), part)
    return picture + (1 - area)[..., None] * background, area


def fit_triangle(labs):
    """A triangle moves to its template: with antialiasing alone (lab 9)."""
    template = fits.template(labs)
    for name, antialiased in ("without", False), ("with", True):
        x, _, gradients = fits.triangle(labs, template, antialiased)
        yield f"{name} antialiasing, {len(gradients)} steps:", None
        largest, off = np.abs(gradients).max(), np.linalg.norm(x[-1] - fits.TEMPLATE, axis=1).max()
        goal = [] if antialiased else [("exactly 0", largest == 0)]
        yield f"  largest gradient {largest:.2g}", None, *goal
        goal = [("0.1", off <= 0.1)] if antialiased else []
        yield (f"  {off:.3f} px off",
               save("fit_triangle", name, enlarged(over(labs, template, x), 8)), *goal)


def over(labs, template, x):
    """The template in blue; in orange where the triangle began, where it was and where it ended."""
    steps = [labs.sampling.pixel_coverage(x[step], fits.SIDE, fits.SIDE) for step in (0, 40, -1)]
    return np.concatenate([np.stack([1 - template[..., 0], 1 - (template[..., 0] + step) / 2,
                                     1 - step], -1) for step in steps], 1)


def fit_cube(labs):
    """A cube's shape and colours from tiny pictures (lab 9)."""
    for size, goal in (16, 0.001), (8, 0.01), (4, None):
        seeds, start = range(5), time.process_time()
        fitted = [fits.cube(labs, size, seed) for seed in track(seeds, f"{size}", transient=True)]
        seconds = (time.process_time() - start) / len(seeds)
        last, settled = np.sort([(errors[-1], np.median(errors[-100:])) for errors, *_ in fitted],
                                axis=0).T
        median = np.median(last)
        yield (f"{size} x {size}: error {median:.5f}", None,
               (f"{goal}", median <= goal) if goal else ("none: it need not converge", True))
        yield f"  {last[0]:.5f} to {last[-1]:.5f}, {seconds:.1f} s each", None
        yield f"  median of the last 100 steps {np.median(settled):.5f}", None
        pose = fits.cube_camera(labs) @ labs.transforms.rotate(np.array([1.0, 1.0, 0.2]), 0.9)
        seen = [fits.cube_picture(labs, *truth_or_fit, pose, pixels) for truth_or_fit, pixels in (
            ((fits.CORNERS - 0.5, fits.CORNERS), size), (fitted[0][2:], SIZE // 2),
            ((fits.CORNERS - 0.5, fits.CORNERS), SIZE // 2))]
        seen[0] = enlarged(seen[0], SIZE // 2 // size)
        yield "  a picture, the fit, the truth", save("fit_cube", f"{size}", np.hstack(seen))


def fit_pose(labs):
    """How a cube is rotated: search, then gradient (lab 9)."""
    still = fits.cube_symmetries()[:1]
    for name, title, seeds, search in (
            ("search", "search by symmetries", range(10), {}),
            ("failure", "the same from start 23", [23], {}),
            ("trapped", "search without them", range(10), {"symmetries": still}),
            ("gradient", "no search", range(10), {"proposals": 0})):
        start = time.process_time()
        fitted = [fits.pose(labs, seed, **search) for seed in track(seeds, transient=True)]
        seconds = (time.process_time() - start) / len(fitted)
        angles = np.degrees([labs.inverse_rendering.rotation_angle(rotations[-1], goal)
                             for rotations, goal in fitted])
        near, far = angles[angles < 0.01], np.sort(angles[angles >= 0.01])
        yield f"{title}, {seconds:.1f} s each:", None
        goal = [("8", len(near) >= 8)] if name == "search" else []
        yield f"  {len(near)} of {len(fitted)} under 0.01 degrees", None, *goal
        if len(near):
            yield f"  they are up to {near.max():.4f} off", None
        if len(far):
            yield "  " + " ".join(f"{angle:.0f}" for angle in far) + " degrees off", None
        rotations, truth = fitted[np.argmax(angles)]
        seen = [fits.block_picture(labs, q, SIZE // 2)[0]
                for q in (rotations[0], rotations[-1], truth)]
        yield "  worst: start, fit, truth", save("fit_pose", name, np.clip(np.hstack(seen), 0, 1))


def fit_texture(labs):
    """A globe's texture from 800 far and near views (lab 9)."""
    truth = fits.planet(128)
    views = fits.globe_views(labs, truth, 800)
    yield "views, 64 x 64 pixels", save("fit_texture", "truth", enlarged(truth, 4))
    decibels = []
    for name, filter, best_rate in (("without", "linear", 0.03),  # of 0.01, 0.02, 0.03, 0.05, 0.1
                                    ("with", "linear-mipmap-linear", 0.02)):
        psnr, texture = fits.texture(labs, truth, views, filter, first_rate=best_rate)
        decibels.append(psnr[-1])
        yield (f"{name} mipmaps: {psnr[-1]:.2f} dB",
               save("fit_texture", name, enlarged(np.clip(texture, 0, 1), 4)))
    difference = decibels[1] - decibels[0]
    yield f"difference {difference:.2f} dB", None, ("1.3", difference >= 1.3)


def fit_bunny(labs):
    """A ball becomes the bunny by 20 silhouettes (lab 9)."""
    for name, weight in ("with", 0.02), ("without", 0.0):
        start = time.process_time()
        path, _ = fits.bunny(labs, weight)
        yield f"{name} a regularizer, {time.process_time() - start:.0f} s:", None
        yield from seen_anew(labs, path, "0.97" if weight else None)
        yield "  steps 0, 30, 100, 300", save("fit_bunny", name, stages(labs, path))


def large_steps(labs):
    """A ball becomes the bunny by spread gradients, without a regularizer (lab 13)."""
    for name, amount in ("with", 3.0), ("without", 0.0):
        start = time.process_time()
        path, _ = fits.bunny_by_large_steps(labs, amount, (0.2, 0.1))
        yield f"{name} spreading, {time.process_time() - start:.0f} s:", None
        for step in 30, 100:
            yield f"  after {step:3} steps, IoU {new_views(labs, path[step]).mean():.4f}", None
        yield from seen_anew(labs, path)
        yield "  steps 0, 30, 100, 300", save("large_steps", name, stages(labs, path))


def new_views(labs, vertices):
    """Intersection over union with the bunny in 50 views that the fit did not have: (50,)."""
    cameras, (_, faces) = fits.random_cameras(labs, 50), fits.ball()
    return fits.shared_silhouettes(labs, (vertices, faces), fits.rabbit(), cameras)


def seen_anew(labs, path, goal=None):
    """What new views say about the end of a fit, and how much of it is folded."""
    ious, (_, faces) = new_views(labs, path[-1]), fits.ball()
    reached = [(goal, ious.mean() >= float(goal))] if goal else []
    yield f"  IoU of new views {ious.mean():.4f}", None, *reached
    yield f"  {ious.min():.4f} in the worst of {len(ious)}", None
    yield f"  {fits.folded_edges(path[-1], faces):.1%} of edges folded", None


def stages(labs, path):
    """The ball on its way, after 0, 30, 100 and all steps, side by side."""
    seen, (_, faces) = [], fits.ball()
    for vertices in path[[0, 30, 100, -1]]:
        clip = clip_positions(labs, vertices, eye=np.array([-1.3, 0.7, 2.2]))
        face_index, _ = labs.scanline.rasterize(clip, faces, SIZE, SIZE)
        barycentric = labs.rasterization.barycentrics(face_index, clip, faces)
        seen.append(shaded(vertices, faces, face_index, barycentric))
    return np.hstack(seen)


def relaxation(labs):
    """The teapot's thin triangles made rounder, its surface kept (lab 13)."""
    vertices, faces = closed_seams(*mesh.teapot())
    vertices, faces = split_in_four(vertices, faces)
    size = np.linalg.norm(np.ptp(vertices, axis=0))
    yield f"{len(vertices):,} vertices, {len(faces):,} faces", None
    moved, flipped = labs.regularization.relax(vertices, faces, 0.004 * size)
    yield "flips and slides, four times", None
    for name, shape, triangles in ("before", vertices, faces), ("after", moved, flipped):
        angle = np.degrees(labs.regularization.corner_angles(shape[triangles]).min(1).mean())
        yield (f"{name}: mean least angle {angle:.1f} degrees",
               save("relaxation", name, drawn(labs, shape, triangles)))


def closed_seams(vertices, faces):
    """A mesh whose vertices at the same place became one."""
    vertices, index = np.unique(vertices, axis=0, return_inverse=True)
    return vertices, index.reshape(-1)[faces]


def split_in_four(vertices, faces):
    """Each face as four of its own shape: the surface stays, and so do its angles."""
    edges, face_edges = mesh.edges(faces)
    (a, b, c), (bc, ca, ab) = faces.T, (len(vertices) + face_edges).T
    faces = np.stack([a, ab, ca,  b, bc, ab,  c, ca, bc,  ab, bc, ca], 1).reshape(-1, 3)
    return np.concatenate([vertices, vertices[edges].mean(1)]), faces


def drawn(labs, vertices, faces, size=SIZE):
    """The visible edges of a mesh, seen as the teapot is: a picture (size, size, 3)."""
    clip = clip_positions(labs, mesh.normalize(vertices), eye=np.array([0.6, 1.2, 2.2]))
    face_index, _ = labs.scanline.rasterize(clip, faces, size, size)
    barycentric = labs.rasterization.barycentrics(face_index, clip, faces)
    derivatives = labs.rasterization.barycentrics_derivatives(face_index, clip, faces)
    return wireframe(face_index >= 0, barycentric, derivatives)


def representations(labs):
    """A hand wheel as signed distance, as volume and as mesh (lab 15)."""
    lab15, size = labs.implicit_surfaces, 144
    given = WHEEL, wheel_camera(labs), size, size, LIGHT, BRASS, BACKGROUND
    picture, evaluations = lab15.render_distance(*given)
    yield (f"distance: {evaluations.mean():.0f} steps a ray",
           save("representations", "distance", enlarged(picture, 2)))
    for beta in 0.1, 0.03, 0.01:
        picture = lab15.render_volume(*given, 1.7, 3.9, beta, count=96)
        yield (f"volume, beta {beta}",
               save("representations", f"volume_{beta}", enlarged(picture, 2)))
    for n in 16, 32, 64:
        picture = lab15.render_mesh(*given, n=n)
        yield f"mesh, {n}^3 cells", save("representations", f"mesh_{n}", enlarged(picture, 2))


def wheel_camera(labs):
    """clip_from_world that sees the hand wheel from above."""
    eye, up = np.array([1.0, 2.2, 1.4]), np.array([0.0, 1.0, 0.0])
    view = labs.transforms.look_at(eye, np.zeros(3), up)
    return labs.transforms.perspective(np.radians(40), 1.0, 0.1, 10.0) @ view


def fit_volume(labs):
    """Density and colour in a grid, found from 30 pictures (lab 15)."""
    lab15, n, size = labs.implicit_surfaces, 24, 32
    rays = fits.saturn_rays(labs, fits.cameras_around(labs, 30, longitude=0.2), size)
    yield f"30 views, {size} x {size} pixels", None
    density, colour, _ = fits.volume_fit(labs, *rays, n, 500)
    yield "500 steps", None
    origins, directions, truth = fits.saturn_rays(
        labs, fits.cameras_around(labs, 3, longitude=0.7), size)
    picture = fits.volume_seen(labs, origins, directions, density, colour)
    yield f"three new views: {-10 * np.log10(np.mean((picture - truth)**2)):.1f} dB", None
    sheet = np.concatenate([rays.reshape(3, size, size, 3).swapaxes(0, 1).reshape(size, -1, 3)
                            for rays in (truth, picture)])
    yield "fit, and truth below", save("fit_volume", "views", enlarged(np.clip(sheet, 0, 1), 5))

    points, tetrahedra = lab15.tetrahedral_grid(n)
    outside = fits.volume_surface(density, points)
    vertices, faces, _ = lab15.marching_tetrahedra(points, outside, tetrahedra)
    yield f"its mesh: {len(faces):,} faces", save("fit_volume", "mesh", mesh_seen(
        labs, vertices, faces, wheel_camera(labs)))


def mesh_seen(labs, vertices, faces, clip_from_world):
    """A mesh with a light, SIZE / 2 wide and high."""
    clip = labs.transforms.transform(labs.transforms.to_homogeneous(vertices), clip_from_world)
    face_index, _ = labs.scanline.rasterize(clip, faces, SIZE // 2, SIZE // 2)
    barycentric = labs.rasterization.barycentrics(face_index, clip, faces)
    return shaded(vertices, faces, face_index, barycentric)


def fit_outlines(labs):
    """A triangle and a teapot's silhouette by three gradients (lab 10)."""
    goal = fits.template(labs)
    ways = (("sweep", {}), ("sweep", {"eps": 1e-2}), ("soft", {}), ("soft", {"sigma": 0.5}),
            ("blend", {}))
    for name, setting in ways:
        title = " ".join([name, *(f"{key} {value:g}" for key, value in setting.items())])
        outline = functools.partial(fits.OUTLINES[name], **setting)
        start = time.process_time()
        x = fits.triangle_by(labs, outline)
        off = np.linalg.norm(x - fits.TEMPLATE, axis=2).max(1)
        near = np.flatnonzero(off < 1)
        yield f"{title}: triangle, {time.process_time() - start:.1f} s", None
        seen = enlarged(over(labs, goal, x), 8)
        yield (f"  {off[-1]:.2f} px off, 1 px after {near[0] if len(near) else '-'} steps",
               save("fit_outlines", f"triangle {title}", seen))
        start = time.process_time()
        path, faces = fits.teapot_by(labs, outline)
        yield f"  teapot, {time.process_time() - start:.1f} s", None
        seen = [fits.seen_mask(labs, vertices, faces, fits.teapot_camera(labs), SIZE // 2)
                for vertices in path[[0, 20, -1]]]
        mask = fits.teapot_mask(labs, SIZE // 2)
        seen = [1 - 0.5 * mask[..., None] - 0.5 * a[..., None] * [0, 0.5, 1] for a in seen]
        yield (f"  IoU {fits.teapot_iou(labs, path[-1], faces):.3f}",
               save("fit_outlines", f"teapot {title}", np.hstack(seen)))


def reconstruct(labs):
    """Shape, albedo and light from 24 pictures, or from FOLDER (lab 16)."""
    for name, stages, seconds, genus, percent in (("ring", fits.BALL_STAGES, 180, 1, 1.0),
                                                  ("two rings", fits.BALL_STAGES, 180, 2, 1.0),
                                                  ("bunny", fits.FINE_STAGES, 360, 0, 1.2)):
        path = places.out("demo", "reconstruct", f"{name.replace(' ', '_')}.glb")
        camera, frames = fits.cameras_around(labs, 8, longitude=1.1)[5], []
        start, steps = time.process_time(), fits.steps_of(stages)
        fit = fits.reconstruction(labs, name, stages)
        for step, (_, _, x) in enumerate(captures.watched(labs, fit, steps, path), 1):
            if step % 5 == 1 or step == steps:
                frames.append(fits.portrait(labs, x, camera, 128))
        spent = time.process_time() - start
        yield f"{name}: {spent:.0f} s", path, (f"{seconds} s", spent <= seconds)
        animation = path.with_name(f"{path.stem}_on_its_way.png")
        image.write_animation(animation, frames + 12 * frames[-1:], 0.12)
        yield "  on its way", animation
        yield from compared(labs, x, name, genus, percent)


def compared(labs, x, name, genus, percent):
    """What was found, beside the truth and lab 16's goals."""
    judged = fits.judged(labs, x, name)
    (pieces, found), off = judged["pieces, genus"], 100 * judged["distance"]
    right = (pieces, found) == (1, genus)
    yield f"  pieces {pieces}, genus {found}", None, (f"1, {genus}", right)
    yield f"  {off:.2f} % of the diagonal off", None, (f"{percent} %", off <= percent)
    for title, least in ("new views", 27), ("relit", 24):
        decibels = judged[title]
        yield f"  {title}: {decibels:.1f} dB", None, (f"{least} dB", decibels >= least)
    scale = " ".join(f"{factor:.2f}" for factor in judged["scale"])
    yield f"  light {judged['light']:.0%} off, up to factors {scale}", None
    sheet = np.hstack([np.vstack([picture[..., :3] for picture in pictures[::2]])
                       for pictures in judged["pictures"]])
    yield ("  fit, truth; relit, truth",
           save("reconstruct", name.replace(" ", "_"), image.to_srgb(np.clip(sheet, 0, 1))))


def ablations(labs):
    """What lab 16's search is without one of its parts."""
    stages, camera = fits.FINE_STAGES[:2], fits.cameras_around(labs, 8, longitude=1.1)[5]
    weights = *labs.reconstruction.WEIGHTS[:2], 0.0, 0.0
    for name, setting in (("all of it", {}), ("no antialiasing", {"eye": fits.without_edges(labs)}),
                          ("no regularizers", {"weights": weights}), ("4 views", {"count": 4})):
        for _, _, x in fits.reconstruction(labs, "bunny", stages, **setting):  # noqa: B007
            pass
        judged = fits.judged(labs, x, "bunny")
        yield (f"{name}: {judged['new views']:.1f} dB, {judged['distance']:.2%} off",
               save("ablations", name.replace(" ", "_"), fits.portrait(labs, x, camera, 256)))


def clip_positions(labs, vertices, eye, target=(0.0, 0.0, 0.0), near=0.1):
    """Vertices (V, 3) in world space -> clip (V, 4), for a camera at eye that looks at target."""
    points = labs.transforms.to_homogeneous(vertices)
    return labs.transforms.transform(points, clip_from_world(labs, eye, target, near))


def clip_from_world(labs, eye, target, near=0.1):
    """The matrix (4, 4) of a camera at eye that looks at target."""
    transforms = labs.transforms
    view_from_world = transforms.look_at(eye, np.asarray(target), np.array([0.0, 1.0, 0.0]))
    return transforms.perspective(np.radians(48), 1.0, near, 10.0) @ view_from_world


def shaded(vertices, faces, face_index, barycentric):
    """Face index and barycentrics of a picture -> the picture with `lit` faces."""
    seen = face_index >= 0
    corners = mesh.vertex_normals(vertices, faces)[faces[face_index[seen]]]
    return painted(seen, image.to_srgb(lit(barycentric[seen], corners)))


def lit(barycentric, corners):
    """One light on smooth normals, mixed by the barycentrics; it also reaches round the edge.

    barycentric (N, 3), the corners' normals (N, 3, 3) -> linear colour (N, 3).
    """
    normal = (barycentric[:, :, None] * corners).sum(1)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    light = (0.5 + 0.5 * normal @ LIGHT / np.linalg.norm(LIGHT)) ** 2
    return light[:, None] * np.array([0.85, 0.66, 0.48])


def wireframe(seen, barycentric, derivatives):
    """Edges one pixel wide, hidden ones hidden: b_k / |db_k| is the distance to edge k in pixels.

    After Baerentzen et al. 2006, "Single-pass wireframe rendering".
    """
    distance = barycentric[seen] / np.linalg.norm(derivatives[seen], axis=-1)
    ink = np.clip(1.2 - distance.min(1), 0, 1)[:, None]
    return painted(seen, ink * np.array([0.10, 0.15, 0.30]) + (1 - ink) * np.ones(3))


def painted(seen, colours):
    """Colours (N, 3) of the seen pixels (H, W) -> picture (H, W, 3) on the background."""
    picture = np.tile(BACKGROUND, (*seen.shape, 1))
    picture[seen] = colours
    return picture


def save(scene, name, picture):
    path = places.out("demo", scene, f"{name}.png")
    image.write(path, picture)
    return path


SCENES = {scene.__name__: scene for scene in (
    bunny, teapot, flight, aliasing, msaa, fit_triangle, fit_cube, fit_pose, fit_texture, fit_bunny,
    fit_outlines, relaxation, large_steps, shadow, representations, fit_volume, reconstruct,
    ablations)}
SLOW = ("fit_cube", "fit_pose", "fit_texture", "fit_bunny", "fit_outlines", "large_steps",
        "fit_volume", "reconstruct", "ablations")
