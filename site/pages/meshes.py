"""The meshes that a reader turns: GLB files and stills of them, made with the course's own code."""
import html
import json
from typing import NamedTuple

import trimesh

from course.given import image, mesh
from course.given.places import ROOT, read_whole
from course.given.whose import Labs
from course.scenes import drawing, levels, portrait, viewing

from . import picture, put


class Turned(NamedTuple):
    """A mesh that a reader turns, and its still."""

    words: str     # what is seen
    caption: str
    eye: tuple     # where the still's camera stands
    shading: str = "flat"


MESHES = {
    "teapot": Turned("the Utah teapot", "The teapot, for you to turn.",
                     portrait.TEAPOT_EYE, "smooth"),
    "loop": Turned("a ring of 64 large faces",
                   "Three steps of Loop, each with four times as many faces.", levels.RING_EYE),
    "simplified": Turned("the Stanford bunny, lit, each face in one shade",
                         "The bunny in ever fewer faces.", levels.BUNNY_EYE),
    "found": Turned("a bunny with blue, red and yellow paint, found from 24 pictures",
                    "What this search finds from 24 pictures of another object: a painted bunny. "
                    "Lab 12 left 10,000 of its faces.", portrait.BUNNY_EYE, "smooth"),
}
FACE_COUNTS = 1500, 700, 350, 150, 64
FOUND = ROOT / "site" / "meshes" / "bunny.glb"
TEXT = ('<figure class="orbit" data-shading="{shading}" data-eye="{eye}" data-meshes="{meshes}">'
        '{still}<figcaption>{caption}</figcaption></figure>')


def write(extra):
    """Write extra/meshes: the GLB files and their stills -> {name: the figure's HTML}."""
    labs = Labs("reference")
    teapot, teapot_faces = mesh.teapot()
    made = {"teapot": [(mesh.normalize(teapot), teapot_faces)], "loop": rings(labs),
            "simplified": bunnies(labs)}
    figures = {}
    for name, steps in made.items():
        files = []
        for number, (vertices, faces) in enumerate(steps):
            put(extra / "meshes" / f"{name}_{number}.glb", glb(vertices, faces))
            files.append({"file": f"../meshes/{name}_{number}.glb",
                          "label": f"{len(faces):,} faces"})
        image.write(extra / "meshes" / f"{name}.png", still(labs, MESHES[name], *steps[0]))
        figures[name] = figure(name, files)
    put(extra / "meshes" / "found.glb", read_whole(FOUND))
    put(extra / "meshes" / "found.png", read_whole(FOUND.with_suffix(".png")))
    label = f"{len(trimesh.load_mesh(FOUND).faces):,} faces, found from 24 pictures"
    found = [{"file": "../meshes/found.glb", "label": label}]
    return {**figures, "found": figure("found", found)}


def figure(name, files):
    turned = MESHES[name]
    return TEXT.format(shading=turned.shading, eye=" ".join(map(str, turned.eye)),
                       meshes=html.escape(json.dumps(files)), caption=turned.caption,
                       still=picture(f"../meshes/{name}.png", turned.words, 512, 512))


def rings(labs):
    """A coarse ring and three steps of Loop."""
    steps = [mesh.torus(64, radius=0.8, tube=0.45)]
    for _ in range(3):
        steps.append(labs.loop_subdivision.loop(*steps[-1])[:2])
    return steps


def bunnies(labs):
    """The bunny in ever fewer faces."""
    steps = [drawing.unit_bunny()]
    for face_count in FACE_COUNTS:
        steps.append(labs.collapse_heap.simplify(*steps[-1], face_count)[:2])
    return steps


def glb(vertices, faces):
    """A mesh with its normals as a binary glTF file."""
    made = trimesh.Trimesh(vertices, faces, process=False,
                           vertex_normals=mesh.vertex_normals(vertices, faces))
    return made.export(file_type="glb", include_normals=True)


def still(labs, turned, vertices, faces):
    """A mesh as its lab draws it: a picture (512, 512, 3)."""
    if turned.shading == "smooth":
        clip = viewing.clip_positions(labs, vertices, turned.eye)
        return drawing.smooth(labs, vertices, faces, clip)
    return levels.faceted(labs, vertices, faces, turned.eye)
