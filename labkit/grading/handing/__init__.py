"""In and out: what students get, and what they hand in.

    contents     the texts of labs, and their hash
    archives     which file is a lab, in folders and archives. Nothing is unpacked
    platforms    whose it is, by the names that platforms give
    submissions  what was handed in, of each student
    texts        the same as a folder of code, for later runs and for other programs
    pack         for students: the zip that they hand in
    handout      what students get: labs, checks, lectures, and no solutions
"""
