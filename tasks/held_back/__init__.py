"""What the grader has besides, and a hand-out has not.

    break_it    kinds of faults, beside those that one may look at
"""
