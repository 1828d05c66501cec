"""Runs a submission apart from the checks, and from everything else.

    worker       in the sandbox: the process that runs it, alone with NumPy and SciPy
    confine      in the sandbox: what that gives up before it loads what was handed in
    finders      in the sandbox: what may be imported
    wire         on both sides: values as bytes, and back with nothing believed
    probe        in the sandbox: tries what must not work
    seccomp      the system calls that a worker may make
    levels       how it is started at each level: its command, its settings
    processes    what the system tells of processes
    labs         what a worker is sent of the course's labs
    sandbox      starts a worker, keeps its limits from outside, ends it, knows this machine
    answers      the reference's, to a worker that asks; what all of it may take
    examination  the course's checks, with workers in the place of the labs
    jobs         what is examined, and what comes of it
    open_task    an open task's trials, each a call in a worker
    typed_json   these as JSON, between our own processes
    examine      one submission, in a process of its own
    running      many of these processes

What is in the sandbox is not trusted: no mark depends on its honesty. The rest is trusted.
"""
