"""Wrong answers to multi_view_fit, written without a look at the checks."""


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the way back through the normals is missing: vertices get only what comes from their places in the pictures

    told by: normals & grad_vertices | through the normals | vertex_normals_backward | by the normals | normals & missing | normals & forgot | normals & depend
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    body = pipeline.make_mesh(vertices, faces)
    seen, kept = see(body, colours, views)
    loss = reconstruction.picture_loss(seen, targets, weight)
    back = reconstruction.picture_loss_backward(1.0, seen, targets, weight)
    to_vertices, to_colours, to_level = see_backward(back, kept, body, colours, views)
    to_albedo, _, to_light = reconstruction.shade_backward(to_colours, albedo, normals, light)
    return loss, to_vertices, to_albedo, to_light, to_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """see_backward is given the albedo, not the shaded colours that were seen

    told by: see_backward & albedo | see_backward & colours | albedo & instead of & colours | albedo, not & colours | shaded colours | unshaded | same colours
    """
    normals = mesh.vertex_normals(vertices, faces)
    body = pipeline.make_mesh(vertices, faces)
    seen, kept = see(body, reconstruction.shade(albedo, normals, light), views)
    loss = reconstruction.picture_loss(seen, targets, weight)
    back = reconstruction.picture_loss_backward(1.0, seen, targets, weight)
    to_vertices, to_colours, to_level = see_backward(back, kept, body, albedo, views)
    to_albedo, to_normals, to_light = reconstruction.shade_backward(to_colours, albedo, normals,
                                                                    light)
    to_vertices = to_vertices + reconstruction.vertex_normals_backward(to_normals, vertices, faces)
    return loss, to_vertices, to_albedo, to_light, to_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the losses of the K views are summed, not averaged

    told by: K times | sum & views | mean & views | average & views | number of views | divided by K | number of pictures
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    body = pipeline.make_mesh(vertices, faces)
    seen, kept = see(body, colours, views)
    loss, back = 0.0, np.zeros_like(seen)
    for k in range(len(views)):
        loss += reconstruction.picture_loss(seen[k], targets[k], weight)
        back[k] = reconstruction.picture_loss_backward(1.0, seen[k], targets[k], weight)
    to_vertices, to_colours, to_level = see_backward(back, kept, body, colours, views)
    to_albedo, to_normals, to_light = reconstruction.shade_backward(to_colours, albedo, normals,
                                                                    light)
    to_vertices = to_vertices + reconstruction.vertex_normals_backward(to_normals, vertices, faces)
    return loss, to_vertices, to_albedo, to_light, to_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the way by the normals overwrites the gradient of the positions in the pictures: the two must be added

    told by: added | sum & two | both ways | overwrit | silhouette | only & normals | positions & missing
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    grad_vertices = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the losses of the views are summed and not averaged: everything but the level is K times too large

    told by: sum & views | k times | mean & views | number of views | averag | divided & views
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = 0.0
    grad_pictures = np.zeros(pictures.shape)
    for k in range(len(views)):
        loss += reconstruction.picture_loss(pictures[k], targets[k], weight)
        grad_pictures[k] = reconstruction.picture_loss_backward(1.0, pictures[k], targets[k], weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """only the first view counts: the others are not rendered

    told by: first view | one view | other views | all views | every view | single view
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    views, targets = views[:1], targets[:1]
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """carving's gradient is added to the gradient of the vertices, though grad_level is only handed on

    told by: carving | level & vertices | grad_level & added | grad_level
    """
    n = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, n, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    g = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(g, buffers, shape, colours, views)
    grad_albedo, grad_n, grad_light = reconstruction.shade_backward(grad_colours, albedo, n, light)
    grad_vertices = grad_vertices + reconstruction.vertex_normals_backward(grad_n, vertices, faces)
    grad_vertices = grad_vertices + grad_level[:, None] * n
    return loss, grad_vertices, grad_albedo, grad_light, grad_level
