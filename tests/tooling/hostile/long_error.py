"""Sends an error whose text would fill a page of hundreds of megabytes."""


def double(x):
    import gc
    channel = next(found for found in gc.get_objects() if type(found).__name__ == "Channel")
    while True:
        channel.send("raised", "<" * 60_000, "<" * 60_000, (), "<" * 10_000)
