"""Sends an error whose text would fill a page of hundreds of megabytes."""


def double(x):
    channel = CHANNEL
    while True:
        channel.send("raised", "<" * 60_000, "<" * 60_000, (), "<" * 10_000)
