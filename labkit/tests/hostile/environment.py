"""Tells what the environment says."""


def double(x):
    raise ValueError(str(dict(os.environ)))
