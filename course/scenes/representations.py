"""One shape as signed distance, as volume and as mesh (lab 15): a hand wheel with five holes."""
import numpy as np

from .drawing import BACKGROUND, BRASS, LIGHT, enlarged, save
from .viewing import clip_from_world

WHEEL = ("intersection",
         ("smooth union", 0.1, ("torus", 0.72, 0.14),
          ("smooth union", 0.1,
           ("union", ("box", np.array([0.72, 0.06, 0.06])), ("box", np.array([0.06, 0.06, 0.72]))),
           ("intersection", ("sphere", 0.34), ("box", np.array([0.3, 0.16, 0.3]))))),
         ("complement", ("box", np.array([0.11, 1.0, 0.11]))))


def representations(labs):
    """A hand wheel as signed distance, as volume and as mesh (lab 15)."""
    lab15 = labs.shape_rendering
    view = labs.pipeline.View(wheel_camera(labs), 144, 144, BACKGROUND)
    scene = WHEEL, view, lab15.Lighting(LIGHT, BRASS)
    picture, evaluations = lab15.render_distance(*scene)
    yield (f"distance: {evaluations.mean():.0f} steps a ray",
           save("representations", "distance", enlarged(picture, 2)))
    for beta in 0.1, 0.03, 0.01:
        picture = lab15.render_volume(*scene, 1.7, 3.9, beta, count=96)
        yield (f"volume, beta {beta}",
               save("representations", f"volume_{beta}", enlarged(picture, 2)))
    for n in 16, 32, 64:
        picture = lab15.render_mesh(*scene, n=n)
        yield f"mesh, {n}^3 cells", save("representations", f"mesh_{n}", enlarged(picture, 2))


def wheel_camera(labs):
    """clip_from_world that sees the hand wheel from above."""
    return clip_from_world(labs, [1.0, 2.2, 1.4], fov_y=40)
