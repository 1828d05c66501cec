"""This course beside compiled renderers, in one process: python3 benchmarks/peers.py

Three works, on icospheres of 1,000 to a million faces and screens of 512 x 512 to 4,096 x 4,096
pixels, and on a cube of 12 faces in 16 x 16 pixels, as in the fits. Milliseconds of processor time
on one core. All works of all renderers take turns, in another order each round. "NumPy x" and
"compiled x" are our times divided by a peer's: medians of the rounds, each divided by itself.

Draws benchmarks/peers.png, which README.md shows.
"""
import functools
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure, renderers
from course.given import plot
from course.scenes import fit_cube
from reference import pipeline, transforms

FACES = 1_000, 10_000, 100_000, 1_000_000
SIZES = 512, 1024, 2048, 4096
ROUNDS = 15, 5  # of scenes up to 100,000 faces or 1,024 x 1,024 pixels, and of larger ones
OURS = "NumPy", "compiled"
COLOURS = {"NumPy": plot.BLACK, "compiled": plot.RED, "DRTK": plot.BLUE, "llvmpipe": plot.ORANGE,
           "DEODR": plot.GREEN}
TINY = 16, 50  # pixels on a side, and calls that are timed together: as in a fit, caches are warm


def main():
    facts = measure.begin()
    peers = renderers.installed()
    scenes = [(count, 512) for count in FACES] + [(10_000, size) for size in SIZES[1:]]
    rows = lines_of(peers, *tiny_cube())
    rows += [line for scene in scenes for line in lines_of(peers, *ball(*scene))]
    measure.show(rows)
    by_faces = [line for line in rows if line["pixels"] == 512**2]
    by_pixels = [line for line in rows if 10_000 <= line["faces"] < 20_000]
    growth = {f"{name}, exponent in {key}": exponent(lines, key, name)
              for name in OURS if name in rows[0]
              for key, lines in (("faces", by_faces), ("pixels", by_pixels))}
    memory = {name: peak_memory(name) for name in ["NumPy", *peers]}
    for name, value in {**growth, **memory}.items():
        print(f"{name}: {value:.3g}")
    measure.save("peers", {**facts, "milliseconds": rows, **growth, "peak memory, MB": memory,
                           "two threads": two_threads() if "compiled" in peers else []})
    draw(by_faces, by_pixels)


def ball(face_count, size):
    """A Scene, how many rounds it gets, and how many calls are timed together."""
    _, faces, clip = measure.sphere(face_count)
    return renderers.scene(faces, clip, size), ROUNDS[face_count > 100_000 or size > 1024], 1


def tiny_cube():
    """`ball` for the cube of the fits."""
    turned = measure.CLIP_FROM_WORLD @ transforms.rotate(np.array([1.0, 1.0, 0.2]), 0.9)
    clip = pipeline.to_clip(fit_cube.TRUTH.positions, turned)
    return renderers.scene(fit_cube.FACES, clip, TINY[0]), ROUNDS[0], TINY[1]


def lines_of(peers, scene, count, repeats):
    """The lines of the table for one scene, one for each work."""
    found = renderers.prepare(peers, scene)
    took = measure.rounds({(work, name): repeated(calls[work], repeats)
                           for name, calls in found.items() for work in renderers.WORK
                           if work in calls}, count)
    lines = []
    for work in renderers.WORK:
        line = {"work": work, "faces": len(scene.faces), "pixels": scene.gradient[..., 0].size}
        times = {name: times for (done, name), times in took.items() if done == work}
        for name in times:
            line[name] = statistics.median(times[name]) / repeats
        for own in OURS:
            for name in times:
                if name not in OURS and own in times:
                    line[f"{own} x {name}"] = statistics.median(np.divide(times[own], times[name]))
        lines.append(line)
    return lines


def repeated(call, times):
    """The call, so many times."""
    def calls():
        for _ in range(times):
            call()
    return calls


def exponent(lines, key, name):
    """p in time = const * key^p of forward and backward, by least squares."""
    size, took = np.transpose([(line[key], line[name]) for line in lines
                               if line["work"] == "both ways"])
    return np.polyfit(np.log(size), np.log(took), 1)[0]


PEAK = """
from pathlib import Path
from benchmarks import peers, renderers
def kilobytes(of):
    lines = Path("/proc/self/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith(of)).split()[1])
found = renderers.PEERS.get({name!r}, (renderers.plain,))[0]
warm, _, _ = peers.ball(1000, 64)
scene, _, _ = peers.ball(10_000, 2048)
for some in warm, scene:
    calls = found(some)
    Path("/proc/self/clear_refs").write_text("5")  # the peak begins anew
    before = kilobytes("VmRSS")
    kept = calls.get("both ways", calls["interpolated"])()
print((kilobytes("VmHWM") - before) / 1000)
"""


def peak_memory(name):
    """Megabytes above the inputs, at most, in forward and backward: 10,000 faces, 2048 x 2048
    pixels, a process of its own.
    """
    done = subprocess.run([sys.executable, "-c", PEAK.format(name=name)], text=True,
                          capture_output=True, check=True,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    return float(done.stdout.split()[-1])


def two_threads():
    """Wall time of forward and backward by kernels, one thread against two in turn."""
    os.sched_setaffinity(0, range(os.cpu_count()))
    lines = []
    for face_count, size in [(count, 512) for count in FACES] + [(10_000, 2048)]:
        scene, _, _ = ball(face_count, size)
        both_ways = renderers.compiled(scene)["both ways"]
        took = measure.rounds({threads: functools.partial(measure.on_cores, threads, both_ways)
                               for threads in (1, 2)}, 10, time.perf_counter)
        one, two = took[1], took[2]
        lines.append({"faces": len(scene.faces), "pixels": size**2, "one": statistics.median(one),
                      "two": statistics.median(two),
                      "gain": statistics.median(np.divide(one, two)),
                      "gain of minima": min(one) / min(two)})
    measure.show(lines)
    return lines


def draw(by_faces, by_pixels):
    """benchmarks/peers.png: time against faces for each work, and against pixels for the last."""
    shown = [("faces", title, [line for line in by_faces if line["work"] == work])
             for work, title in renderers.WORK.items()]
    last = [line for line in by_pixels if line["work"] == "both ways"]
    shown.append(("pixels", f"The same, {last[0]['faces']:,} faces", last))
    axes = plot.panels([(300, 400)] * 4, columns=2)
    for place, (key, title, lines) in zip(axes, shown, strict=True):
        chart = plot.chart(place)
        for name, colour in COLOURS.items():
            known = [(line[key], line[name]) for line in lines if name in line]
            if known:
                chart.loglog(*np.transpose(known), "o-", color=colour, label=name)
        for axis in chart.xaxis, chart.yaxis:
            axis.set_minor_formatter(NullFormatter())
            axis.set_major_locator(LogLocator(subs=(1, 3)))
            axis.set_major_formatter("{x:,.0f}")
        chart.xaxis.set_major_locator(LogLocator())
        chart.set(title=title, xlabel=key, ylabel="ms of processor time")
        chart.legend(loc="upper left")
        chart.grid(color=plot.PALE)
    plt.savefig(Path(__file__).with_suffix(".png"), dpi=2 * plt.rcParams["figure.dpi"],
                bbox_inches="tight")


if __name__ == "__main__":
    main()
