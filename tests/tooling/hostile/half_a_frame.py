"""Sends half of an answer, then nothing."""


def double(x):
    import gc
    channel = next(found for found in gc.get_objects() if type(found).__name__ == "Channel")
    channel.stream.write((1000).to_bytes(8, "big") + b"half")
    channel.stream.flush()
    while True:
        pass
