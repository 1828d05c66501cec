"""Open tasks: a page, a scorer and a naive answer each. Their right answers stand nowhere.

    honest_edge  the gradient of an edge, against exact coverage
    one_picture  how a known thing stands, and what lights it, by one photograph
    naive        what one begins with, and what a score is compared with
"""
