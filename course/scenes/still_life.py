"""A still life by a window: a teapot, a bunny, a ball and a ring on tiles, all in linear light.

A picture is a mean of samples. For each of them the camera moves by part of a pixel, and other
lamps are lit. Together these are a window and the sky, so that shadows are soft and corners dark.
It uses labs 1, 2, 4, 5, 6, 11 and 14.
"""
from typing import NamedTuple

import numpy as np
from scipy.sparse.csgraph import connected_components

from ..given import image, mesh
from ..given.ray_casting import GOLDEN_ANGLE, disc_offsets
from .drawing import save
from .reflections import reflected, teapot
from .viewing import UP, directions

EYE, TARGET, FOV_Y = np.array([-0.9, 1.75, 7.4]), np.array([-0.06, 0.52, 0.0]), np.radians(15.2)
WINDOW = mesh.unit(np.array([-0.74, 0.78, 0.60]))  # towards it
WARM, HAZE, BLUE = np.array([[1.0, 0.84, 0.62], [0.66, 0.69, 0.72], [0.24, 0.36, 0.56]])
CREAM, GREY, CLAY, TEAL, OCHRE, BRASS = image.to_linear(np.array([
    [0.88, 0.84, 0.76], [0.55, 0.62, 0.66], [0.80, 0.46, 0.33], [0.04, 0.40, 0.42],
    [0.92, 0.66, 0.22], [0.93, 0.74, 0.45]]))
PLACES = np.array([  # of teapot, bunny, ball and ring: size, turn about y, x, z
    [1.08, 3.6, 0.44, 0.0], [0.84, 0.7, -0.84, -0.75], [0.23, 0, -0.34, 0.95], [0.31, 0, 0.6, 1.2]])
MIRRORS = {0: 0.05, 2: 0.05, 3: BRASS}  # thing: what it mirrors, seen straight on
NEAR = 3.5                              # from the middle; shadows do not fall farther
MAP, SIDE = 512, 128                    # texels along a side of a lamp's map, and of a cube map


class Scene(NamedTuple):
    """vertices (V, 3), faces (F, 3), the (u, v) of each face's corners (3 F, 2), each face's thing
    (F,): those of PLACES, then the floor. textures: of each thing. lamps, cubes: see `lit`.
    """

    vertices: np.ndarray
    faces: np.ndarray
    uv: np.ndarray
    thing: np.ndarray
    textures: list
    lamps: list
    cubes: dict


# --- things --------------------------------------------------------------------------------------


def shape(labs, steps=2):
    """The Scene without its light: no lamps, no cubes. steps of Loop make its things round."""
    cages = teapot(), mesh.bunny(), mesh.icosphere(500), mesh.torus(64, 0.72, 0.26)
    parts = [placed(*rounded(labs, *cage, steps), *place)
             for cage, place in zip(cages, PLACES, strict=True)]
    floor, squares = mesh.plane(2)
    uv = [around(*part) for part in parts] + [100 * floor[squares.ravel()][:, [0, 2]]]
    vertices, faces = zip(*parts, (60 * floor, squares), strict=True)
    starts = np.cumsum([0, *map(len, vertices[:-1])])
    return Scene(np.concatenate(vertices), np.concatenate([*map(np.add, faces, starts)]),
                 np.concatenate(uv), np.repeat(np.arange(5), [*map(len, faces)]),
                 [band(), CLAY[None, None], OCHRE[None, None], 0 * BRASS[None, None], tiles()],
                 [], {})


def rounded(labs, cage, faces, steps):
    """A cage's limit surface, after steps of Loop."""
    corners, origin = labs.subdivision.split_fans(faces.ravel(), np.full(len(faces), 3))
    return labs.loop_subdivision.loop_surface(cage[origin], corners.reshape(-1, 3), steps)


def placed(vertices, faces, size, turn, x, z):
    """A thing of this size, turned about y, on the floor."""
    c, s = np.cos(turn), np.sin(turn)
    vertices = size * mesh.normalize(vertices) @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
    return vertices + [x, -vertices[:, 1].min(), z], faces


def around(vertices, faces):
    """The corners' u, around the largest part without a seam, and v, up; v = 0 on other parts."""
    part = connected_components(mesh.adjacency(faces, len(vertices)))[1]
    body = part == np.bincount(part).argmax()
    x, y, z = (vertices - vertices[body].mean(0)).T
    u = np.arctan2(x, z)[faces] / (2 * np.pi)
    u += u < u.max(1, keepdims=True) - 0.5
    return np.stack([u, (body * (y - y.min()) / np.ptp(y))[faces]], -1).reshape(-1, 2)


def tiles(size=256):
    """A tile of the floor (size, size, 3)."""
    y, x = np.abs((np.indices((4 * size, 4 * size)) + 0.5) / (4 * size) - 0.5)
    corner, middle = np.hypot(x - 0.5, y - 0.5), x + y
    paint = np.tile(CREAM, (*x.shape, 1))
    paint[corner < 0.24] = 0.4 * CLAY + 0.6 * CREAM
    paint[np.abs(corner - 0.335) < 0.025] = GREY
    paint[(middle < 0.14) | (np.abs(middle - 0.205) < 0.015)] = GREY
    paint[np.maximum(x, y) > 0.488] = 0.6 * CREAM
    return paint.reshape(size, 4, size, 4, 3).mean((1, 3))


def band(size=1024):
    """The teapot's glaze (size, size, 3)."""
    v, u = (np.indices((size, size)) + 0.5) / size
    paint = np.tile(TEAL, (size, size, 1))
    paint[np.abs(v - 0.48) < 0.085] = CREAM
    paint[np.abs(v - 0.48 - 0.035 * np.sin(2 * np.pi * 14 * u)) < 0.012] = OCHRE
    return paint


# --- light ---------------------------------------------------------------------------------------


def lit(labs, scene, count=64):
    """The Scene with lamps: the direction to each, its colour, Light and map (lab 14). And with
    cubes: what mirrors have around them (lab 6), as {thing: (middle (3,), cube map)}.
    """
    scene = scene._replace(lamps=[*lamps(labs, scene, count)])
    some = scene._replace(lamps=scene.lamps[::8])
    return scene._replace(cubes={thing: surroundings(labs, some, thing) for thing in MIRRORS})


def lamps(labs, scene, count):
    """Three of eight lamps are in the window, the others in the sky."""
    axes = np.linalg.svd(WINDOW[None])[2][1:]
    panes = mesh.unit(WINDOW + 0.16 * disc_offsets(3 * count // 8) @ axes)
    k = np.arange(count - len(panes)) + 0.5
    dome = directions(k * GOLDEN_ANGLE / (2 * np.pi), 1 - np.arccos(k / len(k)) / np.pi)
    colours = np.concatenate([np.tile(1.1 * count / len(panes) * WARM, (len(panes), 1)),
                              1.6 * count / len(k) * sky(dome)])
    for towards, colour in zip(np.concatenate([panes, dome]), colours, strict=True):
        light = labs.lights.directional_light(-towards, scene.vertices[:-4])
        yield (towards, colour, light,
               labs.shadow_mapping.depth_map(scene.vertices, scene.faces[:-2], light, MAP))


def sky(d):
    """The light from unit vectors d (..., 3) above the floor, but for the window's: (..., 3)."""
    haze = np.exp(-3 * np.abs(d[..., 1:2]))
    return haze * HAZE + (1 - haze) * BLUE


def window(d):
    """Where do unit vectors d (..., 3) go through one of the window's four panes? -> (...)"""
    right = mesh.unit(np.cross(UP, WINDOW))
    across = np.stack([d @ right, d @ np.cross(WINDOW, right)]) / np.maximum(d @ WINDOW, 1e-9)
    return ((np.abs(across) < 0.28) & (np.abs(across) > 0.02)).all(0)


def surroundings(labs, scene, thing):
    """The cube map (6, SIDE, SIDE, 3) around a thing's middle, and this middle."""
    own = scene.thing == thing
    middle = scene.vertices[scene.faces[own]].mean((0, 1))
    others = scene._replace(faces=scene.faces[~own], thing=scene.thing[~own],
                            uv=scene.uv[np.repeat(~own, 3)])
    d = mesh.unit(labs.cube_maps.texel_directions(SIDE))
    cube = sky(d) + 5 * window(d)[..., None] * WARM
    square = labs.transforms.perspective(np.pi / 2, 1.0, 0.05, 100.0)
    for face, (_, down, out) in zip(cube, labs.cube_maps.FRAMES, strict=True):
        view = square @ labs.transforms.look_at(middle, middle + out, down)
        shaded(labs, others, labs.pipeline.to_clip(scene.vertices, view), middle, face)
    return middle, cube


def received(labs, lamps, points, normals):
    """The light that points (N, 3) receive, the mean of lamps: (N, 3). Far away, as the floor."""
    total = np.tile(sum(d[1] * colour for d, colour, *_ in lamps), (len(points), 1))
    near = np.linalg.norm(points, axis=1) < NEAR
    points, normals = points[near], normals[near]
    total[near] = len(lamps) * 0.2 * (0.5 - 0.5 * normals[:, 1:2]) * CREAM  # what the floor sends
    for d, colour, *light_and_map in lamps:
        share = np.clip(normals @ d, 0, None)
        facing = np.flatnonzero(share)
        share[facing] *= labs.shadow_mapping.hard_shadow(points[facing], normals[facing],
                                                         *light_and_map, 4e-3)
        total[near] += share[:, None] * colour
    return total / len(lamps)


# --- the picture ---------------------------------------------------------------------------------


def camera(labs, width, height):
    """The matrix (4, 4) of the camera at EYE: clip_from_world."""
    clip_from_view = labs.transforms.perspective(FOV_Y, width / height, 1.0, 100.0)
    return clip_from_view @ labs.transforms.look_at(EYE, TARGET, UP)


def picture(labs, scene, width, height, samples=16):
    """A lit Scene in linear light (height, width, 3), with so many samples in a pixel."""
    clip = labs.pipeline.to_clip(scene.vertices, camera(labs, width, height))
    total = np.zeros((height, width, 3))
    for k, offset in enumerate(labs.msaa.standard_pattern(samples)):
        total += shaded(labs, scene._replace(lamps=scene.lamps[k::samples]),
                        labs.msaa.centre_sample(clip, offset, width, height), EYE,
                        np.tile(HAZE, (height, width, 1)), -np.log2(samples) / 2)
    return total / samples


def shaded(labs, scene, clip, eye, picture, bias=0.0):
    """A background (H, W, 3), on which the things are painted that an eye sees."""
    seen = labs.pipeline.visible(clip, scene.faces, *picture.shape[1::-1])
    derivatives = labs.interpolation.barycentrics_derivatives(seen.face_index, clip, scene.faces)
    there = seen.face_index >= 0
    normals = mesh.vertex_normals(scene.vertices, scene.faces)
    given = np.concatenate([scene.vertices - eye, normals], 1), scene.faces, seen.face_index
    at = labs.interpolation.interpolate(*given, seen.barycentric)[there]
    change = labs.interpolation.interpolate_derivatives(*given, derivatives)[there]
    away, normals = at[:, :3], mesh.unit(at[:, 3:])
    colour = painted(labs, scene, seen, derivatives, bias)
    colour *= received(labs, scene.lamps, away + eye, normals)
    look = away + eye, *reflected(away, change[:, :3], at[:, 3:], change[:, 3:])
    slant = 1 - np.abs((mesh.unit(away) * normals).sum(1, keepdims=True))
    for thing, cube in scene.cubes.items():
        its = scene.thing[seen.face_index[there]] == thing
        share = MIRRORS[thing] + (1 - MIRRORS[thing]) * slant[its]**5  # Schlick 1994
        shown = mirrored(labs, cube, *(values[its] for values in look), bias)
        colour[its] += share * (shown - colour[its])
    clear = np.exp(-(np.clip(np.linalg.norm(away, axis=1) - 7, 0, None) / 14)**2)[:, None]
    picture[there] = clear * colour + (1 - clear) * HAZE
    return picture


def painted(labs, scene, seen, derivatives, bias):
    """The colours (N, 3) of the textures at the pixels that see a thing."""
    thing = scene.thing[seen.face_index[seen.face_index >= 0]]
    corners = np.arange(len(scene.uv)).reshape(-1, 3)
    uv, footprint = labs.pipeline.footprints(scene.uv, corners, seen, derivatives)
    colour = np.empty((len(uv), 3))
    for k, texture in enumerate(scene.textures):
        its = thing == k
        colour[its] = labs.mipmapping.texture(texture, uv[its], footprint[its], bias,
                                              "linear-mipmap-linear")
    return colour


def mirrored(labs, cube, points, d, change, bias):
    """What points (N, 3) see in directions d (N, 3): the floor where it is, all else far away."""
    middle, faces = cube
    floor = np.clip(-d[:, 1:2], 0, None) / np.maximum(points[:, 1:2], 1e-3)  # 1 / its distance
    return labs.cube_maps.cube_texture(faces, d + floor * (points - middle), change, bias,
                                       "linear-mipmap-linear")


def still_life(labs):
    """A teapot, a bunny, a ball and a ring by a window (labs 1 to 14)."""
    scene = lit(labs, shape(labs))
    yield f"{len(scene.faces):,} faces, {len(scene.lamps)} lamps, and what is mirrored", None
    found = picture(labs, scene, 960, 540)
    yield "16 samples in a pixel", save("still_life", "still_life", image.to_srgb(found))
