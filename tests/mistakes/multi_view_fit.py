"""Mistakes of lab 16's step; each docstring goes on after "this is what comes out when"."""


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """nothing comes back through the normals to the vertices, or it is not added:
    vertex_normals_backward is missing, and shading says nothing of the shape
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape,
                                                                    colours, views)
    grad_albedo, _, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """grad_vertices of render_views_backward is left out, or overwritten by what comes through the
    normals: both ways are to be added
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    _, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape, colours,
                                                        views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo,
                                                                          normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, by_normals, grad_albedo, grad_light, grad_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """pictures and targets are swapped in picture_loss_backward: every gradient has the wrong sign
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, targets, pictures, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape,
                                                                    colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo,
                                                                          normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """the albedo is rendered as it is, without the light: shade is left out on the way there"""
    normals = mesh.vertex_normals(vertices, faces)
    colours = albedo
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape,
                                                                    colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo,
                                                                          normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """grad_colours is returned for grad_albedo: it does not go back through shade_backward, and the
    light is missing
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape,
                                                                    colours, views)
    _, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals,
                                                                light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_colours, grad_light, grad_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """the loss itself is handed to picture_loss_backward as grad_loss, which is 1.0: all gradients
    are multiplied by the loss
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(loss, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape,
                                                                    colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo,
                                                                          normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level
