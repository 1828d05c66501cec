"""The meshes that a reader turns: GLB files and stills of them, made with the course's own code."""
import html
import json

import trimesh

from course.experiments.scenes import drawing, levels, portrait
from course.experiments.scenes.demo import Labs
from course.given import image, mesh
from course.given.places import ROOT, read_whole

from . import put

PLACES = {  # the meshes that a reader turns: their lecture, and words of the figure above them
    "teapot": ("01_transforms", "the teapot, grey around the origin and blue after the product"),
    "loop": ("11_subdivision", "left, the bunny's head with its own faces"),
    "simplified": ("12_simplification", "Left, the bunny while its faces become fewer"),
    "found": ("16_reconstruction", "three rows of two pictures. Top, target 16 and what was found"),
}
WORDS = {"teapot": "the Utah teapot", "loop": "a ring of 64 large faces",
         "simplified": "the Stanford bunny, lit, each face in one shade",
         "found": "a bunny with blue, red and yellow paint, found from 24 pictures"}
CAPTIONS = {"teapot": "The teapot, for you to turn.",
            "loop": "Three steps of Loop, each with four times as many faces.",
            "simplified": "The bunny in ever fewer faces.",
            "found": "What this search finds from 24 pictures of another object: a painted bunny. "
                     "Lab 12 left 10,000 of its faces."}
FACE_COUNTS = 1500, 700, 350, 150, 64
FOUND = ROOT / "site" / "meshes" / "bunny.glb"
EYES = {"teapot": portrait.TEAPOT_EYE, "loop": levels.RING_EYE,
        "simplified": levels.BUNNY_EYE, "found": portrait.BUNNY_EYE}  # of the stills
TEXT = ('<figure class="orbit" data-shading="{shading}" data-eye="{eye}" data-meshes="{meshes}">'
        '<img src="../meshes/{name}.png" alt="{words}" width="512" height="512" loading="lazy" '
        'decoding="async"><figcaption>{caption}</figcaption></figure>')


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
        shading = "smooth" if name == "teapot" else "flat"
        put_picture(extra / "meshes" / f"{name}.png", still(labs, shading, EYES[name], *steps[0]))
        figures[name] = figure(name, files, shading)
    put(extra / "meshes" / "found.glb", read_whole(FOUND))
    put(extra / "meshes" / "found.png", read_whole(FOUND.with_suffix(".png")))
    label = f"{sum(map(len, faces_of(FOUND))):,} faces, found from 24 pictures"
    found = [{"file": "../meshes/found.glb", "label": label}]
    return {**figures, "found": figure("found", found, "smooth")}


def figure(name, files, shading):
    meshes = html.escape(json.dumps(files))
    return TEXT.format(name=name, shading=shading, meshes=meshes,
                       eye=" ".join(map(str, EYES[name])), words=html.escape(WORDS[name]),
                       caption=CAPTIONS[name])


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


def faces_of(path):
    return [part.faces for part in trimesh.load_scene(path).geometry.values()]


def still(labs, shading, eye, vertices, faces):
    """A mesh as its lab draws it: a picture (512, 512, 3)."""
    if shading == "smooth":
        clip = drawing.clip_positions(labs, vertices, eye)
        return drawing.smooth(labs, vertices, faces, clip)
    return levels.faceted(labs, vertices, faces, eye)


def put_picture(path, picture):
    path.parent.mkdir(parents=True, exist_ok=True)
    image.write(path, picture)
