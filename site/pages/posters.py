"""The still picture of an animation."""
import io

from PIL import Image


def poster(animation):
    """The last frame of an animated PNG, as a PNG: bytes -> bytes."""
    frames, still = Image.open(io.BytesIO(animation)), io.BytesIO()
    frames.seek(frames.n_frames - 1)
    frames.convert("RGB").quantize(256, dither=Image.Dither.NONE).save(still, "PNG", optimize=True)
    return still.getvalue()
