"""The rooms of the course. Each imports only from those above it (tests/tooling/test_rooms.py).

    given         below reference: meshes, pictures, plots, gradient check
    complete      what labs and reference have from one file, as it asks nothing
    fast          what is only faster than modules of reference: loops that numba compiles
    scenes        above reference: scenes and fits
    exercises     what exercises there are
    imports       what labs import, and what is handed in with them
    lab_text      their answers, taken out of a module and put back
    checks        assertions, hints, the report: the pytest plugin
    verdicts      what became of an exercise: done, failing, blocked by 2.1
    board         a screen: what is done, and what to do next
    upkeep        what makes labs, hints and notebooks
    grading       hand out, grade, report
    commands      what each command takes, and what it starts
    cli           the command line: its help, its errors
    __main__      starts it, in an environment that has what it needs
"""
