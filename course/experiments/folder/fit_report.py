"""How good the mesh from a folder of pictures is: numbers, pictures, and one page with all of it.

The page is a single file. fit_report.html is its template, and fit_report.js turns the mesh.
"""
import base64
import html
import io
import json
import string
import time
from pathlib import Path
from typing import NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter
from PIL import Image

from ...given import image, mesh, places, plot
from . import photographs

HERE = Path(__file__).parent
SAMPLES = 2        # squared: how many in a pixel of a rendering
FRAMES, FRAME_SIZE, SECONDS = 30, 240, 0.12  # of the turntable
LARGEST = 192      # pixels of a picture's side in the page, so that the page stays small
DIFFERENCE = 4     # how often a difference is enlarged
WORST = 24         # views that the page shows, at most
SEARCH, SEEN, SPLIT = slice(0, 3), slice(3, 6), slice(6, 9)  # whose colours, in a rendering


class View(NamedTuple):
    """A picture of the folder (H, W, 4), sRGB and coverage, and its rendering (H, W, 10) in the
    colours of SEARCH, SEEN and SPLIT.
    """

    name: str
    kept_out: bool
    picture: np.ndarray
    rendering: np.ndarray


class Judged(NamedTuple):
    """What the report says: what was Found, its views, the steps of the search's stages, and the
    mesh's faces, pieces and genus.
    """

    found: object
    views: list
    stages: list
    faces: int
    pieces: int
    genus: int


# --- numbers ------------------------------------------------------------------------------------


def judged(labs, found, photos, stages, kept_out):
    """Judged. kept_out names the pictures that the search did not see."""
    surface, x = labs.multi_view_fit.surface(found.kept.x), found.kept.x
    lit = labs.reconstruction.shade(surface.albedo, surface.normals, x.light)
    pictures = [rendered(labs, *each, photos.cameras, photos.background,
                         photos.pictures[0].shape[:2])
                for each in ((surface, lit), (found.surface, found.colours))]
    views = [View(name, k in kept_out, on_screen(picture),
                  on_screen(np.dstack([searched[..., :3], at_the_end])))
             for k, (name, picture, searched, at_the_end) in enumerate(
                 zip(photos.names, photos.pictures, *pictures, strict=True))]
    faces = found.surface.faces
    return Judged(found, views, stages, len(faces), *labs.reconstruction.genus(faces))


def rendered(labs, surface, colours, cameras, background, shape):
    """Yield a surface as cameras see it: linear colours (V, C), and coverage, as (H, W, C + 1)."""
    behind = np.append(np.resize(background, colours.shape[1]), 0.0)
    return photographs.seen(labs, surface, labs.multi_view_fit.covering(colours), cameras, shape,
                            behind, SAMPLES)


def on_screen(picture):
    """Linear colours and coverage (H, W, C) -> colours as a screen takes them, and coverage."""
    return np.dstack([image.to_srgb(np.clip(picture[..., :-1], 0, 1)), picture[..., -1]])


def psnr(views, on_object, whose=SPLIT):
    """The PSNR of views in dB, over all pixels, or over those in which pictures show the object."""
    squared = [((picture[..., :3] - rendering[..., whose])**2)[
                   picture[..., 3] > 0 if on_object else ...]
               for _, _, picture, rendering in views]
    return image.decibels(max(np.concatenate([each.reshape(-1, 3) for each in squared]).mean(),
                              1e-10))


def iou(view):
    """The intersection over union of the silhouettes."""
    picture, rendering = (each[..., -1] >= 0.5 for each in view[2:])
    return image.intersection_over_union(picture, rendering)


def summary(judged):
    """The numbers, in a line."""
    views = [view for view in judged.views if view.kept_out]
    new = (f", {psnr(views, True):.1f} dB on the object in {len(views)} new views" if views else "")
    loss = judged.found.kept.losses[-1]
    return (f"loss {loss:.4f}, {judged.faces:,} faces, pieces {judged.pieces}, "
            f"genus {judged.genus}{new}")


# --- pictures -----------------------------------------------------------------------------------


def turning(labs, photos, count, away=3.0):
    """Cameras (count, 4, 4) once around the object, so far away, a little from above:
    clip_from_grid.
    """
    up = upwards(photos.cameras)
    side = np.linalg.svd(up[None])[2][1]
    ahead = np.cross(side, up)
    clip_from_view = labs.transforms.perspective(np.radians(40), 1.0, 0.1, 10.0)
    eyes = [away * (0.94 * (np.cos(t) * ahead + np.sin(t) * side) + 0.34 * up)
            for t in 2 * np.pi * np.arange(count) / count]
    return [clip_from_view @ labs.transforms.look_at(eye, np.zeros(3), up) for eye in eyes]


def upwards(cameras):
    """Where "up" is in the grid: at right angles to what is right in all pictures. If they lie on
    a side, it is so to what is up in them, and the cameras are rather above than below.
    """
    forward = mesh.unit(cameras[:, 3, :3])
    right, up = (mesh.unit(side - (side * forward).sum(1, keepdims=True) * forward)
                 for side in (cameras[:, 0, :3], cameras[:, 1, :3]))
    # All around the object, the eigenvalues are -a, a / 2, a / 2, or, of pictures that lie, the
    # negative ones. So the middle one tells.
    stand = np.linalg.eigvalsh(right.T @ right - up.T @ up)[1] > 0
    level, above = (right, up) if stand else (up, -forward)
    axis = np.linalg.svd(level)[2][2]
    return axis if above.mean(0) @ axis > 0 else -axis


def turntable(labs, found, photos, path):
    """Write the object, turning, as an animated PNG on nothing."""
    cameras = turning(labs, photos, FRAMES, 3 * max(reach(found), 0.4))
    frames = [clear(frame) for frame in rendered(
        labs, found.surface, found.colours[:, 3:], cameras, np.zeros(3), 2 * (FRAME_SIZE,))]
    image.write_animation(path, frames, SECONDS)


def clear(picture):
    """Linear colours on black and coverage -> sRGB colours and alpha."""
    alpha = picture[..., 3:]
    return on_screen(np.dstack([picture[..., :3] / np.maximum(alpha, 1e-6), alpha]))


def difference(view):
    """Where picture and rendering differ: white where they do not."""
    apart = np.abs(view.picture[..., :3] - view.rendering[..., SPLIT])
    return 1 - np.clip(DIFFERENCE * apart, 0, 1)


def loss_curve(losses, stages):
    """The losses, step by step, as an SVG's bytes. Lines between the stages."""
    with mpl.rc_context():
        plot.style()
        mpl.rcParams["svg.hashsalt"] = "loss"
        figure = Figure(figsize=(7.2, 3.0))
        axes = figure.add_subplot()
        axes.semilogy(np.arange(1, len(losses) + 1), losses, color=plot.SKY, linewidth=0.8)
        smooth = [np.mean(losses[max(0, k - 9):k + 1]) for k in range(len(losses))]
        axes.semilogy(np.arange(1, len(losses) + 1), smooth, color=plot.BLUE)
        for end in np.cumsum(stages)[:-1]:
            axes.axvline(end + 0.5, color=plot.GREY, linewidth=0.8, linestyle=":")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(FormatStrFormatter("%.3g"))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.set(xlabel="step", ylabel="loss of the views drawn", xlim=(0, len(losses) + 1))
        content = io.BytesIO()
        figure.savefig(content, format="svg", metadata={"Date": None})
    return content.getvalue()


# --- the page -----------------------------------------------------------------------------------


def write(labs, judged, photos, path, began):
    """turntable.png, and report.html with all that it shows, beside the GLB file of this path.

    began: the processor's time when the command began, less what it took in earlier runs.
    """
    turntable(labs, judged.found, photos, path.with_name("turntable.png"))
    page = string.Template((HERE / "fit_report.html").read_text(encoding="utf-8")).substitute(
        title=html.escape(path.stem), viewer=(HERE / "fit_report.js").read_text(encoding="utf-8"),
        turntable=as_uri("image/png", path.with_name("turntable.png").read_bytes()),
        loss=as_uri("image/svg+xml", loss_curve(judged.found.kept.losses, judged.stages)),
        mesh=as_uri("model/gltf-binary", path.read_bytes()),
        scene=scene(labs, judged.found, photos),
        psnr=rows(psnr_table(judged.views)), numbers=rows(numbers(judged, began)),
        views="\n".join(map(figure, worst(judged.views))),
        kept_out=about_kept_out(judged.views),
        assumed="\n".join(f"<li>{html.escape(each)}</li>" for each in
                          photos.assumed or ["Nothing: all was in the folder."]))
    places.write_whole(path.with_name("report.html"), page.encode())


def scene(labs, found, photos):
    """What the page's viewer needs besides the mesh, as JSON: light, the way up, the mesh's middle
    and reach in the world.

    It draws no shadows. So the sun joins the nine numbers.
    """
    sun = labs.reconstruction.distant_light(found.look.sun[:1], found.look.sun[1:])
    return json.dumps({"light": (found.look.light + sun).round(5).tolist(),
                       "up": upwards(photos.cameras).round(5).tolist(),
                       "centre": photos.world_from_grid[:3, 3].tolist(),
                       "reach": photos.world_from_grid[0, 0] * reach(found)})


def reach(found):
    """How far the mesh goes from the middle of the grid."""
    return np.linalg.norm(found.surface.vertices, axis=1).max()


def numbers(judged, began):
    """{what: how much} of the table, in words."""
    mean, kept = np.mean([iou(view) for view in judged.views]), judged.found.kept
    seconds = kept.seconds, time.process_time() - began
    search, whole = ("{} min {} s".format(*divmod(round(each), 60)) for each in seconds)
    return {"IoU of the silhouettes, mean of all": f"{mean:.4f}",
            "Area that no picture of the search shows": f"{100 * unseen(judged.found):.1f} %",
            "Albedo of other light that fits as well": f"± {100 * judged.found.doubt:.0f} %",
            "Faces": f"{judged.faces:,}", "Pieces": str(judged.pieces),
            "Genus": str(judged.genus), "Steps": str(len(kept.losses)),
            "Processor time to the end of the search": search, "Processor time of all": whole}


def psnr_table(views):
    """{which pixels: three PSNRs} of the table: in the colours of SEARCH, SEEN and SPLIT."""
    return {f"{name}, {where}": [f"{psnr(chosen, on_object, whose):.2f}"
                                 for whose in (SEARCH, SEEN, SPLIT)]
            for name, new in (("New views", True), ("Views of the search", False))
            if (chosen := [view for view in views if view.kept_out == new])
            for where, on_object in (("on the object", True), ("whole pictures", False))}


def unseen(found):
    """Which share of a Found's area no picture shows. A third of a triangle is each corner's."""
    faces = found.surface.faces
    area = np.linalg.norm(mesh.area_vectors(found.surface.vertices, faces), axis=1)
    return area @ (found.count[faces] == 0).mean(1) / area.sum()


def rows(table):
    """{name: a cell, or several} as the rows of a table in HTML."""
    cells = {name: "".join(f"<td>{cell}</td>" for cell in np.atleast_1d(given))
             for name, given in table.items()}
    return "\n".join(f"<tr><th scope=row>{name}</th>{row}</tr>" for name, row in cells.items())


def worst(views):
    """The WORST views, or all, by their PSNR on the object."""
    return sorted(views, key=lambda view: psnr([view], True))[:WORST]


def about_kept_out(views):
    """A sentence: which pictures the search did not see."""
    count = sum(view.kept_out for view in views)
    shown = f"The worst come first{f', and {WORST} are shown' if len(views) > WORST else ''}."
    if not count:
        return f"{shown} The search saw all pictures: from eight on, every eighth is kept out."
    return (f"{shown} The search did not see {count} of the {len(views)} pictures. They are marked "
            "as new. How well they are met is the fair measure.")


def figure(view):
    """A view as HTML: picture, rendering, difference, numbers."""
    name = html.escape(view.name)
    pictures = (("picture", view.picture[..., :3]), ("rendering", view.rendering[..., SPLIT]),
                ("difference", difference(view)))
    images = "".join(f'<img src="{as_uri("image/jpeg", jpeg(each))}" alt="{name}: the {kind}">'
                     for kind, each in pictures)
    mark = ' <b class=new>new</b>' if view.kept_out else ""
    return (f"<figure><div>{images}</div><figcaption>{name}{mark}<br><small>"
            f"{psnr([view], True):.1f} dB on the object, {psnr([view], False):.1f} in all, "
            f"IoU {iou(view):.3f}</small></figcaption></figure>")


def jpeg(picture):
    """An image, made smaller than LARGEST pixels a side, as the bytes of a JPEG file."""
    content = io.BytesIO()
    made = Image.fromarray(np.rint(255 * np.clip(picture[::-1], 0, 1)).astype(np.uint8))
    made.thumbnail((LARGEST, LARGEST), Image.Resampling.BOX)
    made.save(content, "JPEG", quality=90)
    return content.getvalue()


def as_uri(kind, content):
    """Bytes as a URI that holds them."""
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"
