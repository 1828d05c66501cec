"""Announces more bytes than there are in the world."""


def double(x):
    import gc
    channel = next(found for found in gc.get_objects() if type(found).__name__ == "Channel")
    channel.stream.write((1 << 62).to_bytes(8, "big"))
    channel.stream.flush()
    return 2 * x
