"""The still life: a sample sees of it what is seen of a pixel of its own."""
import numpy as np

from course.given.whose import Labs
from course.scenes import still_life

LABS = Labs("reference")


def test_many_samples_are_a_large_picture_made_small():
    """A sample lies beside its pixel, sees a blurred texture, or has another share of the lamps."""
    scene = still_life.lit(LABS, still_life.shape(LABS), count=16)
    large = still_life.picture(LABS, scene, 4 * 96, 4 * 54, samples=1)
    small = still_life.picture(LABS, scene, 96, 54, samples=16)
    error = small - large.reshape(54, 4, 96, 4, 3).mean((1, 3))
    # 0.017; 0.029 without the samples' finer levels, 0.074 if samples lie half a pixel off
    assert np.sqrt((error**2).mean()) < 0.022 and abs(error.mean()) < 5e-4
