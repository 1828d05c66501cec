"""A teapot as a mirror: where its pixels look, what stands around it, and pictures of it.

For lecture 06b. It uses labs 1, 2, 5 and 6.
"""
import numpy as np

from ..given import mesh
from .viewing import clip_from_world

SUN = np.array([0.12, 0.62, 0.60])  # towards it
PANELS = (  # east and height of the middle, width and height in radians, colour
    (0.9, 0.35, 0.5, 0.5, (0.93, 0.30, 0.22)), (2.1, 0.30, 0.6, 0.4, (0.98, 0.78, 0.20)),
    (3.4, 0.40, 0.5, 0.6, (0.25, 0.62, 0.38)), (4.6, 0.30, 0.6, 0.4, (0.72, 0.30, 0.62)),
    (5.8, 0.45, 0.3, 0.7, (0.99, 0.98, 0.95)))


# --- directions ----------------------------------------------------------------------------------


def teapot():
    """The Utah teapot in the unit sphere, its patches sewn together -> vertices, faces."""
    vertices, faces = mesh.teapot()
    vertices, faces = mesh.merge(mesh.normalize(vertices).round(6), faces)
    return vertices, faces[(faces != np.roll(faces, 1, 1)).all(1)]


def view(labs, camera, eye, size):
    """Where each pixel looks: at the teapot in the mirrored direction, and straight on beside it.

    -> seen (size, size), directions (size, size, 3), and their change (size, size, 3, 2).
    """
    vertices, faces = teapot()
    attributes = np.concatenate([vertices - eye, mesh.vertex_normals(vertices, faces)], 1)
    clip = labs.transforms.transform(labs.transforms.to_homogeneous(vertices), camera)
    face_index, _ = labs.rasterization.rasterize(clip, faces, size, size)
    weights = labs.interpolation.barycentrics(face_index, clip, faces)
    changes = labs.interpolation.barycentrics_derivatives(face_index, clip, faces)
    seen = face_index >= 0
    at = labs.interpolation.interpolate(attributes, faces, face_index, weights)[seen]
    rate = labs.interpolation.interpolate_derivatives(attributes, faces, face_index, changes)[seen]
    directions, change = rays(labs, camera, eye, size)
    directions[seen], change[seen] = reflected(at[:, :3], rate[:, :3], at[:, 3:], rate[:, 3:])
    return seen, directions, change


def reflected(d, d_change, normal, normal_change):
    """r = d - 2 (d . n) n with n = normal / |normal|, and its change by the product rule.

    d, normal (N, 3), their change (N, 3, 2) -> r (N, 3), its change (N, 3, 2).
    """
    length = np.linalg.norm(normal, axis=1)[:, None]
    n = normal / length
    along = np.einsum("ni,nik->nk", n, normal_change)
    n_change = (normal_change - n[:, :, None] * along[:, None]) / length[..., None]
    towards = (d * n).sum(1)[:, None]
    towards_change = (np.einsum("nik,ni->nk", d_change, n) + np.einsum("ni,nik->nk", d, n_change))
    change = d_change - 2 * (n[:, :, None] * towards_change[:, None]
                             + towards[..., None] * n_change)
    return d - 2 * towards * n, change


def rays(labs, camera, eye, size):
    """The direction of each pixel from the eye (size, size, 3), and its change (..., 3, 2)."""
    world_from_clip = np.linalg.inv(camera)
    world_from_clip = world_from_clip[:3] - eye[:, None] * world_from_clip[3]
    ndc_from_screen = np.diag([2 / size, 2 / size, 1, 1])
    ndc_from_screen[:2, 3] = -1
    from_screen = world_from_clip @ ndc_from_screen  # linear in x and y: its columns are the change
    y, x = np.indices((size, size)) + 0.5
    places = np.stack([x, y, np.full(x.shape, 1.0), np.ones(x.shape)], -1)
    return places @ from_screen.T, np.tile(from_screen[:, :2], (size, size, 1, 1))


# --- the surroundings ----------------------------------------------------------------------------


def environment(labs, size):
    """A cube map (6, size, size, 3): a sky with a sun, coloured panels, and a floor of checkers."""
    fine = painted(labs.cube_maps.texel_directions(2 * size))
    return fine.reshape(6, size, 2, size, 2, 3).mean((2, 4))


def painted(directions):
    """The colours (..., 3) of the surroundings in directions (..., 3) of any length."""
    d = mesh.unit(directions)
    up = d[..., 1:2]
    haze = np.exp(-4.5 * np.abs(up))
    sky = (1 - haze) * np.array([0.17, 0.38, 0.74]) + haze * np.array([0.93, 0.90, 0.86])
    facing = d @ (SUN / np.linalg.norm(SUN))
    glow = np.exp(-14 * (1 - facing)) * 0.5 + np.clip(400 * (facing - 0.992), 0, 1)
    sky = sky + glow[..., None] * np.array([1.0, 0.9, 0.7])
    for east, height, width, tall, colour in PANELS:
        inside = within(d, east, height, width, tall)
        sky = np.where(inside[..., None], colour, sky)
    floor = d[..., [0, 2]] / np.maximum(-up, 1e-9)
    dark = (np.floor(1.1 * floor).sum(-1) % 2 == 0)[..., None]
    stone = np.where(dark, [0.20, 0.22, 0.27], [0.86, 0.82, 0.75])
    ground = (1 - haze) * stone + haze * np.array([0.70, 0.66, 0.62])
    return np.clip(np.where(up > 0, sky, ground), 0, 1)


def within(d, east, height, width, tall):
    """Is the unit vector d (..., 3) on a panel that stands so far east and so high (radians)?"""
    longitude = np.arctan2(d[..., 0], d[..., 2])
    aside = (longitude - east + np.pi) % (2 * np.pi) - np.pi
    return (np.abs(aside) < width / 2) & (np.abs(np.arcsin(d[..., 1]) - height) < tall / 2)


# --- pictures of the teapot ----------------------------------------------------------------------


def views(labs, size, count=12):
    """Where the pixels of cameras around the teapot look: a list of what `view` returns.

    The cameras are 3 away, from a little below to far above it.
    """
    return [view(labs, clip_from_world(labs, eye, fov_y=40), eye, size) for eye in eyes(count)]


def eyes(count):
    """Places (count, 3) around the teapot on a spiral that climbs."""
    turn = np.arange(count) * np.pi * (np.sqrt(5) - 1)
    height = np.sin(np.pi * (0.5 * (np.arange(count) + 0.5) / count - 0.08))
    aside = np.sqrt(1 - height**2)
    return 3 * np.stack([aside * np.sin(turn), height, aside * np.cos(turn)], -1)


def reflections(labs, surroundings, size, count=12, samples=3):
    """What the cameras of `views` see of the surroundings in the teapot: pictures (size, size, 3).

    A pixel is a mean of samples x samples. Where one of them looks past the teapot, it is NaN.
    """
    found = []
    for seen, *look in views(labs, samples * size, count):
        look[0][~seen] = 0
        colour = labs.cube_maps.cube_texture(surroundings, *look,
                                             filter_mode="linear-mipmap-linear")
        colour[~seen] = np.nan
        found.append(colour.reshape(size, samples, size, samples, 3).mean((1, 3)))
    return found


def known(looks, pictures):
    """Of the pixels that are not NaN: a list of directions (N, 3), their change, colours (N, 3)."""
    whole = [np.isfinite(picture[..., 0]) for picture in pictures]
    return [(directions[there], change[there], picture[there]) for (_, directions, change),
            picture, there in zip(looks, pictures, whole, strict=True)]


def weights(labs, given, texels):
    """How many pixels of what `known` gives show a texel: each pixel's weights, added up for each
    texel (6, texels, texels).
    """
    total = np.zeros((6, texels, texels, 1))
    for *look, colour in given:
        total += labs.cube_maps.cube_texture_backward(colour[:, :1]**0, total, *look,
                                                      filter_mode="linear-mipmap-linear")[0]
    return total[..., 0]
