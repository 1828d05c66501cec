"""Lab 16 as printed: what one types who has read the questions and the equations."""


def shade(albedo, normals, light):
    irradiance = 0
    for k in range(9):
        irradiance = irradiance + sh_basis(normals)[:, k, None] * light[k]
    return albedo * irradiance


def shade_backward(grad_colour, albedo, normals, light):
    basis = sh_basis(normals)
    grad_light = basis.T @ (grad_colour * albedo)
    grad_basis = (grad_colour * albedo) @ light.T
    return grad_colour * (basis @ light), sh_basis_backward(grad_basis, normals), grad_light


def vertex_normals_backward(grad_normals, vertices, faces):
    a, b, c = vertices[faces[:, 0]], vertices[faces[:, 1]], vertices[faces[:, 2]]
    m = np.zeros(vertices.shape)
    for k in range(3):
        np.add.at(m, faces[:, k], np.cross(b - a, c - a))
    length = np.linalg.norm(m, axis=1)[:, None]
    n = m / length
    grad_m = (grad_normals - n * (n * grad_normals).sum(1)[:, None]) / length
    g = grad_m[faces[:, 0]] + grad_m[faces[:, 1]] + grad_m[faces[:, 2]]
    grad_vertices = np.zeros(vertices.shape)
    np.add.at(grad_vertices, faces[:, 0], np.cross(b - c, g))
    np.add.at(grad_vertices, faces[:, 1], np.cross(c - a, g))
    np.add.at(grad_vertices, faces[:, 2], np.cross(a - b, g))
    return grad_vertices


def picture_loss_backward(grad_loss, picture, target, weight):
    grad_picture = 2 * grad_loss * (picture - target)
    grad_picture[..., :3] /= picture[..., :3].size
    grad_picture[..., 3] *= weight / picture[..., 3].size
    return grad_picture


def sign_changes(distance, edges):
    total = 0.0
    for a, b in edges:
        s_a, s_b = distance[a], distance[b]
        if s_a < 0 <= s_b or s_b < 0 <= s_a:
            total += np.log(1 + np.exp(-s_a * np.sign(s_b)))
            total += np.log(1 + np.exp(-s_b * np.sign(s_a)))
    return total
