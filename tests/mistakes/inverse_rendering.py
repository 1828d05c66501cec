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
