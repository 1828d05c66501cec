"""Children take memory while their parent asks the reference, which answers each time at once."""
import time


def double(x):
    return x


def quadruple(x):
    channel = CHANNEL
    for _ in range(6):
        if os.fork() == 0:
            kept = [np.ones(1 << 20) for _ in range(150)]
            time.sleep(1000)
    while True:
        channel.send("ask", "transforms", "double", (1.0,), {})
        channel.receive()
