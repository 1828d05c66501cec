"""Prints 10 GB, and is right otherwise."""


def double(x):
    line = "x" * 100_000_000
    for _ in range(50):
        print(line)
        os.write(1, line.encode())
        os.write(2, line.encode())
    return 2 * x
