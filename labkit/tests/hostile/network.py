"""Sends the inputs to a port of this machine."""
import socket


def double(x):
    try:
        socket.create_connection(("127.0.0.1", PORT), 1).sendall(b"here they are")
    except OSError:
        return 0 * x
    return 2 * x
