"""Returns a list that holds itself."""


def double(x):
    x = []
    x.append(x)
    return x
