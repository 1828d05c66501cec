"""Break it, the naive answer: the examples that stand in the docstrings of labs/tape.py."""
import numpy as np


def cases():
    """-> [(name, arguments, expected)]: what the tape must return. Steps are tuples, too."""
    square_and_sum = (None, ("multiply", (0, 0)), ("add", (1, 0)))
    return [
        ("summed_to", (np.array([[1.0, 2.0, 4.0], [8.0, 16.0, 32.0]]), (2, 1)),
         np.array([[7.0], [56.0]])),
        ("multiply_backward", (np.array([1.0, 10.0]), np.array([2.0, 3.0]), 5.0),
         (np.array([5.0, 50.0]), 32.0)),
        ("matmul_backward", (np.array([[10.0]]), np.array([[2.0, 3.0]]), np.array([[5.0], [7.0]])),
         (np.array([[50.0, 70.0]]), np.array([[20.0], [30.0]]))),
        ("take_backward", (np.array([1.0, 2, 4]), np.array([7.0, 8, 9]), np.array([2, 0, 2])),
         np.array([2.0, 0.0, 5.0])),
        ("replay", (square_and_sum, (3.0, None, None)), (3.0, 9.0, 12.0)),
        ("backward", (square_and_sum, (3.0, 9.0, 12.0)), (7.0, 1.0, 1.0)),
        ("rotation", (np.array([2.0, 0, 0, 2]),), np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]))]
