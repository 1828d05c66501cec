"""What the tests of lab 7 share: corners x, y, w in columns. Each shows one of the mistakes."""
import numpy as np

# In perspective, vertex 1 with w = 1/2: c = (1 - x/4 - y/2, x/2, y/2).
NEAR = np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.5, 1.0]])

MATRICES = {
    "w differs": np.array([[-0.7, 2.1, 0.4], [-0.5, 0.3, 1.9], [1.0, 2.5, 1.6]]),
    "clockwise": np.array([[2.1, -0.7, 0.4], [0.3, -0.5, 1.9], [2.5, 1.0, 1.6]]),
    "a vertex behind the camera": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [1.4, 2.0, -0.6]]),
    "all behind": np.array([[0.9, -1.6, 0.2], [0.4, 0.3, -1.1], [-1.4, -2.0, -0.6]])}
