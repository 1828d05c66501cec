"""Mistakes of lab 16's step; each docstring goes on after "this is what comes out when"."""


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """nothing comes back through the normals: shading then says nothing of the shape"""
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours,
                                                           views)
    grad_albedo, _, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """nothing comes back from the pictures to the vertices: only shading moves them"""
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    _, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo,
                                                                          normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, by_normals, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """pictures and targets are swapped on the way back: every step goes uphill"""
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, targets, pictures, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours,
                                                           views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo,
                                                                          normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level
