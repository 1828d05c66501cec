"""Wrong answers to multi_view_fit, written without a look at the checks."""


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """the way back through the normals is missing: vertices get only what comes from their places in the pictures

    told by: normals & grad_vertices | through the normals | vertex_normals_backward | by the normals | normals & missing | normals & forgot | normals & depend
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    body = pipeline.make_mesh(vertices, faces)
    seen, kept = render_views(body, colours, views)
    loss = reconstruction.picture_loss(seen, targets, weight)
    back = reconstruction.picture_loss_backward(1.0, seen, targets, weight)
    to_vertices, to_colours, to_level = render_views_backward(back, kept, body, colours, views)
    to_albedo, _, to_light = reconstruction.shade_backward(to_colours, albedo, normals, light)
    return loss, to_vertices, to_albedo, to_light, to_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """render_views_backward is given the albedo, not the shaded colours that were seen

    told by: render_views_backward & albedo | render_views_backward & colours | albedo & instead of & colours | albedo, not & colours | shaded colours | unshaded | same colours
    """
    normals = mesh.vertex_normals(vertices, faces)
    body = pipeline.make_mesh(vertices, faces)
    seen, kept = render_views(body, reconstruction.shade(albedo, normals, light), views)
    loss = reconstruction.picture_loss(seen, targets, weight)
    back = reconstruction.picture_loss_backward(1.0, seen, targets, weight)
    to_vertices, to_colours, to_level = render_views_backward(back, kept, body, albedo, views)
    to_albedo, to_normals, to_light = reconstruction.shade_backward(to_colours, albedo, normals,
                                                                    light)
    to_vertices = to_vertices + reconstruction.vertex_normals_backward(to_normals, vertices, faces)
    return loss, to_vertices, to_albedo, to_light, to_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """the losses of the K views are summed, not averaged

    told by: K times | sum & views | mean & views | average & views | number of views | divided by K | number of pictures
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    body = pipeline.make_mesh(vertices, faces)
    seen, kept = render_views(body, colours, views)
    loss, back = 0.0, np.zeros_like(seen)
    for k in range(len(views)):
        loss += reconstruction.picture_loss(seen[k], targets[k], weight)
        back[k] = reconstruction.picture_loss_backward(1.0, seen[k], targets[k], weight)
    to_vertices, to_colours, to_level = render_views_backward(back, kept, body, colours, views)
    to_albedo, to_normals, to_light = reconstruction.shade_backward(to_colours, albedo, normals,
                                                                    light)
    to_vertices = to_vertices + reconstruction.vertex_normals_backward(to_normals, vertices, faces)
    return loss, to_vertices, to_albedo, to_light, to_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """the way back through the normals is left out: grad_vertices comes from the pictures alone

    told by: through the normals | normals & vertices | by_normals | vertex_normals_backward | grad_n & vertices | shading & vertices
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = render_views_backward(grad, buffers, shape, colours, views)
    grad_albedo, _, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """albedo is drawn instead of the shaded colours: render_views gets the albedo

    told by: shade | unlit | without light | albedo & drawn | albedo & rendered | albedo & see | light & left out
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


def views_loss_and_gradients(vertices, faces, albedo, light, views, targets, weight):
    """each view's gradient comes from a loss of its own, the sum of K means instead of one mean over all views

    told by: number of views | k times | mean & views | sum & views | all views | each view | per view | len(views)
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = render_views(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grads = np.array([reconstruction.picture_loss_backward(1.0, p, t, weight)
                      for p, t in zip(pictures, targets)])
    grad_vertices, grad_colours, grad_level = render_views_backward(grads, buffers, shape, colours, views)
    grad_albedo, grad_n, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals,
                                                                    light)
    grad_vertices = grad_vertices + reconstruction.vertex_normals_backward(grad_n, vertices, faces)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level
