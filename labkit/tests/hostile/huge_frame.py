"""Announces more bytes than there are in the world."""


def double(x):
    channel = CHANNEL
    channel.stream.write((1 << 62).to_bytes(8, "big"))
    channel.stream.flush()
    return 2 * x
