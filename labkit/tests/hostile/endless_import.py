"""A loop without an end while it is imported: the whole lab is lost, once."""
while True:
    pass
