"""The instructor's side: hand out, grade what comes back without trusting it, report.

The checks are those of the course. They run here, in a trusted process. What was handed in runs in
a worker, a process in a sandbox that is sent names of functions and arrays and sends arrays.

    wire         values as bytes, and back with nothing believed
    worker       the process in the sandbox, alone with NumPy and SciPy
    sandbox      starts a worker, keeps its limits from outside, ends it, knows this machine
    examine      one submission: the course's checks with a worker in the place of the labs
    submissions  what was handed in: folders, archives, names
    grade        many submissions, and the tables of a class
    report       the pages
    handout, pack, autograder   what students get, what they hand in, what other graders get

README.md beside this file is for the instructor: a term, and what is not protected.
"""
