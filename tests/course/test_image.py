"""Pictures to files and back, sRGB; the folder for output."""
import re

import numpy as np
import pytest
from PIL import Image, ImageSequence

from course.given import image
from labkit import places

RAMP = np.arange(12).reshape(3, 4) / 11  # row 0, the bottom, is the darkest


def noise(*shape):
    """8-bit numbers, so that a file holds them exactly."""
    return np.random.default_rng(7).integers(0, 256, shape) / 255


# Files


def test_row_0_is_written_at_the_bottom(tmp_path):
    """A picture upside down, or turned over twice. Pillow's rows begin at the top."""
    picture = noise(3, 4, 3)
    image.write(tmp_path / "a.png", picture)
    with Image.open(tmp_path / "a.png") as raw:
        np.testing.assert_array_equal(np.asarray(raw)[::-1], np.round(255 * picture))


@pytest.mark.parametrize(("shape", "mode"), [
    ((5, 7, 3), "RGB"), ((5, 7, 4), "RGBA"), ((5, 7), "L"), ((5, 7, 1), "L")])
def test_a_picture_comes_back_grey_as_three_equal_channels(shape, mode, tmp_path):
    """Channels exchanged, alpha multiplied in or dropped, numbers off by a rounding. A grey file
    that needs another branch in everything that reads textures.
    """
    picture = noise(*shape)
    image.write(tmp_path / "a.png", picture)
    with Image.open(tmp_path / "a.png") as raw:
        assert raw.mode == mode
    expected = np.repeat(picture.reshape(5, 7, -1), 3 if mode == "L" else 1, axis=2)
    np.testing.assert_array_equal(image.read(tmp_path / "a.png"), expected)


@pytest.mark.parametrize(("numbers", "written"), [
    ([-3.0, 0.25 / 255, 0.75 / 255, 0.999, 1.001, 9], [0, 0, 1, 255, 255, 255]),
    ([True, False], [255, 0]), (np.array([1, 0], np.uint8), [255, 0])])
def test_numbers_are_clipped_and_rounded(numbers, written, tmp_path):
    """256 wraps around to black, 0.999 is cut to 254; a mask is written as 1 of 255: black, too."""
    image.write(tmp_path / "a.png", np.array([numbers]))
    with Image.open(tmp_path / "a.png") as raw:
        assert np.asarray(raw).tolist() == [written]


@pytest.mark.parametrize(("mode", "expected"), [
    ("1", [1, 1, 1]), ("L", [1, 1, 1]), ("P", [1, 0, 0]), ("RGB", [1, 0, 0]),
    ("LA", [1, 1, 1, 1]), ("RGBA", [1, 0, 0, 1])])
def test_every_8_bit_kind_of_png_is_read(mode, expected, tmp_path):
    """Palette indices taken for grey, one bit taken for 1 of 255."""
    colour = (255, 255, 255) if mode in ("1", "L", "LA") else (255, 0, 0)
    Image.new("RGB", (2, 2), colour).convert(mode).save(tmp_path / "a.png")
    assert image.read(tmp_path / "a.png")[0, 0].tolist() == expected


def test_a_palette_with_a_transparent_colour_has_alpha(tmp_path):
    """A sticker with a black frame."""
    picture = Image.new("P", (2, 1))
    picture.putpalette([255, 0, 0, 0, 255, 0])
    picture.putpixel((1, 0), 1)
    picture.save(tmp_path / "a.png", transparency=0)
    assert image.read(tmp_path / "a.png").tolist() == [[[1, 0, 0, 0], [0, 1, 0, 1]]]


def test_the_same_picture_gives_the_same_bytes_and_no_other_file(tmp_path):
    """A date in the file, a neighbour left behind."""
    for name in ("a", "b"):
        image.write(tmp_path / f"{name}.png", noise(5, 7, 3))
        image.write_animation(tmp_path / f"moving-{name}.png", [RAMP, 1 - RAMP], 0.1)
    a, b, moving_a, moving_b = (path.read_bytes() for path in sorted(tmp_path.iterdir()))
    assert a == b and moving_a == moving_b


@pytest.mark.parametrize(("picture", "sentence"), [
    (np.zeros(5), "an image must be (H, W), (H, W, 1), (H, W, 3) or (H, W, 4), got (5,)"),
    *((np.zeros(shape), f"got {shape}") for shape in ((4, 4, 2), (3, 4, 4, 3), (0, 4))),
    (np.full((2, 2), 255, np.uint8), "numbers from 0 to 1, got uint8 from 255 to 255"),
    (np.full((2, 2), -1), "numbers from 0 to 1, got int64 from -1 to -1"),
    (np.full((2, 2), 1j), "an image holds numbers from 0 to 1 or booleans, got complex128"),
    (np.where(np.arange(4) == 2, np.nan, np.zeros((3, 4))), "holds nan at row 0, column 2"),
    (np.where(np.eye(2)[:, :, None] == [0, 1, 2], np.inf, 0), "at row 0, column 0")])
def test_what_is_no_picture_is_refused_and_the_old_file_stays(picture, sentence, tmp_path):
    """Grey soup from bytes taken for 0 to 1, NaN written as some grey, half a file."""
    path = tmp_path / "a.png"
    image.write(path, RAMP)
    before = path.read_bytes()
    for attempt in (lambda: image.write(path, picture),
                    lambda: image.write_animation(path, [RAMP, picture], 0.1)):
        with pytest.raises(ValueError, match=re.escape(sentence)) as error:
            attempt()
        assert "\n" not in str(error.value)
    assert path.read_bytes() == before and len(list(tmp_path.iterdir())) == 1


def test_a_file_that_cannot_be_opened_gets_one_sentence(tmp_path):
    """A bare FileNotFoundError, or Pillow's complaint about a stream."""
    with pytest.raises(FileNotFoundError, match=r"^there is no file .*no\.png: check its name"):
        image.read(tmp_path / "no.png")
    with pytest.raises(OSError, match=r"^cannot write .*a\.png .*: name a file in a folder that"):
        image.write(tmp_path / "nowhere" / "a.png", RAMP)
    for name in ("a.jpg", "a", "png"):
        with pytest.raises(ValueError, match=rf"^pictures are written as \.png, got '{name}'$"):
            image.write(name, RAMP)
        with pytest.raises(ValueError, match=rf"^pictures are written as \.png, got '{name}'$"):
            image.write_animation(name, [RAMP], 0.1)


def test_a_broken_file_gets_one_sentence_with_its_name(tmp_path):
    """A traceback, or the upper half of a picture over black."""
    image.write(tmp_path / "whole.png", noise(40, 40, 3))
    whole = (tmp_path / "whole.png").read_bytes()
    for content in (b"", bytes(range(256)), *(whole[:k] for k in range(1, len(whole) - 20, 97))):
        (tmp_path / "a.png").write_bytes(content)
        with pytest.raises(ValueError, match=r"^cannot read .*a\.png as a picture: ") as error:
            image.read(tmp_path / "a.png")
        assert "\n" not in str(error.value)


def test_a_picture_with_16_bits_is_refused(tmp_path):
    """Pillow clips 16 bits to 8: everything white."""
    Image.fromarray(np.full((2, 2), 40_000, np.uint16)).save(tmp_path / "a.png")
    with pytest.raises(ValueError, match=r"more than 8 bits a channel \(I.*, save it again with 8"):
        image.read(tmp_path / "a.png")


def test_a_picture_of_too_many_pixels_is_not_called_broken(tmp_path, monkeypatch):
    """Who has a camera of 200 million pixels saves a whole picture again, and again it is broken.
    """
    image.write(tmp_path / "a.png", noise(3, 7, 3))
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 10)
    for read in image.read, image.size:
        with pytest.raises(ValueError, match="has more than 20 pixels: make it smaller"):
            read(tmp_path / "a.png")


# Animation


def test_an_animation_holds_every_frame_its_time_and_runs_for_ever(tmp_path):
    """Frames lost or upside down, one run only, seconds taken for milliseconds."""
    frames = [np.roll(noise(6, 5, 3), k, axis=0) for k in range(4)]
    image.write_animation(tmp_path / "a.png", frames, 0.25)
    with Image.open(tmp_path / "a.png") as raw:
        assert raw.info["loop"] == 0
        for shown, frame in zip(ImageSequence.Iterator(raw), frames, strict=True):
            assert shown.info["duration"] == 250
            np.testing.assert_array_equal(shown.convert("RGB"), np.round(255 * frame[::-1]))
    np.testing.assert_array_equal(image.read(tmp_path / "a.png"), frames[0])


def test_a_frame_that_stays_is_shown_longer(tmp_path):
    """A pause that is lost because equal frames are stored once."""
    image.write_animation(tmp_path / "a.png", [RAMP, RAMP, RAMP, 1 - RAMP], 0.1)
    with Image.open(tmp_path / "a.png") as raw:
        assert sum(frame.info["duration"] for frame in ImageSequence.Iterator(raw)) == 400


@pytest.mark.parametrize(("frames", "seconds", "sentence"), [
    ([], 0.1, "an animation needs at least one frame, got none"),
    ([RAMP, RAMP[:2]], 0.1, "all frames must have one shape, got [(2, 4), (3, 4)]"),
    ([RAMP, np.zeros((3, 4, 3))], 0.1, "all frames must have one shape"),
    *(([RAMP], seconds, f"seconds_per_frame must be 0.001 to 60, got {seconds}")
      for seconds in (0, 100, np.nan))])
def test_what_is_no_animation_is_refused(frames, seconds, sentence, tmp_path):
    """A file that no viewer plays, milliseconds given for seconds."""
    with pytest.raises(ValueError, match="^" + re.escape(sentence)):
        image.write_animation(tmp_path / "a.png", frames, seconds)
    assert not list(tmp_path.iterdir())


# sRGB


def test_srgb_is_the_curve_of_the_standard():
    """A power of 2.2 for the curve, or the two directions exchanged."""
    # IEC 61966-2-1: 12.92 L up to 0.0031308, else 1.055 L^(1/2.4) - 0.055.
    linear = np.array([0, 0.001, 0.0031308, 0.18, 0.5, 1])
    encoded = [0, 0.01292, 0.040449936, 0.4613561295, 0.7353569831, 1]
    np.testing.assert_allclose(image.to_srgb(linear), encoded, rtol=0, atol=5e-8)
    np.testing.assert_allclose(image.to_linear([0, 0.04045, 0.5, 1]),
                               [0, 0.04045 / 12.92, 0.2140411405, 1], rtol=0, atol=5e-9)


def test_srgb_and_linear_are_inverse_everywhere():
    """A step where the curve's two pieces meet, as with the standard's rounded constants."""
    near = image.SRGB_JOIN + np.linspace(-1e-6, 1e-6, 2001)
    linear = np.concatenate([np.linspace(0, 4, 4001), near])
    encoded = image.to_srgb(linear)
    np.testing.assert_allclose(image.to_linear(encoded), linear, rtol=0, atol=1e-14)
    np.testing.assert_allclose(image.to_srgb(image.to_linear(linear)), linear, rtol=0, atol=1e-14)
    assert (np.diff(image.to_srgb(near)) > 0).all()


def test_srgb_keeps_shapes_and_negative_numbers():
    """NaN from a root of a negative number, a warning from the branch that is not taken."""
    with np.errstate(all="raise"):
        assert image.to_srgb(-0.5) == -6.46 and image.to_linear(-6.46) == -0.5
    assert image.to_srgb(np.zeros((2, 3, 4))).shape == (2, 3, 4)


# The folder for output


def test_out_makes_the_folder_and_not_the_file(tmp_path, monkeypatch):
    """A file name made into a folder."""
    monkeypatch.setattr(places, "ROOT", tmp_path)
    path = places.out("demo", "bunny", "depth.png")
    assert path == tmp_path / "out" / "demo" / "bunny" / "depth.png"
    assert path.parent.is_dir() and not path.exists()


def test_a_folder_that_cannot_be_made_or_written_gets_one_sentence(tmp_path, monkeypatch):
    """A traceback in a course folder that is not the reader's own, or is there, but read-only."""
    monkeypatch.setattr(places, "ROOT", tmp_path)
    (tmp_path / "out").write_text("a file in the way")
    with pytest.raises(OSError, match=r"^cannot write into the folder .*demo: allow writing there"):
        places.out("demo", "depth.png")
    (tmp_path / "out").unlink()
    monkeypatch.setattr(places.os, "access", lambda folder, mode: False)
    with pytest.raises(OSError, match=r"^cannot write into the folder .*out: allow writing there"):
        places.out("depth.png")


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    """A full disk: half a file under the right name."""
    path = tmp_path / "a.bin"
    places.write_whole(path, b"old")

    def full(source, target):
        raise OSError(28, "No space left on device")
    monkeypatch.setattr(places.os, "replace", full)
    with pytest.raises(OSError, match=r"^cannot write .*a\.bin \(No space left on device\): "):
        places.write_whole(path, b"new")
    assert path.read_bytes() == b"old" and len(list(tmp_path.iterdir())) == 1
