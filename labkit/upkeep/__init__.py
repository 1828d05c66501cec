"""What keeps the course in step with itself. Nothing stands on it but the command line.

    skeleton   makes labs/ from reference/
    extras     opens extras in labs/, and closes them
    errata     the page of what the lectures correct in their sources
    pictures   the pictures of a lecture: packed, described
    outcomes   do two runs of a lecture's cell say the same?
    weight     how much code stands around the code that is taught
    notebooks  which lectures are older than their code; runs them, and writes them back
    hours      how long a lab takes
    changes    a wrong function, written as what is different from the right one
    mutations  the small changes that a machine can make
    trials     wrong functions in the place of the right one, judged by the checks
    mutants    small mistakes made by machine: do the checks catch them?
    mistakes   mistakes that are likely: are they caught, and what hints do they give?
"""
