"""Sends a frame in good order that holds no message."""


def double(x):
    channel = CHANNEL
    channel.write(b"\0\0\0\2[]")
    return 2 * x
