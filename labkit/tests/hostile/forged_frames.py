"""Sends the answers of all calls to come in advance, all zeros."""


def double(x):
    channel = CHANNEL
    for _ in range(10):
        channel.send("returned", np.zeros(3), (), "")
        channel.send("ended", 0)
    return 2 * x
