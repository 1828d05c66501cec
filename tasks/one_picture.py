"""One picture: how the bunny stands, where it is, the focal length and the light, by a photograph.

The photograph is `taped.picture` at 4 x 4 samples a pixel, with noise. What is asked for are the 11
numbers of taped.Scene, in its order: turn, a quaternion (4,), move (3,), focal, light (3,).
"""
import numpy as np

from course.given.whose import Labs
from course.scenes import drawing, taped

FUNCTION = "find"
POINTS = 40
SECONDS = 20.0      # of a photograph
ALL_SECONDS = 200.0  # of all
COUNTED = "rasterization", "rasterize"  # a call of it is a render
TRIES_IT = False
PHOTOGRAPHS, SIZE, SAMPLES, NOISE = 20, 64, 4, 0.01
TURN, LIGHT, FOCAL = 5.0, 10.0, 10.0  # degrees, degrees, %: so far off is solved


def trials(seed):
    """[(name, (photograph (SIZE, SIZE, 3), vertices, faces))]: the mesh is always the same."""
    rng, given = np.random.default_rng([seed, 10]), drawing.unit_bunny()
    return [(f"photograph {number}", (photograph(rng, goal), *given))
            for number, goal in enumerate(goals(seed), 1)]


def goals(seed):
    """The Scene of each photograph: any rotation, and light from the camera's side."""
    rng = np.random.default_rng([seed, 9])
    return [taped.Scene(unit(rng.normal(size=4)), rng.uniform(-0.2, 0.2, 3),
                        np.array(rng.uniform(1.4, 2.0)),
                        0.8 * unit(rng.normal(size=3) * [1, 1, 0] + [0, 0, 0.5]))
            for _ in range(PHOTOGRAPHS)]


def photograph(rng, scene):
    large = taped.picture(Labs(), scene, SAMPLES * SIZE)
    return (large.reshape(SIZE, SAMPLES, SIZE, SAMPLES, 3).mean((1, 3))
            + rng.normal(0, NOISE, (SIZE, SIZE, 3)))


def expected(seed):
    """The 11 numbers of each photograph."""
    return [np.hstack(goal).tolist() for goal in goals(seed)]


def claims(found, truths, answers):
    """Whether each photograph is solved -> [(claim, whether it holds, why)]."""
    for (name, _), true, answer in zip(found, truths, answers, strict=True):
        turn, light, focal = off(np.array(true), answer)
        yield (f"{name} is solved", bool(turn < TURN and light < LIGHT and focal < FOCAL),
               f"turn {turn:.1f} and light {light:.1f} degrees off, focal length {focal:.1f} %")


def off(true, answer):
    """How far off are turn and light, in degrees, and the focal length, in percent?"""
    if np.shape(answer) != true.shape or not np.all(np.isfinite(answer)):
        return np.inf, np.inf, np.inf
    turn, light = (unit(answer[part]) @ unit(true[part]) for part in (np.s_[:4], np.s_[8:]))
    return 2 * degrees(abs(turn)), degrees(light), 100 * abs(answer[7] / true[7] - 1)


def unit(vector):
    """Divided by its length. 0 becomes no number, and so is off."""
    return vector / np.linalg.norm(vector)


def degrees(cosine):
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))
