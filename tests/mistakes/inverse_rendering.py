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


def silhouette_loss(coverage, target):
    """the loss is the mean of the pixels' own ratios, not the ratio of the sums"""
    both, union = coverage * target, coverage + target - coverage * target
    loss = 1 - np.where(union > 0, both / np.where(union > 0, union, 1), 1).mean()
    A, U = both.sum(), union.sum()
    return loss, (A / U * (1 - target) - target) / U
