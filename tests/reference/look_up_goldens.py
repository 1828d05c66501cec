"""Look-ups as nvdiffrast's kernels make them (tests/golden/README.md), beside ours; and scenes."""
import numpy as np

TOLERANCE = {"colour": 3e-6, "grad_image": 6e-6, "grad_faces": 6e-6, "grad_uv": 1.5e-4,
             "grad_directions": 1.5e-4, "grad_jacobian": 1e-4, "grad_bias": 4e-6}


def configs(golden):
    """Its scenes, each with what was given: filter, arguments and largest level."""
    return sorted({tuple(key.split("/")[:2]) for key in golden if key.count("/") == 2})


def require_look_ups(look_up, backward, names, golden, scene, config, **given):
    """The colours and gradients of a scene are nvdiffrast's.

    names: those of the first two arguments, a texture and the places in it.
    """
    filter_mode, more, max_level = config.split("|")
    keys = [*names, *(more.split("+") if more else [])]
    given |= {key.removesuffix("_alone"): golden[f"{scene}/{key}"].astype(float) for key in keys}
    given |= {"filter_mode": filter_mode, "max_level": int(max_level) if max_level else None}
    gradients = backward(golden[f"{scene}/grad_colour"].astype(float), **given)
    got = {f"grad_{name}": gradient
           for name, gradient in zip((*names, "jacobian", "bias"), gradients, strict=True)}
    got["colour"] = look_up(**given)
    prefix = f"{scene}/{config}/"
    for key in (key for key in golden if key.startswith(prefix)):
        name = key.removeprefix(prefix)
        atol = 0 if name == "colour" and filter_mode == "nearest" else TOLERANCE[name]
        np.testing.assert_allclose(got[name], golden[key], rtol=0, atol=atol, err_msg=name)


def picture_scene(rng):
    """image, uv, jacobian and bias, with levels from below 0 to above the pyramid's end."""
    jacobian = rng.normal(size=(4, 5, 2, 2)) * rng.uniform(0.02, 0.8, (4, 5, 1, 1))
    return (rng.random((8, 16, 3)), rng.uniform(-0.6, 1.6, (4, 5, 2)), jacobian,
            rng.normal(size=(4, 5)) / 2)


def cube_scene(rng, size=8):
    """The same with faces and directions."""
    directions = rng.normal(size=(4, 5, 3))
    stretch = np.abs(directions).max(-1)[..., None, None] * rng.uniform(0.05, 1.5, (4, 5, 1, 1))
    return (rng.random((6, size, size, 3)), directions, stretch * rng.normal(size=(4, 5, 3, 2)),
            rng.normal(size=(4, 5)) / 2)
