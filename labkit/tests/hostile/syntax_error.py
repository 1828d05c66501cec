"""Not Python."""
def double(x:
