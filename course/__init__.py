"""The rooms of the course. Each imports only from those above it (tests/tooling/test_rooms.py).

    given         below reference: meshes, images, plots, gradient check
    experiments   above reference: scenes and fits
    exercises     what exercises there are
    checks        assertions, hints, the report: the pytest plugin
    verdicts      what became of an exercise: done, failing, blocked by 2.1
    board         a screen: what is done, and what to do next
    upkeep        what makes labs, hints and notebooks
    grading       hand out, grade, report
    cli           the command line
    __main__      starts it, in an environment that has what it needs
"""
