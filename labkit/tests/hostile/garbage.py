"""Writes garbage to every descriptor, and so to the channel."""


def double(x):
    for number in range(64):
        try:
            os.write(number, bytes(range(256)) * 64)
        except OSError:
            pass
    return 2 * x
