"""Made up: the small course's second lab."""
import numpy as np

from . import transforms


def eight(x):  # exercise 2.1 (3 points)
    """8 x."""
    return np.array([transforms.quadruple(part) for part in transforms.parts(2 * x)])
