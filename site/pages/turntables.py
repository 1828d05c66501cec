"""The films of meshes that turn once, drawn with the course's own code."""
import numpy as np
from PIL import Image

from course.given import image, mesh
from course.given.whose import Labs
from course.scenes import drawing, levels, portrait, viewing
from labkit.places import ROOT, out

from . import picture, webp

FRAMES, SIZE, SECONDS = 24, 512, 0.15
FACE_COUNTS = 1500, 700, 350, 150, 64
FOUND = ROOT / "site" / "meshes" / "bunny.npz"
TURNED = {  # name: where the camera stands, what is seen, the caption
    "teapot": (portrait.TEAPOT_EYE, "the Utah teapot", "The teapot, for you to turn."),
    "loop": (levels.RING_EYE, "a ring, first of 64 large faces, at last of 4,096 small ones",
             "Three steps of Loop, each with four times as many faces."),
    "simplified": (levels.BUNNY_EYE, "the Stanford bunny, each face in one shade, loses its faces",
                   "The bunny in ever fewer faces."),
    "found": (portrait.BUNNY_EYE, "a bunny with blue, red and yellow paint",
              "What this search finds from 24 pictures of another object: a painted bunny. "
              "Lab 12 left 10,000 of its faces."),
}


def write(extra):
    """Write extra/turns: the films and their stills -> {name: the figure's HTML}."""
    labs = Labs("reference")
    films = {name: film(labs, steps, TURNED[name][0]) for name, steps in shapes(labs).items()}
    return {name: figure(extra / "turns", name, frames, SECONDS, *TURNED[name][1:])
            for name, frames in films.items()}


def figure(folder, name, frames, seconds, words, caption):
    """Write a film, whose file begins with its end, and the still of this end -> its HTML."""
    film = out("site-source", "film.png")
    image.write_animation(film, [frames[-1], *frames[:-1]], seconds)
    count = webp(folder, name, Image.open(film))
    still = picture(f"../{folder.name}/{name}_still.webp", words, *image.size(film))
    return (f'<figure class="animation" id="figure-{name}" data-frames="{count}" '
            f'data-file="../{folder.name}/{name}.webp">'
            f"{still}<figcaption>{caption}</figcaption></figure>")


def shapes(labs):
    """{name: the meshes of its film in their order}, each vertices, faces and colours (V, 3)."""
    teapot, teapot_faces = mesh.teapot()
    found = np.load(FOUND)
    rings, bunnies = [mesh.torus(64, radius=0.8, tube=0.45)], [drawing.unit_bunny()]
    for _ in range(3):
        rings.append(labs.loop_subdivision.loop(*rings[-1])[:2])
    for count in FACE_COUNTS:
        bunnies.append(labs.collapse_heap.simplify(*bunnies[-1], count)[:2])
    return {"teapot": [(mesh.normalize(teapot), teapot_faces, drawing.BRASS)],
            "loop": [faceted(*ring) for ring in rings],
            "simplified": [faceted(*bunny) for bunny in bunnies],
            "found": [(found["vertices"], found["faces"], found["albedo"] / 255)]}


def faceted(vertices, faces):
    """The same surface in faces that share no vertex, so that each has one shade."""
    return vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3), drawing.BRASS


def film(labs, steps, eye):
    """The pictures of one turn. Each mesh has its share of them, and the last stands as it is."""
    view = labs.pipeline.View(viewing.clip_from_world(labs, eye), SIZE, SIZE, drawing.BACKGROUND)
    frames = []
    for k in range(FRAMES):
        vertices, faces, colours = steps[k * len(steps) // FRAMES]
        angle = 2 * np.pi * (k + 1) / FRAMES
        turned = vertices @ labs.transforms.rotate(np.array([0.0, 1.0, 0.0]), angle)[:3, :3].T
        light = drawing.lit(mesh.vertex_normals(turned, faces)) / drawing.BRASS
        frames.append(labs.pipeline.render(labs.pipeline.make_mesh(turned, faces),
                                           labs.pipeline.Colours(image.to_srgb(light * colours)),
                                           view)[0])
    return frames
