from labkit.checks import exercise


@exercise("2.1")
def test_vowels_are_sorted(impl):
    """They stay as they stand in the text."""
    assert impl.vowels("raise unison") == "aeiiou"
