"""What stands in for an animation until it is played: its still picture, its length."""
import io

from PIL import Image


def poster(animation):
    """The first frame of an animated PNG, as a PNG of 256 colours: bytes -> bytes. The course's
    films begin with what they come to.
    """
    frame, still = Image.open(io.BytesIO(animation)), io.BytesIO()
    if frame.mode != "P":
        frame = frame.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    frame.save(still, "PNG", optimize=True)
    return still.getvalue()


def frame_count(animation):
    """How many frames an animated PNG has: bytes -> int."""
    return Image.open(io.BytesIO(animation)).n_frames
