"""Waits, and says nothing."""
import time


def double(x):
    time.sleep(3600)
