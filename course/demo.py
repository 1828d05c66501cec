"""The scenes of `python3 -m course demo`: what the labs can do, on meshes that nobody here made.

A scene is a function of the labs' modules that yields (what was made, path or None) as it goes.
All of the rendering is the labs' own code; this file chooses cameras and colours.
"""
import functools
import importlib
import time

import numpy as np
from rich import box
from rich.console import Console
from rich.progress import track
from rich.table import Table

from . import fits, image, mesh, places, plot

SIZE = 512
LIGHT = np.array([-0.4, 0.6, 0.7])  # direction towards the light, in world space
BACKGROUND = np.array([0.93, 0.95, 0.97])
EARS = slice(340, 420), slice(150, 230)  # rows and columns for a close up of the bunny


class Labs:
    """The labs' modules of one package, loaded when first used."""

    def __init__(self, package):
        self.package = package

    def __getattr__(self, topic):
        return importlib.import_module(f"{self.package}.{topic}")


def run(names, implementation="reference"):
    """Render the named scenes, or all -> exit status. ValueError: a name that is no scene's."""
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        raise ValueError(f"there is no scene {unknown[0]}: choose from {', '.join(SCENES)}")
    console = Console()
    for name in names or SCENES:
        scene = SCENES[name]
        table = Table(title=f"{name}: {scene.__doc__.splitlines()[0]}", box=box.SIMPLE_HEAD,
                      title_justify="left", title_style="bold", pad_edge=False, min_width=72)
        table.add_column("step")
        table.add_column("ms", justify="right")
        table.add_column("picture")
        start = time.perf_counter()
        for step, path in scene(Labs(implementation)):
            milliseconds = 1000 * (time.perf_counter() - start)
            picture = str(path.relative_to(places.ROOT)) if path else ""
            table.add_row(step, f"{milliseconds:.1f}", picture)
            start = time.perf_counter()
        console.print(table)
    console.print(f"The pictures are in {places.out('demo')}", soft_wrap=True)
    return 0


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
    face_index, depth = labs.rasterization.rasterize(clip, faces, SIZE, SIZE)
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
        face_index, _ = labs.rasterization.rasterize(clip, faces, SIZE // 2, SIZE // 2)
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
        goal = "" if antialiased else " (goal: exact 0)"
        yield f"  gradient {np.abs(gradients).max():.2g}{goal}", None
        goal = " (goal: 0.1)" if antialiased else ""
        yield (f"  {np.linalg.norm(x[-1] - fits.TEMPLATE, axis=1).max():.3f} px off{goal}",
               save("fit_triangle", name, enlarged(over(labs, template, x), 8)))


def over(labs, template, x):
    """The template in blue; in orange where the triangle began, where it was and where it ended."""
    steps = [labs.sampling.pixel_coverage(x[step], fits.SIDE, fits.SIDE) for step in (0, 40, -1)]
    return np.concatenate([np.stack([1 - template[..., 0], 1 - (template[..., 0] + step) / 2,
                                     1 - step], -1) for step in steps], 1)


def fit_cube(labs):
    """A cube's shape and colours from tiny pictures (lab 9)."""
    for size, goal in (16, "goal: 0.001"), (8, "goal: 0.010"), (4, "no convergence"):
        seeds, start = range(5), time.process_time()
        fitted = [fits.cube(labs, size, seed) for seed in track(seeds, f"{size}", transient=True)]
        seconds = (time.process_time() - start) / len(seeds)
        last = np.sort([errors[-1] for errors, *_ in fitted])
        yield f"{size} x {size}: error {np.median(last):.5f} ({goal})", None
        yield f"  {last[0]:.5f} to {last[-1]:.5f}, {seconds:.1f} s each", None
        pose = fits.cube_camera(labs) @ labs.transforms.rotate(np.array([1.0, 1.0, 0.2]), 0.9)
        seen = [fits.cube_picture(labs, *truth_or_fit, pose, pixels) for truth_or_fit, pixels in (
            ((fits.CORNERS - 0.5, fits.CORNERS), size), (fitted[0][1:], SIZE // 2),
            ((fits.CORNERS - 0.5, fits.CORNERS), SIZE // 2))]
        seen[0] = enlarged(seen[0], SIZE // 2 // size)
        yield "  a picture, the fit, the truth", save("fit_cube", f"{size}", np.hstack(seen))


def fit_pose(labs):
    """How a cube is turned: search, then gradient (lab 9)."""
    unturned = fits.cube_symmetries()[:1]
    for name, title, search in (
            ("search", "search by symmetries", {}),
            ("trapped", "search without them", {"symmetries": unturned}),
            ("gradient", "no search", {"proposals": 0})):
        start = time.process_time()
        fitted = [fits.pose(labs, seed, **search) for seed in track(range(10), transient=True)]
        seconds = (time.process_time() - start) / len(fitted)
        angles = np.degrees([labs.inverse_rendering.rotation_angle(turns[-1], goal)
                             for turns, goal in fitted])
        near, far = angles[angles < 0.01], np.sort(angles[angles >= 0.01])
        yield f"{title}, {seconds:.1f} s each:", None
        goal = "" if search else " (goal: 8)"
        yield f"  {len(near)} of 10 under 0.01 degrees{goal}", None
        if len(near):
            yield f"  they are up to {near.max():.4f} off", None
        if len(far):
            yield "  " + " ".join(f"{angle:.0f}" for angle in far) + " degrees off", None
        turns, goal = fitted[np.argmax(angles)]
        seen = [fits.block_picture(labs, turn, SIZE // 2)[0]
                for turn in (turns[0], turns[-1], goal)]
        yield "  worst: start, fit, truth", save("fit_pose", name, np.clip(np.hstack(seen), 0, 1))


def fit_texture(labs):
    """A globe's texture from 800 far and near views (lab 9)."""
    truth = fits.planet(128)
    views = fits.globe_views(labs, truth, 800)
    yield "views, 64 x 64 pixels", save("fit_texture", "truth", enlarged(truth, 4))
    decibels = []
    for name, filter in ("without", "linear"), ("with", "linear-mipmap-linear"):
        psnr, texture = fits.texture(labs, truth, views, filter)
        decibels.append(psnr[-1])
        yield (f"{name} mipmaps: {psnr[-1]:.2f} dB",
               save("fit_texture", name, enlarged(np.clip(texture, 0, 1), 4)))
    yield f"difference {decibels[1] - decibels[0]:.2f} dB (goal: 1.3)", None


def fit_bunny(labs):
    """A ball becomes the bunny by 20 silhouettes (lab 9)."""
    cameras, (_, faces) = fits.cameras_around(labs, 20, longitude=0.3), fits.ball()
    eye = np.array([-1.3, 0.7, 2.2])
    for name, weight in ("with", 0.02), ("without", 0.0):
        start = time.process_time()
        path, _ = fits.bunny(labs, weight)
        yield f"{name} a regularizer, {time.process_time() - start:.0f} s:", None
        ious = fits.shared_silhouettes(labs, (path[-1], faces), fits.rabbit(), cameras)
        yield f"  IoU of new views {ious.mean():.4f} (goal: 0.97)", None
        yield f"  {ious.min():.4f} in the worst of {len(ious)}", None
        yield f"  {fits.folded_edges(path[-1], faces):.1%} of edges folded", None
        seen = []
        for vertices in path[[0, 30, 100, -1]]:
            clip = clip_positions(labs, vertices, eye)
            face_index, _ = labs.rasterization.rasterize(clip, faces, SIZE, SIZE)
            barycentric = labs.rasterization.barycentrics(face_index, clip, faces)
            seen.append(shaded(vertices, faces, face_index, barycentric))
        yield "  steps 0, 30, 100, 300", save("fit_bunny", name, np.hstack(seen))


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


def clip_positions(labs, vertices, eye, target=(0.0, 0.0, 0.0), near=0.1):
    """Vertices (V, 3) in world space -> clip (V, 4), for a camera at eye that looks at target."""
    transforms = labs.transforms
    view_from_world = transforms.look_at(eye, np.asarray(target), np.array([0.0, 1.0, 0.0]))
    clip_from_view = transforms.perspective(np.radians(48), 1.0, near, 10.0)
    points = transforms.to_homogeneous(vertices)
    return transforms.transform(points, clip_from_view @ view_from_world)


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


SCENES = {scene.__name__: scene for scene in (bunny, teapot, flight, aliasing, msaa,
                                               fit_triangle, fit_cube, fit_pose, fit_texture,
                                               fit_bunny, fit_outlines)}
