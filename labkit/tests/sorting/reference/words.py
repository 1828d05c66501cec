"""Words."""
from shelf.letters import VOWELS

from .sorting import merge_sort


def vowels(text):  # exercise 2.1 (3 points)
    """A text -> its vowels, sorted."""
    places = merge_sort([VOWELS.index(letter) for letter in text if letter in VOWELS])
    return "".join(VOWELS[int(k)] for k in places)
