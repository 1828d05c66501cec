"""Declares an array of 10^18 numbers, and sends none."""


def double(x):
    import gc
    channel = next(found for found in gc.get_objects() if type(found).__name__ == "Channel")
    header = b'{"tuple": ["returned", {"array": ["<f8", [1000000, 1000000, 1000000]]}, {"tuple": []}, ""]}'
    channel.write(len(header).to_bytes(4, "big") + header)
    return 2 * x
