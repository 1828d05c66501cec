"""COLMAP's cameras.bin and images.bin as the lines of text for which they stand.

Source: colmap.github.io/format.html.
"""
import io
import struct

MODELS = {  # how many numbers a camera has, in the order of the models' own numbers
    "SIMPLE_PINHOLE": 3, "PINHOLE": 4, "SIMPLE_RADIAL": 4, "RADIAL": 5, "OPENCV": 8,
    "OPENCV_FISHEYE": 8, "FULL_OPENCV": 12, "FOV": 5, "SIMPLE_RADIAL_FISHEYE": 4,
    "RADIAL_FISHEYE": 5, "THIN_PRISM_FISHEYE": 12, "RAD_TAN_THIN_PRISM_FISHEYE": 16,
    "SIMPLE_DIVISION": 4, "DIVISION": 5, "SIMPLE_FISHEYE": 3, "FISHEYE": 4, "EUCM": 6,
    "EQUIRECTANGULAR": 2}


def lines(name, content):
    """The lines of cameras.txt or images.txt, without points, from the bytes of the .bin of this
    name. ValueError for other bytes.
    """
    try:
        return list((cameras if name == "cameras.bin" else images)(io.BytesIO(content)))
    except (struct.error, IndexError, ValueError, OverflowError):
        raise ValueError(f"{name} is cut short, or is not as COLMAP writes it") from None


def cameras(file):
    """Yield CAMERA_ID MODEL WIDTH HEIGHT PARAMS."""
    for _ in range(*taken(file, "Q")):
        camera, model, *size = taken(file, "IiQQ")
        name, count = [*MODELS.items()][model]
        yield in_a_line(camera, name, *size, *taken(file, f"{count}d"))


def images(file):
    """Yield IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, and a line of no points, in turn."""
    for _ in range(*taken(file, "Q")):
        placed = taken(file, "I7dI")
        end = file.getvalue().index(0, file.tell())
        yield in_a_line(*placed, file.read(end - file.tell()).decode())
        points, = taken(file, "xQ")
        file.seek(24 * points, io.SEEK_CUR)
        yield ""


def taken(file, layout):
    """The next numbers of a file in the layout of `struct`."""
    return struct.unpack(f"<{layout}", file.read(struct.calcsize(f"<{layout}")))


def in_a_line(*words):
    return " ".join(map(str, words))
