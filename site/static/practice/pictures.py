"""What exercises draw, for the page on which they are done: functions here, then pictures of demos.

All draw with the labs' own code, and nothing else computes what an exercise is asked for. All are
pictures (H, W, 3) from 0 to 1, row 0 below.
"""
import numpy as np

from course.given import image, mesh
from course.given.whose import Labs
from course.scenes import demo, viewing

SIZE = 96
TRIANGLE = np.array([[10.0, 14.0], [86.0, 26.0], [40.0, 84.0]])
EYE = np.array([-1.3, 0.7, 2.2])
PAPER, INK, SKY = np.array([0.95, 0.96, 0.98]), np.array([0.1, 0.2, 0.5]), np.array([0.5, 0.7, 1.0])


def drawn(name, package):
    """The picture of this name, by the labs of a package."""
    scene, _, file = name.partition("/")
    if not file:
        return OWN[name](Labs(package))
    return next(image.read(path) for _, path, *_ in demo.scene(scene)(Labs(package))
                if path and path.stem == file)


def in_words(name):
    """What a picture shows."""
    scene, _, file = name.partition("/")
    return (demo.title(scene) if file else OWN[name].__doc__).partition(" (lab")[0].rstrip(".")


def centres():
    """The centres of the pixels (SIZE, SIZE, 2)."""
    x = np.arange(SIZE) + 0.5
    return np.stack(np.meshgrid(x, x), -1)


def dots(screen):
    """Points (N, 2) in pixels as dots."""
    picture = np.tile(PAPER, (SIZE, SIZE, 1))
    column, row = np.clip(screen.astype(int), 0, SIZE - 1).T
    picture[row, column] = INK
    return picture


def bunny():
    vertices, faces = mesh.bunny()
    return mesh.normalize(vertices), faces


def lit(normals):
    """Unit normals (N, 3) -> colours of clay in a soft light."""
    return (0.5 + 0.5 * normals @ [-0.4, 0.6, 0.7])[:, None] ** 2 * [0.95, 0.8, 0.65]


def painted(seen, colours):
    picture = np.tile(PAPER, (SIZE, SIZE, 1))
    picture[seen] = colours
    return picture


def moved_grid(labs):
    """A grid of points, turned, stretched and moved."""
    x = np.linspace(-1, 1, 13)
    grid = np.stack(np.meshgrid(x, x, [0.0], [1.0]), -1).reshape(-1, 4)
    matrix = np.array([[34.0, 14, 0, 48.3], [-8, 38, 0, 48.3], [0, 0, 1, 0], [0, 0, 0, 1]])
    return dots(labs.transforms.transform(grid, matrix)[:, :2])


def bunny_vertices(labs):
    """Where each vertex of the bunny lands on the screen."""
    clip = viewing.clip_positions(labs, bunny()[0], EYE)
    return dots(labs.transforms.to_screen(clip, SIZE, SIZE)[:, :2])


def sides(labs):
    """A triangle's three edge functions as red, green and blue, full where all are positive."""
    i, j = np.array([1, 2, 0]), np.array([2, 0, 1])
    e = labs.rasterization.edge_function(centres()[..., None, :], TRIANGLE[i], TRIANGLE[j])
    inside = (e > 0).all(-1, keepdims=True)
    return np.clip(e / 5000, 0, 1) * np.where(inside, 1, 0.25) + np.where(inside, 0, 0.1)


def weights(labs):
    """The weights of a triangle's corners as red, green and blue."""
    return np.clip(labs.rasterization.screen_weights(centres(), TRIANGLE), 0, 1)


def covered(labs):
    """The pixels of a triangle, dark where it is near."""
    is_covered, depth = labs.rasterization.cover(centres(), TRIANGLE, np.array([-0.8, 0.0, 0.9]))
    far = (1 + depth[..., None]) / 2
    return np.where(is_covered[..., None], (1 - far) * INK + far * SKY, PAPER)


def seen_by(labs, vertices, faces):
    """A mesh through labs 1 and 2: clip, face index and where there is a face."""
    clip = viewing.clip_positions(labs, vertices, EYE)
    face_index, _ = labs.rasterization.rasterize(clip, faces, SIZE, SIZE)
    return clip, face_index, face_index >= 0


def flat_bunny(labs):
    """The bunny, each face in one shade."""
    vertices, faces = bunny()
    _, face_index, seen = seen_by(labs, vertices, faces)
    return painted(seen, lit(mesh.face_normals(vertices, faces))[face_index[seen]])


def weights_on_ball(labs):
    """The weights of the corners of a ball's faces as red, green and blue."""
    vertices, faces = mesh.icosphere(80)
    clip, face_index, seen = seen_by(labs, vertices, faces)
    return painted(seen, labs.interpolation.barycentrics(face_index, clip, faces)[seen])


def smooth_bunny(labs):
    """The bunny, with normals from vertex to vertex."""
    vertices, faces = bunny()
    clip, face_index, seen = seen_by(labs, vertices, faces)
    barycentric = labs.interpolation.barycentrics(face_index, clip, faces)
    normals = labs.interpolation.interpolate(mesh.vertex_normals(vertices, faces), faces,
                                             face_index, barycentric)
    return painted(seen, lit(mesh.unit(normals[seen])))


OWN = {draw.__name__: draw for draw in (moved_grid, bunny_vertices, sides, weights, covered,
                                        flat_bunny, weights_on_ball, smooth_bunny)}
PICTURES = (  # of those that call an exercise, the first is its own
    *OWN, "aliasing/filtered", "msaa/4x", "bunny/wireframe", "floor/linear-mipmap-linear",
    "fit_vertices/steps", "borders/ball", "fit_triangle/with", "cubes/teapot", "cubes/ball",
    "rounded/2", "house/2", "cage/step_12", "simplified/2", "smoothed/smooth", "relaxation/after",
    "shadow/soft", "representations/distance", "hole/step_50", "tiles/fragments", "tiles/bunny")
