"""Runs a submission apart from the checks, which are trusted, and from everything else.

Seen in the sandbox, beside what was handed in. No mark depends on what these four do:

    worker       the process in the sandbox, alone with NumPy and SciPy
    confine      what it gives up before it loads what was handed in
    wire         values as bytes, and back with nothing believed. It is used on both sides
    probe        tries from inside what must not work

Trusted, outside of it:

    seccomp      the system calls that a worker may make
    levels       how it is started at each level: its command, its settings
    cgroups      its counted share of the machine
    processes    what the system tells of processes
    sandbox      starts a worker, keeps its limits from outside, ends it, knows this machine
    examination  the course's checks, with workers in the place of the labs: believes no answer
    jobs         what is examined, and what comes of it
    typed_json   these as JSON, between our own processes
    examine      one submission, in a process of its own
    running      many of these processes, here or on a cluster
"""
