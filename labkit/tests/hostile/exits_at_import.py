"""Ends the process in good order while it is imported."""
sys.exit(0)
