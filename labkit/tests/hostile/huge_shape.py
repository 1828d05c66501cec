"""Declares an array of 10^18 numbers, and sends none."""


def double(x):
    channel = CHANNEL
    header = b'{"tuple": ["returned", {"array": ["<f8", [1000000, 1000000, 1000000]]}, {"tuple": []}, ""]}'
    channel.write(len(header).to_bytes(4, "big") + header)
    return 2 * x
