"""The plots of the benchmarks' page: each shows one thing, and its title says what was found.

A plot is made of a result alone. Its numbers, and those in its title, come from there.
"""
import io
import textwrap
from typing import NamedTuple

import matplotlib as mpl
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter

from benchmarks.measure import text as number
from course.given import plot

WIDTH, HEIGHT = 480, 400  # in pixels: a phone shrinks it to three quarters
COLOURS = plot.BLACK, plot.RED, plot.BLUE, plot.ORANGE, plot.GREEN
MARKS = "osD^v"


def chosen(rows, **wanted):
    """The rows that have these values; of two with the same faces and pixels the first."""
    found = {}
    for row in rows:
        if all(row[key] == value for key, value in wanted.items()):
            found.setdefault((row.get("faces"), row.get("pixels")), row)
    return list(found.values())


def row_at(rows, faces):
    """The first row with this number of faces, or a little more."""
    return min((row for row in rows if row["faces"] >= faces),
               key=lambda row: (row["faces"], row["pixels"]))


class Lines(NamedTuple):
    """Curves of time against x, both axes logarithmic.

    rows: result -> rows. names: the columns that are drawn. finding: rows -> the title.
    """

    rows: callable
    x: str
    names: tuple
    finding: callable
    y: str = "ms of processor time"

    def words(self, result):
        """The text for those who do not see the plot."""
        rows = self.rows(result)
        ends = "; ".join(f"{name} {number(at[0][name])} to {number(at[-1][name])}"
                         for name in self.names if (at := [row for row in rows if name in row]))
        return (f"{self.finding(rows)}. Curves of {self.y} for {number(rows[0][self.x])} to "
                f"{number(rows[-1][self.x])} {self.x}: {ends}.")

    def draw(self, result):
        """-> the plot as SVG, its width, its height."""
        rows = self.rows(result)
        figure, axes = empty(self.finding(rows))
        for name, colour, mark in zip(self.names, COLOURS, MARKS, strict=False):
            known = [(row[self.x], row[name]) for row in rows if name in row]
            if known:
                axes.loglog(*zip(*known, strict=True), f"{mark}-", color=colour, label=name)
        for axis in axes.xaxis, axes.yaxis:
            axis.set_minor_formatter(NullFormatter())
            axis.set_major_formatter("{x:,.9g}")
        axes.set_xticks([row[self.x] for row in rows])
        low, high = axes.get_ylim()
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 1000 * low else (1,)))
        axes.set(xlabel=self.x, ylabel=self.y)
        axes.legend(loc="lower left", bbox_to_anchor=(-0.1, 1), ncols=2, columnspacing=1)
        return drawing(figure)


class Bars(NamedTuple):
    """A bar for each row. rows: result -> {name: value}. finding: that -> the title."""

    rows: callable
    finding: callable
    y: str = "ms of processor time"

    def words(self, result):
        """The text for those who do not see the plot."""
        values = self.rows(result)
        told = "; ".join(f"{name} {number(value)}" for name, value in values.items())
        return f"{self.finding(values)}. Bars of {self.y}: {told}."

    def draw(self, result):
        """-> the plot as SVG, its width, its height."""
        values = self.rows(result)
        figure, axes = empty(self.finding(values))
        bars = axes.barh(list(values), list(values.values()), color=plot.BLUE, height=0.65)
        axes.bar_label(bars, [number(value) for value in values.values()], padding=3)
        axes.invert_yaxis()
        axes.grid(axis="y", visible=False)
        axes.margins(x=0.2)
        figure.supxlabel(self.y, fontsize=12.5)
        return drawing(figure)


def empty(title):
    """A figure with this title -> figure, axes."""
    plot.style()
    mpl.rcParams.update({"font.size": 12.5, "axes.titlesize": 13.5, "svg.hashsalt": "benchmarks"})
    figure, axes = plt.subplots(figsize=(WIDTH / 100, HEIGHT / 100))
    figure.suptitle(textwrap.fill(title, 48), x=0.02, ha="left", fontsize=13.5)
    axes.grid(color=plot.PALE, linewidth=0.5)
    return figure, axes


def drawing(figure):
    content = io.BytesIO()
    figure.savefig(content, format="svg", metadata={"Date": None})
    plt.close(figure)
    return content.getvalue(), WIDTH, HEIGHT


def ratio(value, other):
    """How many times the other, as text."""
    return f"{value / other:.3g}"


def times(rows, name, other, at=-1):
    """name / other in a row, as text."""
    return ratio(rows[at][name], rows[at][other])


def growth(rows, name):
    """How many times the first row's value the last one is, as text."""
    return ratio(rows[-1][name], rows[0][name])


def peers(work, title, x="faces", **wanted):
    """A plot of benchmarks/peers.py."""
    return Lines(lambda found: chosen(found["milliseconds"], work=work, **wanted), x,
                 ("NumPy", "compiled", "DRTK", "llvmpipe", "DEODR"),
                 lambda rows: f"{title}: {against(rows, x)}")


def against(rows, x):
    """How our time with kernels compares with the others', in the last row."""
    last, ours = rows[-1], "compiled x "
    told = ", ".join(f"{value:.3g} times {name.removeprefix(ours)}'s"
                     for name, value in last.items() if name.startswith(ours))
    return f"at {number(last[x])} {x} compiled takes {told}"


def medians(**wanted):
    return lambda found: chosen(found["medians in ms"], **wanted)


def named(key):
    return lambda found: {row[""]: row["ms"] for row in found[key]}


SMALL = 512 * 512

PLOTS = {
    "peers": peers("both ways", "Forward and backward", pixels=SMALL),
    "peers-visible": peers("visible", "Face index and depth", pixels=SMALL),
    "peers-interpolated": peers("interpolated", "With attributes", pixels=SMALL),
    "peers-pixels": peers("both ways", "Forward and backward", "pixels", faces=10_580),
    "pipeline": Lines(
        lambda found: found["medians in ms"]["faces"], "faces", ("render", "d render"),
        lambda rows: f"At {number(rows[-1]['faces'])} faces the way back takes "
                     f"{times(rows, 'd render', 'render')} times the picture"),
    "antialiasing": Lines(
        medians(pixels=SMALL), "faces", ("topology", "forward", "backward"),
        lambda rows: f"antialias_backward takes {number(rows[-1]['backward'])} ms at "
                     f"{number(rows[-1]['faces'])} faces"),
    "rasterization": Lines(
        medians(pixels=SMALL), "faces", ("rasterize", "boxes"),
        lambda rows: f"Bounding boxes take {times(rows, 'boxes', 'rasterize', 0)} times as long as "
                     f"whole rows at {number(rows[0]['faces'])} faces, "
                     f"{times(rows, 'boxes', 'rasterize')} times at {number(rows[-1]['faces'])}"),
    "vertex_gradients": Lines(
        medians(), "faces", ("rasterize", "d barycentrics", "d depth"),
        lambda rows: f"{growth(rows, 'faces')} times the faces: the way back takes "
                     f"{growth(rows, 'd barycentrics')} times as long"),
    "interpolation": Lines(
        medians(), "faces", ("forward", "backward", "add.at"),
        lambda rows: f"One sparse matrix: np.add.at takes {times(rows, 'add.at', 'backward')} "
                     f"times as long at {number(rows[-1]['faces'])} faces"),
    "texturing": Bars(
        lambda found: {f"{row['filter']}{', back' * back}": row["backward" if back else "forward"]
                       for row in found["medians in ms"] for back in (False, True)},
        lambda bars: f"The way back of a trilinear look-up takes "
                     f"{ratio(bars['linear-mipmap-linear, back'], bars['linear-mipmap-linear'])} "
                     "times the way there"),
    "msaa": Bars(
        named("medians"),
        lambda bars: f"4x MSAA takes {ratio(bars['4x MSAA'], bars['1 sample'])} times one "
                     "sample, 2 x 2 supersampling "
                     f"{ratio(bars['2 x 2 supersampling'], bars['1 sample'])} times"),
    "neural_renderer": Bars(
        named("medians"),
        lambda bars: f"A teapot with cubes of texels takes {number(bars['teapot, 1 x 1 samples'])} "
                     f"ms, its gradients {number(bars['its gradients, 1 x 1'])}"),
    "subdivision": Lines(
        lambda found: [row for row in found["medians in ms"] if row["scheme"] == "Loop"],
        "faces", ("step", "S @ x", "S.T @ g", "trimesh"),
        lambda rows: f"Loop: making S takes {times(rows, 'S alone', 'S @ x')} times as long as "
                     f"using it, at {number(rows[-1]['faces'])} faces"),
    "simplification": Lines(
        lambda found: found["times"][1:], "faces", ("seconds",),
        lambda rows: f"{growth(rows, 'faces')} times the faces take {growth(rows, 'seconds')} "
                     "times as long", "seconds of processor time"),
    "shadow_mapping": Lines(
        lambda found: found["times"], "map", ("hard shadow", "PCSS, 32 places", "variance",
                                              "its backward"),
        lambda rows: f"Soft shadows (PCSS) take {times(rows, 'PCSS, 32 places', 'hard shadow')} "
                     f"times as long as hard ones, with a map of {rows[-1]['map']:,} x "
                     f"{rows[-1]['map']:,}"),
    "implicit_surfaces": Lines(
        lambda found: found["a torus by marching tetrahedra"], "faces", ("grid", "forward",
                                                                       "backward"),
        lambda rows: f"Marching through {rows[-1]['cells']} cells takes "
                     f"{number(rows[-1]['forward'])} ms, and back {number(rows[-1]['backward'])}"),
    "fits": Bars(
        lambda found: {name: fit["ms"] / fit["steps"] for name, fit in found.items()
                       if isinstance(fit, dict)},
        lambda bars: f"A step of a fit takes {number(min(bars.values()))} to "
                     f"{number(max(bars.values()))} ms", "ms of processor time for a step"),
}
