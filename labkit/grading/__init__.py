"""The instructor's side: hand out, grade what comes back without trusting it, report.

The checks are those of the course. They run here, in a trusted process. What was handed in runs in
a worker, a process in a sandbox that is sent names of functions and arrays and sends arrays.

    apart        runs a submission, trusts nothing of it, and says what became of each exercise
    handing      hands out, and takes in what students hand in
    gradebook    from results to grades: lateness, points by hand, the platforms' tables
    pages        what instructors and students read
    request      what is asked of `grade`
    results      writes all of these, as they come
    grade        a class: what is asked for, and in which order it is done

README.md beside this file is for the instructor: a term, and what is not protected.
"""
