"""Look-ups as nvdiffrast's kernels make them (tests/golden/README.md), beside ours."""
import numpy as np

from course.given import arrays

TOLERANCE = {"colour": 3e-6, "grad_image": 6e-6, "grad_faces": 6e-6, "grad_uv": 1.5e-4,
             "grad_directions": 1.5e-4, "grad_jacobian": 1e-4, "grad_bias": 4e-6}


def configs(golden):
    """Its scenes, each with what was given: filter, arguments and largest level."""
    return sorted({tuple(key.split("/")[:2]) for key in golden if key.count("/") == 2})


def require_look_ups(look_up, backward, names, golden, scene, config, **given):
    """The colours and gradients of a scene are nvdiffrast's.

    names: those of the first two arguments, a texture and the places in it.
    """
    filter, more, max_level = config.split("|")
    keys = [*names, *(more.split("+") if more else [])]
    given |= {key.removesuffix("_alone"): golden[f"{scene}/{key}"].astype(float) for key in keys}
    given |= {"filter": filter, "max_level": int(max_level) if max_level else None}
    gradients = backward(golden[f"{scene}/grad_colour"].astype(float), **given)
    got = {f"grad_{name}": gradient
           for name, gradient in zip((*names, "jacobian", "bias"), gradients, strict=True)}
    got["colour"] = look_up(**given)
    prefix = f"{scene}/{config}/"
    for key in (key for key in golden if key.startswith(prefix)):
        name = key.removeprefix(prefix)
        atol = 0 if name == "colour" and filter == "nearest" else TOLERANCE[name]
        np.testing.assert_allclose(got[name], golden[key], rtol=0, atol=atol, err_msg=name)


def require_chunks_change_nothing(look_up, backward, upstream, given, flat_given, monkeypatch):
    """Neither chunks of 3 rows nor leading shapes: flat_given is given, with one row a pixel."""
    whole = look_up(*given), *backward(upstream, *given)
    monkeypatch.setattr(arrays, "ROWS", 3)
    parts = look_up(*flat_given), *backward(upstream.reshape(-1, 3), *flat_given)
    for one, other in zip(whole, parts, strict=True):
        np.testing.assert_allclose(one, other.reshape(one.shape), rtol=1e-12, atol=1e-15)
