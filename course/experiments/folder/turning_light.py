"""Does the light turn with the camera, as before a turntable? The search takes it for fixed."""
import numpy as np

LEAST = 0.1  # a light that stays gives 0.04 at most, where things shine; a lamp that turns 0.4
SENTENCE = ("points are brighter on one side of the pictures, so the light turns with the camera, "
            "as before a turntable; the search takes it for fixed: expect wrong albedo, and take "
            "pictures with a camera that goes around instead, or in even light")


def remarks(labs, surface, targets):
    """The SENTENCE, in a list, if the light turns."""
    return [SENTENCE] if turning(labs, surface, targets) > LEAST else []


def turning(labs, surface, targets):
    """How much brighter than in other Targets points are where they face one side of the picture.

    Colours are those of eq. (10) times 1 + b . n, in the least squares, where n are normals in the
    camera's axes. -> the length of b.
    """
    lab = labs.intrinsic_decomposition
    colours, _ = lab.seen_colours(surface, targets)
    square, product = np.zeros((3, 3)), np.zeros(3)
    for target in targets:
        weights, seen = lab.pixel_weights(surface, target)
        usual = (weights @ colours).mean(1)
        axes = target.view.clip_from_model[[0, 1, 3], :3]
        axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
        shift = usual[:, None] * (weights @ surface.normals @ axes.T)
        square += shift.T @ shift
        product += shift.T @ (seen.mean(1) - usual)
    return np.linalg.norm(np.linalg.lstsq(square, product, rcond=None)[0])
