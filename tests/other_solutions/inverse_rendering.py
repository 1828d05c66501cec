"""Lab 9 once more: element by element."""
import math

import numpy as np


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    beta_1, beta_2, epsilon = constants
    # With the two corrections moved into the rate and epsilon, as the paper's section 2 has it.
    mean = mean + (1 - beta_1) * (grad_x - mean)
    square = square + (1 - beta_2) * (grad_x * grad_x - square)
    root = math.sqrt(1 - beta_2**step)
    rate = rate * root / (1 - beta_1**step)
    return x - rate * mean / (np.sqrt(square) + epsilon * root), mean, square


def silhouette_loss(coverage, target):
    shared = np.vdot(coverage, target)
    either = np.sum(coverage) + np.sum(target) - shared
    if not either:
        return 0, 0 * coverage
    iou = shared / either
    return (either - shared) / either, ((1 - target) * iou - target) / either
