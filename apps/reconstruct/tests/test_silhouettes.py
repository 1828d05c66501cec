"""Pictures on disk, as lab 16's search takes them: small, cut out, on one background."""
import numpy as np
import pytest
import ring_captures as ring

from apps.reconstruct import camera_files, captures, silhouettes
from course.given import image

SIDES = 32, 48


def opaque(folder):
    """Six pictures of the ring in a room of many colours, without alpha."""
    room = np.random.default_rng(0).uniform(size=(*SIDES, 3))
    for k in range(6):
        picture = ring.picture(k)
        image.write(folder / f"{k}.png", np.where(picture[..., 3:] > 0, picture[..., :3], room))


def masks(folder, name="{}.png"):
    """A mask for each picture, white for the object."""
    (folder / "masks").mkdir()
    for k in range(6):
        image.write(folder / "masks" / name.format(k), ring.picture(k)[..., 3])


def coverage(photos):
    return [picture[..., 3] for picture in photos.pictures]


def test_large_pictures_are_made_smaller():
    """Pixels are dropped instead of averaged, or the shape changes."""
    channel = np.random.default_rng(0).uniform(size=(300, 512))
    found = silhouettes.smaller(channel, 128)
    assert found.shape == (75, 128)
    np.testing.assert_allclose(found.mean(), channel.mean(), atol=1e-3)
    np.testing.assert_allclose(silhouettes.smaller(np.array([[0.0, 1, 2, 6]]), 2), [[0.5, 4]])


def test_colours_are_averaged_as_light_before_the_background(tmp_path):
    """Encoded numbers are averaged, or what lies under alpha 0 shows through.

    A white pixel and a black one beside two clear ones, which are red below: half of the picture is
    object of light 1/2, before white that is 3/4.
    """
    pixels = np.array([[1, 1, 1, 1], [0, 0, 0, 1], [1, 0, 0, 0], [1, 0, 0, 0.0]])
    image.write(tmp_path / "a.png", pixels.reshape(2, 2, 4))
    shot = camera_files.Shot("a.png", tmp_path / "a.png", 2, 2, 2.0, 2.0, 1.0, 1.0, np.eye(4))
    np.testing.assert_allclose(silhouettes.cut(tmp_path, shot, 1), [[[0.75, 0.75, 0.75, 0.5]]],
                               atol=1e-6)


@pytest.mark.parametrize("name", ["{}.png", "{}.png.png"])
def test_masks_lie_beside_pictures_of_any_background(folder, name):
    """A mask is not found, or is black for the object. The room behind the object stays."""
    opaque(folder)
    masks(folder, name)
    photos = captures.read(ring.LABS, folder)
    np.testing.assert_array_equal(coverage(photos), [ring.picture(k)[..., 3] for k in range(6)])
    np.testing.assert_allclose(photos.pictures[0][0, 0], [1, 1, 1, 0])


def test_alpha_goes_before_a_mask_and_an_alpha_of_1_says_nothing(folder):
    """A mask of something else cuts what alpha has cut, or an opaque RGBA is all object."""
    expected = coverage(captures.read(ring.LABS, folder))
    image.write(folder / "3.png", np.dstack([image.read(folder / "3.png")[..., :3],
                                             np.ones((32, 48))]))
    masks(folder)
    image.write(folder / "masks" / "1.png", np.zeros((32, 48)))
    np.testing.assert_array_equal(coverage(captures.read(ring.LABS, folder)), expected)


def test_dust_on_the_border_is_let_be(folder):
    """One wrong pixel stops the reading of a hundred pictures."""
    picture = image.read(folder / "2.png")
    picture[0, 5:8, 3] = 1
    image.write(folder / "2.png", picture)
    captures.read(ring.LABS, folder)


def with_alpha(_):
    """The pictures of the folder, as they are."""


def masked(folder):
    opaque(folder)
    masks(folder)


@pytest.mark.parametrize(("before", "file", "picture", "sentence"), [
    (with_alpha, "2.png", np.roll(ring.picture(2), 16, axis=1),
     "the object is cut off by the border of 2.png: leave such pictures out"),
    (with_alpha, "0.png", np.zeros((*SIDES, 4)),
     "0.png shows no object: everywhere it is background"),
    (masked, "masks/1.png", np.zeros(SIDES),
     "1.png shows no object: everywhere it is background"),
    (masked, "masks/0.png", np.ones(SIDES), "0.png shows no background"),
    (masked, "masks/0.png", ring.picture(0)[..., 3].T,
     "the mask 0.png has 32 x 48 pixels, and 0.png has 48 x 32: both must be the same")])
def test_what_is_wrong_with_a_picture_is_told(folder, before, file, picture, sentence):
    """A silhouette that is everything or nothing, or the room instead of the object."""
    before(folder)
    image.write(folder / file, picture)
    assert sentence in ring.told(folder)


def test_all_pictures_that_crop_the_object_are_named_and_inverted_masks_are_told(folder):
    """The user mends one picture after the other, or leaves out good ones."""
    masked(folder)
    for k in 1, 4:
        image.write(folder / f"{k}.png", np.roll(ring.picture(k), 24, axis=1))
    assert "border of 1.png, 4.png: leave such pictures out" in ring.told(folder)
    opaque(folder)
    for k in range(6):
        image.write(folder / "masks" / f"{k}.png", 1 - ring.picture(k)[..., 3])
    assert "most borders are object: masks or transparency look inv" in ring.told(folder)


def test_what_is_wrong_with_a_folder_s_files_is_told(folder):
    """A traceback, or the room instead of the object."""
    masked(folder)
    (folder / "masks" / "5.png").unlink()
    assert "5.png has no transparency, and no mask masks/5.png, white for" in ring.told(folder)
    (folder / "1.png").write_bytes((folder / "1.png").read_bytes()[:90])
    assert "it is broken, cut short or something else" in ring.told(folder)
