"""What writes the pages of the web site from what the course holds, and what extends Sphinx."""
import html
import io

from PIL import Image

from labkit.places import write_whole


def put(path, content):
    """Write a text, or bytes, and the folders that lead there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, content.encode("utf-8") if isinstance(content, str) else content)


def picture(file, words, width, height, more=""):
    """An <img>, which is loaded when the reader comes near. more: further attributes."""
    return (f'<img src="{file}" alt="{html.escape(words)}" width="{width}" height="{height}" '
            f'loading="lazy" decoding="async"{more}>')


def poster(animation):
    """The first frame of an opened animation as a PNG of 256 colours: bytes. The course's films
    begin with what they come to.
    """
    still = io.BytesIO()
    if animation.mode != "P":
        animation = animation.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    animation.save(still, "PNG")
    return still.getvalue()
