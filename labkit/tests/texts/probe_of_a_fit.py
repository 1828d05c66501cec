"""Run in a hand-out whose core is written: three steps of the first fit."""
from course.given.whose import Labs
from course.scenes import fit_bunny

labs = Labs()
path, _ = fit_bunny.fit(labs, 0.02, steps=3, size=32)
list(fit_bunny.seen_anew(labs, path))
print(labs.package, len(path) - 1)
