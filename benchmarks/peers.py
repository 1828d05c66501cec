"""This course beside compiled renderers, in one process: python3 benchmarks/peers.py

Three works, on icospheres of 1,000 to a million faces and screens of 512 x 512 to 4,096 x 4,096
pixels. Milliseconds of processor time on one core. All renderers take turns, in another order each
round. "x" is our time divided by the peer's: the median of the rounds, each divided by itself.

Writes benchmarks/results/peers.json and benchmarks/peers.png, which README.md shows.
"""
import json
import statistics
import sys
import tracemalloc
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure, renderers
from course.given import places, plot

FACES = 1_000, 10_000, 100_000, 1_000_000
SIZES = 512, 1024, 2048, 4096
ROUNDS = 15, 5  # of scenes up to 100,000 faces or 1,024 x 1,024 pixels, and of larger ones
COLOURS = {"ours": plot.BLACK, "DRTK": plot.BLUE, "llvmpipe": plot.ORANGE, "DEODR": plot.GREEN}


def main():
    facts = measure.begin()
    peers = renderers.installed()
    scenes = [(count, 512) for count in FACES] + [(10_000, size) for size in SIZES[1:]]
    rows = [line for scene in scenes for line in lines_of(peers, *scene)]
    measure.show(rows)
    by_faces = [line for line in rows if line["pixels"] == 512**2]
    by_pixels = [line for line in rows if 10_000 <= line["faces"] < 20_000]
    growth = {"exponent in faces": exponent(by_faces, "faces"),
              "exponent in pixels": exponent(by_pixels, "pixels"),
              "peak memory, MB": peak_memory()}
    for name, value in growth.items():
        print(f"forward and backward, {name}: {value:.3g}")
    content = json.dumps({**facts, "milliseconds": rows, **growth}, indent=1)
    places.write_whole(Path(__file__).parent / "results" / "peers.json", content.encode())
    draw(by_faces, by_pixels)


def lines_of(peers, face_count, size):
    """The lines of the table for one scene, one for each work."""
    _, faces, clip = measure.sphere(face_count)
    found = renderers.prepare(peers, renderers.scene(faces, clip, size))
    count = ROUNDS[face_count > 100_000 or size > 1024]
    lines = []
    for work in renderers.WORK:
        calls = {name: calls[work] for name, calls in found.items() if work in calls}
        took = measure.rounds(calls, count)
        line = {"work": work, "faces": len(faces), "pixels": size**2}
        for name, times in took.items():
            line[name] = statistics.median(times)
            if name != "ours":
                line[f"x {name}"] = statistics.median(np.divide(took["ours"], times))
        lines.append(line)
    return lines


def exponent(lines, key):
    """p in time = const * key^p of forward and backward, by least squares."""
    size, took = np.transpose([(line[key], line["ours"]) for line in lines
                               if line["work"] == "both ways"])
    return np.polyfit(np.log(size), np.log(took), 1)[0]


def peak_memory():
    """Megabytes in use at most in forward and backward: 10,000 faces, 2048 x 2048 pixels."""
    _, faces, clip = measure.sphere(10_000)
    call = renderers.ours(renderers.scene(faces, clip, 2048))["both ways"]
    tracemalloc.start()
    call()
    return tracemalloc.get_traced_memory()[1] / 1e6


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
    plt.savefig(Path(__file__).with_suffix(".png"), dpi=2 * plt.rcParams["figure.dpi"])


if __name__ == "__main__":
    main()
