"""Open tasks: a page, a scorer and a naive answer each. Their right answers stand nowhere.

    break_it     cases that a right tape passes, and a faulty one does not
    honest_edge  the gradient of an edge, against exact coverage
    one_picture  how a known thing stands, and what lights it, by one photograph
    held_back    what the grader has besides, and a hand-out has not
    naive        what one begins with, and what a score is compared with
"""
