"""Wrong answers to multi_view_fit, written without a look at the checks."""


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """albedo is drawn instead of the shaded colours: render_views gets the albedo

    told by: shade | unlit | without light | albedo & drawn | albedo & rendered | albedo & render_views | light & left out
    """
    normals = mesh.vertex_normals(vertices, faces)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, seen = render_views(shape, albedo, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad, seen, shape, albedo, views)
    grad_albedo, grad_n, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals,
                                                                    light)
    grad_vertices = grad_vertices + reconstruction.vertex_normals_backward(grad_n, vertices, faces)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level
