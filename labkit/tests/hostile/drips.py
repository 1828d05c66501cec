"""Sends an answer byte by byte, while its children take all the memory there is."""
import time


def double(x):
    channel = CHANNEL
    channel.stream.write((1 << 20).to_bytes(8, "big"))
    kept = []
    for _ in range(8):
        if os.fork() == 0:
            while True:
                kept.append(np.ones(1 << 20))
    while True:
        channel.stream.write(b"0")
        channel.stream.flush()
        time.sleep(0.05)
