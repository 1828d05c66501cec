"""The picture of a gradient check that failed."""
import io

import numpy as np

from . import places


def draw(part, rtol, name, steps, D, change):
    """Write analytic | numeric | difference | what is off | the worst sweep -> the path."""
    path = places.check_picture(name)
    from matplotlib.figure import Figure  # here, so that a check that passes does not wait for it

    error, worst = part.error(), part.worst()
    figure = Figure(figsize=(16, 3.8))
    figure.suptitle(f"{name}: the gradient with respect to {part.title} is off in "
                    f"{(error > rtol).sum()} of {len(part.probes)} numbers (red below zero, "
                    "blue above, grey not known)")
    figure.subplots_adjust(left=0.03, right=0.99, bottom=0.14, top=0.82, wspace=0.2)
    *axes, curve = figure.subplots(1, 5, width_ratios=[1, 1, 1, 1, 1.3])

    difference, state = part.analytic - part.numeric, np.full(error.shape, np.nan)
    for index in part.probes:
        state[index] = -1 if error[index] > rtol else 1 if np.isnan(error[index]) else 0
    limit, gap = (np.nanmax(np.abs(x)) for x in ([part.analytic, part.numeric], difference))
    show(axes[0], f"analytic (to ±{limit:.3g})", part.analytic, limit)
    show(axes[1], f"numeric (to ±{limit:.3g})", part.numeric, limit)
    show(axes[2], f"difference (to ±{gap:.3g})", difference, gap)
    show(axes[3], "red: off, blue: left out", state, 1)

    least = 1e-16 * np.abs([part.analytic[worst], part.numeric[worst]]).max()
    distance = np.abs(D - part.numeric[worst])
    curve.loglog(steps, np.maximum(distance, least), "o-", label="|D - numeric|")
    curve.loglog(steps[2:], np.maximum(change, least), "s-", label="change of E")
    curve.axhline(np.abs(difference[worst]), color="black", ls="--", label="|analytic - numeric|")
    curve.set(title="step sweep of the worst number", xlabel="h")
    curve.minorticks_off()
    curve.legend()

    png = io.BytesIO()
    figure.savefig(png)
    places.write_whole(path, png.getvalue())
    return path


def show(axis, title, x, limit):
    """x in rows and columns, y up, in colours from -limit to limit."""
    rows = x.reshape(len(x), -1) if x.ndim > 1 else x.reshape(1, -1)
    axis.imshow(rows, "RdBu", vmin=-limit, vmax=limit, origin="lower", aspect="auto",
                interpolation="nearest")
    axis.set(title=title, facecolor="0.8")
    axis.locator_params(integer=True, min_n_ticks=1)
