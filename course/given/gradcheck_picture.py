"""The picture of a gradient check that failed."""
import io

import numpy as np

from labkit import places


def draw(part, name, steps, D, change):
    """Write analytic | numeric | difference | what is off | the worst sweep -> the path."""
    path = places.check_picture(name)
    from matplotlib.figure import Figure  # here, so that a check that passes does not wait for it

    figure = Figure(figsize=(16, 3.8))
    figure.suptitle(f"{name}: the gradient with respect to {part.title} is off in "
                    f"{part.off().sum()} of {len(part.probes)} numbers (red below zero, "
                    "blue above, grey not known)")
    figure.subplots_adjust(left=0.03, right=0.99, bottom=0.14, top=0.82, wspace=0.2)
    *axes, curve = figure.subplots(1, 5, width_ratios=[1, 1, 1, 1, 1.3])
    difference = part.analytic - part.numeric
    limit, gap = (np.nanmax(np.abs(x)) for x in ([part.analytic, part.numeric], difference))
    show(axes[0], f"analytic (to ±{limit:.3g})", part.analytic, limit)
    show(axes[1], f"numeric (to ±{limit:.3g})", part.numeric, limit)
    show(axes[2], f"difference (to ±{gap:.3g})", difference, gap)
    show(axes[3], "red: off, blue: left out", states(part), 1)
    show_sweep(curve, part, steps, D, change)
    png = io.BytesIO()
    figure.savefig(png)
    places.write_whole(path, png.getvalue())
    return path


def states(part):
    """Of each number that was looked at: -1 off, 1 left out, 0 right."""
    found = np.full(part.numeric.shape, np.nan)
    off = part.off()
    for index in part.probes:
        found[index] = -1 if off[index] else 1 if np.isnan(part.numeric[index]) else 0
    return found


def show_sweep(curve, part, steps, D, change):
    """How the numeric derivative of the worst number comes nearer, step by step."""
    analytic, numeric = (x[part.worst()] for x in (part.analytic, part.numeric))
    least = 1e-16 * max(abs(analytic), abs(numeric))
    curve.loglog(steps, np.maximum(np.abs(D - numeric), least), "o-", label="|D - numeric|")
    curve.loglog(steps[2:], np.maximum(change, least), "s-", label="change of E")
    curve.axhline(abs(analytic - numeric), color="black", ls="--", label="|analytic - numeric|")
    curve.set(title="step sweep of the worst number", xlabel="h")
    curve.minorticks_off()
    curve.legend()


def show(axis, title, x, limit):
    """x in rows and columns, y up, in colours from -limit to limit."""
    rows = x.reshape(len(x), -1) if x.ndim > 1 else x.reshape(1, -1)
    axis.imshow(rows, "RdBu", vmin=-limit, vmax=limit, origin="lower", aspect="auto",
                interpolation="nearest")
    axis.set(title=title, facecolor="0.8")
    axis.locator_params(integer=True, min_n_ticks=1)
