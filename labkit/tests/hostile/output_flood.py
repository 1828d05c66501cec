"""Prints 10 GB, and is right otherwise."""


def double(x):
    line = "x" * 100_000_000
    content = line.encode()
    for _ in range(17):
        print(line)
        os.write(1, content)
        os.write(2, content)
    return 2 * x
