"""Open tasks: a page, a scorer and a naive answer each. Their right answers stand nowhere.

    honest_edge  the gradient of an edge, against exact coverage
    naive        what one begins with, and what a score is compared with
"""
