"""Takes memory in many processes, so that none of them takes too much."""


def double(x):
    for _ in range(6):
        if os.fork() == 0:
            kept = np.ones(1 << 26)
            while kept.size:
                pass
    while True:
        pass
