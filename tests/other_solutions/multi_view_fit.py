"""The step of lab 16 once more: view by view, and the mean of what each one says."""
import numpy as np

from course.given import mesh
from reference import multi_view_fit, pipeline, reconstruction
from reference.multi_view_fit import Target  # noqa: F401, for the checks


def one_view(shape, colours, view, target, weight):
    (picture,), buffers = multi_view_fit.render_views(shape, colours, [view])
    loss, grad_picture = reconstruction.picture_loss(picture, target, weight)
    return loss, *multi_view_fit.render_views_backward([grad_picture], buffers, shape, colours,
                                                       [view])


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    normals, shape = mesh.vertex_normals(vertices, faces), pipeline.make_mesh(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    found = [one_view(shape, colours, view, target, weight)
             for view, target in zip(views, targets, strict=True)]
    loss, by_place, by_colour, level = (np.mean(part, 0) for part in zip(*found, strict=True))
    paint, turned, lamps = reconstruction.shade_backward(by_colour, albedo, normals, light)
    by_normals = reconstruction.vertex_normals_backward(turned, vertices, faces)
    return float(loss), by_place + by_normals, paint, lamps, level
