"""Wrong answers to multi_view_fit, written without a look at the checks."""


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the normals' gradient does not go back to the vertices: vertex_normals_backward is missing

    told by: vertex_normals_backward | normals & missing | through the normals | normals & vertices | shading & vertices | by way of the normals
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    grad_albedo, _, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    return loss, grad_vertices, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the albedo is rendered as it is, without the light: shade is left out on the way there

    told by: shade | shading | without the light | albedo & rendered | unlit | not lit
    """
    normals = mesh.vertex_normals(vertices, faces)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, albedo, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, albedo, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """grad_albedo is the gradient of the colours: the light's factor of shade_backward is missing

    told by: grad_colours | colours & albedo | shade_backward & albedo | through shade | light & albedo
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    _, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_colours, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the weight of the coverage is not passed on to the backward pass, where it is 1

    told by: weight | coverage | fourth channel
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(1.0, pictures, targets, 1.0)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level


def there_and_back(vertices, faces, albedo, light, views, targets, weight):
    """the loss itself, and not 1, is handed to the backward pass as its own gradient

    told by: 1.0 | loss itself | times the loss | grad_loss | seed | multiplied by the loss | proportional to the loss
    """
    normals = mesh.vertex_normals(vertices, faces)
    colours = reconstruction.shade(albedo, normals, light)
    shape = pipeline.make_mesh(vertices, faces)
    pictures, buffers = see(shape, colours, views)
    loss = reconstruction.picture_loss(pictures, targets, weight)
    grad_pictures = reconstruction.picture_loss_backward(loss, pictures, targets, weight)
    grad_vertices, grad_colours, grad_level = see_backward(grad_pictures, buffers, shape, colours, views)
    grad_albedo, grad_normals, grad_light = reconstruction.shade_backward(grad_colours, albedo, normals, light)
    by_normals = reconstruction.vertex_normals_backward(grad_normals, vertices, faces)
    return loss, grad_vertices + by_normals, grad_albedo, grad_light, grad_level
