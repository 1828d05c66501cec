"""Lab 6 once more: texels one by one."""
import numpy as np


def texels_at(uv, width, height, boundary):
    sizes = np.array([width * np.ones(len(uv)), height * np.ones(len(uv))]).astype(int)
    first, share = np.divmod(np.transpose(uv) * sizes - 0.5, 1)
    found = []
    for step in np.ndindex(2, 2):  # up, right
        texel = first.astype(int) + np.reshape(step[::-1], (2, 1))
        inside = ((0 <= texel) & (texel < sizes)).all(0) | (boundary != "zero")
        near = np.mod(texel, sizes) if boundary == "wrap" else np.clip(texel, 0, sizes - 1)
        weight = np.abs(1 - np.reshape(step[::-1], (2, 1)) - share).prod(0)
        found.append((near[0] + near[1] * sizes[0], weight * inside, inside))
    return tuple(np.array(part) for part in zip(*found, strict=True))
