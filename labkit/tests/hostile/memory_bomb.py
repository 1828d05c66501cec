"""Takes all memory that it gets."""


def double(x):
    kept = []
    while True:
        kept.append(bytearray(1 << 26))
