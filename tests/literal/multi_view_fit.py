"""Lab 16's step as printed: one line for each arrow, there and back."""


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad_pictures, buffers, shape,
                                                                    colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo,
                                                                          normals, light)
    grad_vertices += reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level
