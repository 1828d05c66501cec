"""What a step of each fit costs, and where: python3 benchmarks/fits.py

The cube (lab 9), the bunny from silhouettes (lab 9) and the reconstruction of the ring (lab 16).
Milliseconds of processor time, and for each function of the course its own part of a step: with
what it calls in NumPy, without what it calls in the course. The profile slows all calls down, so
the parts are shares of the profiled time. Also in out/benchmarks/fits.json.
"""
import cProfile
import itertools
import pstats
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given.whose import Labs
from course.scenes import fit_bunny, fit_cube, reconstruct

COURSE = Path(__file__).resolve().parent.parent
OURS = tuple(f"{COURSE / package}/" for package in ("reference", "course"))
SHOWN = 12  # functions of a step


def main():
    facts = measure.begin()
    labs = Labs("reference")
    fits = {"cube, 16 x 16": (1000, lambda steps: fit_cube.fit(labs, 16, 0, steps)),
            "bunny, 4 views of 128 x 128": (100, lambda steps: fit_bunny.fit(labs, 0.02, steps)),
            "ring, 4 views of 64 x 64": (60, lambda steps: ring(labs, steps))}
    tables = {}
    for name, (steps, fit) in fits.items():
        fit(2)  # to warm up
        begin = time.process_time()
        fit(steps)
        took = 1000 * (time.process_time() - begin)
        print(f"\n{name}: {took / 1000:.2f} s for {steps} steps, {took / steps:.2f} ms each")
        tables[name] = {"steps": steps, "ms": took, "parts": parts(fit, steps)}
        measure.show(tables[name]["parts"])
    measure.save("fits", facts, tables)


def ring(labs, steps):
    """Steps of the reconstruction's middle stage, and its start."""
    found = reconstruct.fit(labs, "ring", [labs.multi_view_fit.Stage(24, 2, 1, steps, 0.5)])
    return list(itertools.islice(found, steps))


def parts(fit, steps):
    """[{"function", "% of a step"}] of the SHOWN largest, from a profile."""
    profile = cProfile.Profile()
    profile.runcall(fit, steps)
    stats = pstats.Stats(profile).stats
    own = {}
    for function, (_, _, alone, _, callers) in stats.items():
        if function[0].startswith(OURS):
            own[function] = own.get(function, 0) + alone
            continue
        for caller, (*_, within) in callers.items():  # NumPy counts for what calls it in the course
            if caller[0].startswith(OURS):
                own[caller] = own.get(caller, 0) + within
    total = sum(own.values())
    largest = sorted(own.items(), key=lambda item: -item[1])[:SHOWN]
    return [{"function": f"{Path(file).stem}.{name}", "% of a step": 100 * took / total}
            for (file, _, name), took in largest]


if __name__ == "__main__":
    main()
