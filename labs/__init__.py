"""Your copy of the code: every exercise is yours to write. Start with transforms."""
