"""The naive answers. Copy one into labs/, and make it better.

    break_it     the examples of the docstrings
    honest_edge  nothing changes
    one_picture  Adam, from a bunny that stands upright
"""
