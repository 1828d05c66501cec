"""Sends half of an answer, then nothing."""


def double(x):
    channel = CHANNEL
    channel.stream.write((1000).to_bytes(8, "big") + b"half")
    channel.stream.flush()
    while True:
        pass
