"""Mistakes of lab 9; each docstring goes on after "this is what comes out when"."""


def quaternion_product(p, q):
    """w is taken for the last of the four numbers, (x, y, z, w), in the result, too; it is the
    first"""
    px, py, pz, pw = np.moveaxis(p, -1, 0)
    qx, qy, qz, qw = np.moveaxis(q, -1, 0)
    return np.stack([pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx,
                     pw * qw - px * qx - py * qy - pz * qz], -1)


def quaternion_product(p, q):
    """the cross product of the two vectors is missing"""
    w = p[..., :1] * q[..., :1] - (p[..., 1:] * q[..., 1:]).sum(-1, keepdims=True)
    return np.concatenate([w, p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:]], -1)


def rotation_angle(p, q):
    """an arccos loses the digits of small angles"""
    return 2 * np.arccos(np.minimum(np.abs((p * q).sum(-1)), 1))


def rotation_angle(p, q):
    """it is in degrees; angles are in radians"""
    return 2 * np.degrees(np.arccos(np.minimum(np.abs((p * q).sum(-1)), 1)))


def silhouette_loss(coverage, target):
    """it is the overlap itself, intersection over union; the loss is 1 minus that"""
    return (coverage * target).sum() / (coverage + target - coverage * target).sum()


def silhouette_loss(coverage, target):
    """it is the Dice loss: twice the overlap by the sum of both"""
    return 1 - 2 * (coverage * target).sum() / (coverage + target).sum()


def silhouette_loss(coverage, target):
    """it is the mean of the pixels' own ratios, not the ratio of the sums"""
    union = coverage + target - coverage * target
    return 1 - np.where(union > 0, coverage * target / np.where(union > 0, union, 1), 1).mean()


def silhouette_loss(coverage, target):
    """the minimum and the maximum of c and t are summed, not c t and c + t - c t"""
    return 1 - np.minimum(coverage, target).sum() / np.maximum(coverage, target).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union is taken for a constant"""
    return grad_loss * -target / (coverage + target - coverage * target).sum()


def uniform_laplacian(positions, edges):
    """the differences to the neighbours are summed, not divided by their number, the valence"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    return scatter(positions[vertex] - positions[neighbour], vertex, len(positions))


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """it is the forward once more, divided by the receiver's valence; its matrix must be
    transposed
    """
    return uniform_laplacian(grad_laplacian, edges)
