"""What the scenes share: smooth shading, fits, and pictures on disk."""
import numpy as np

from labkit import places

from ..given import image, mesh

SIZE = 512
LIGHT = np.array([-0.4, 0.6, 0.7])  # direction towards the light, in world space
BACKGROUND = np.array([0.93, 0.95, 0.97])
BRASS = np.array([0.85, 0.66, 0.48])
WHITE = np.ones(3)

# --- meshes, and what is seen of them -----------------------------------------------------------


def unit_bunny():
    """The Stanford bunny, scaled to the unit sphere -> vertices, faces."""
    vertices, faces = mesh.bunny()
    return mesh.normalize(vertices), faces


def size_in_words(vertices, faces):
    """The size of a mesh that was read, in words."""
    return f"read {len(vertices):,} vertices, {len(faces):,} faces"


def on_black(labs, shape, colours, clip_from_model, size):
    """A pipeline.Mesh of colours (V, C) on black: the picture (size, size, C), and what
    `render_backward` takes besides its gradient.
    """
    given = (shape, labs.pipeline.Colours(colours),
             labs.pipeline.View(clip_from_model, size, size, np.zeros(colours.shape[1])))
    picture, buffers = labs.pipeline.render(*given)
    return picture, buffers, *given


def seen_mask(labs, vertices, faces, camera, size):
    """Where a mesh is seen at the pixels' centres: bool (size, size)."""
    clip = labs.pipeline.to_clip(vertices, camera)
    return labs.rasterization.rasterize(clip, faces, size, size)[0] >= 0


def smooth(labs, vertices, faces, clip, size=SIZE):
    """A mesh with smooth shading: a picture (size, size, 3)."""
    seen = labs.pipeline.visible(clip, faces, size, size)
    return shaded(vertices, faces, seen.face_index, seen.barycentric)


def shaded(vertices, faces, face_index, barycentric):
    """Face index and barycentrics of a picture -> the picture with `lit` faces."""
    seen = face_index >= 0
    corners = mesh.vertex_normals(vertices, faces)[faces[face_index[seen]]]
    normal = np.einsum("nk,nkc->nc", barycentric[seen], corners)
    return painted(seen, image.to_srgb(lit(normal)))


def lit(normal):
    """One light on normals (N, 3) of any length -> linear colour (N, 3). It also reaches round the
    edge.
    """
    light = (0.5 + 0.5 * mesh.unit(normal) @ LIGHT / np.linalg.norm(LIGHT)) ** 2
    return light[:, None] * BRASS


def wireframe(seen, barycentric, derivatives):
    """Edges one pixel wide, hidden ones hidden: b_k / |db_k| is the distance to edge k in pixels.

    After Baerentzen et al. 2006, "Single-pass wireframe rendering".
    """
    distance = barycentric[seen] / np.linalg.norm(derivatives[seen], axis=-1)
    ink = np.clip(1.2 - distance.min(1), 0, 1)[:, None]
    return painted(seen, ink * np.array([0.10, 0.15, 0.30]) + (1 - ink) * np.ones(3))


# --- fits ---------------------------------------------------------------------------------------


def descended(labs, start, gradient, rates, *update, **settings):
    """Lab 9's `descend` to its end -> [start, x after each step], losses (steps,)."""
    path, losses = [start], []
    for x, loss in labs.inverse_rendering.descend(start, gradient, rates, *update, **settings):
        path.append(x)
        losses.append(loss)
    return path, np.array(losses)


# --- pictures -----------------------------------------------------------------------------------


def painted(seen, colours):
    """Colours (N, 3) of the seen pixels (H, W) -> picture (H, W, 3) on the background."""
    picture = np.tile(BACKGROUND, (*seen.shape, 1))
    picture[seen] = colours
    return picture


def enlarged(picture, times):
    """Each pixel of a picture (H, W) or (H, W, C) as a square of times x times."""
    return picture.repeat(times, 0).repeat(times, 1)


def save(scene, name, picture):
    """Write a picture of a scene -> its path."""
    path = places.out("demo", scene, f"{name}.png")
    image.write(path, picture)
    return path


def save_labelled(path, columns):
    """Write pictures {label: (H, W, 3)}, side by side, each below its label -> the path."""
    from matplotlib.figure import Figure  # here, so that no other scene waits for it
    sheet = np.hstack(list(columns.values()))
    height, width = sheet.shape[:2]
    figure = Figure((width / 100, height / 100 + 0.3), dpi=100)
    figure.figimage(sheet, origin="lower")
    for k, label in enumerate(columns):
        figure.text((k + 0.5) / len(columns), 0.995, label, ha="center", va="top", fontsize=14)
    figure.savefig(path, metadata={"Software": None})
    return path
