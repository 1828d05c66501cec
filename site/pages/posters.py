"""The still picture of an animation."""
import io

from PIL import Image


def poster(animation):
    """The first frame of an animated PNG, as a PNG: bytes -> bytes. The course's films begin with
    what they come to.
    """
    frames, still = Image.open(io.BytesIO(animation)), io.BytesIO()
    frames.convert("RGB").quantize(256, dither=Image.Dither.NONE).save(still, "PNG", optimize=True)
    return still.getvalue()
