"""What keeps the course in step with itself. Nothing stands on it but the command line.

    skeleton   makes labs/ from reference/
    extras     opens extras in labs/, and closes them
    errata     the page of what the lectures correct in their sources
    pictures   the pictures of a lecture: packed, described, compared
    questions  the pictures of apps/bridge/README.md
    origins    what a lecture was made from: must it run again?
    notebooks  runs the lectures, and writes them back
    comparing  does a lecture's run give what its file has?
    hours      how long a lab takes
    weight     how much code stands around the code that is taught
    changes    a wrong function, written as what is different from the right one
    mutations  the small changes that a machine can make
    trials     wrong functions in the place of the right one, judged by the checks
    mutants    small mistakes made by machine: do the checks catch them?
    mistakes   mistakes that are likely: are they caught, and what hints do they give?
"""
