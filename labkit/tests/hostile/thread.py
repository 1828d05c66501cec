"""Leaves threads running."""
import threading


def spin():
    while True:
        pass


def double(x):
    for daemon in (True, False):
        threading.Thread(target=spin, daemon=daemon).start()
    return 2 * x
