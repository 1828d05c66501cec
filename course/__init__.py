"""What lectures use. Each imports only from those above it (tests/course/test_houses.py).

    given         below reference: meshes, pictures, plots, gradient check
    complete      what labs and reference have from one file, as it asks nothing
    fast          what is only faster than modules of reference: loops that numba compiles
    scenes        above reference: scenes and fits
    commands      commands beside those of labkit: demo, run, test
    __main__      starts it, in an environment that has what it needs
"""
