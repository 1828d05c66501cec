"""Imports what must not be there."""
from reference import transforms
