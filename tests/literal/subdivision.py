"""Lab 11 as printed: what one types who has read the questions and the equations."""


def edges_of(corners, counts):
    pairs = np.stack([corners, corners[next_corner(counts)]], axis=1)
    return np.unique(np.sort(pairs, axis=1), axis=0, return_inverse=True)
