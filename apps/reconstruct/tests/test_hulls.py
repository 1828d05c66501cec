"""Where the object is, and whether cameras and silhouettes agree on it."""
import numpy as np
import pytest
import ring_captures as ring
from scipy.spatial.transform import Rotation

from apps.reconstruct import camera_files, captures, hulls, silhouettes
from course.given import image


def with_poses(folder, poses):
    return ring.nerf(folder, frames=ring.frames(poses))


def told(folder, poses):
    return ring.told(with_poses(folder, poses))


def facing(*places, ups=((0, 1, 0),)):
    """Shots of 20 x 20 pixels with f = 20, at places, that look at the origin. ups: one, or each's.
    """
    axes = zip(*np.broadcast_arrays(np.array(places, float), np.array(ups, float)), strict=True)
    poses = [np.linalg.inv(ring.LABS.transforms.look_at(place, np.zeros(3), up))
             for place, up in axes]
    return [camera_files.Shot(f"{k}.png", None, 20, 20, 20.0, 20.0, 10.0, 10.0, pose)
            for k, pose in enumerate(poses)]


def square(half):
    """A picture (20, 20, 4) with a square of 2 half pixels in its middle."""
    picture = np.zeros((20, 20, 4))
    picture[10 - half:10 + half, 10 - half:10 + half] = 1
    return picture


def test_a_pixels_ray_on_paper():
    """A ray leads through a pixel's corner, or rows are counted from above.

    The pixel 15, 5 from below, has its centre 4.5 right of (11, 8), and 20 - 5.5 - 8 = 6.5 below.
    """
    shot = camera_files.Shot("a.png", None, 30, 20, 10.0, 5.0, 11.0, 8.0, np.eye(4))
    ray = hulls.rays(shot, np.array([[15, 5]]))
    np.testing.assert_allclose(ray / -ray[0, 2], [[0.45, -1.3, -1]])
    column, row, depth = hulls.seen_at(shot, 7 * ray / -ray[0, 2])
    np.testing.assert_allclose([column[0], row[0], depth[0]], [15.5, 5.5, 7])


def test_axes_meet_in_the_object():
    """The mean of the cameras, or of their nearest pairs, is taken for the meeting point."""
    outlines = [hulls.outline(shot, square(2)) for shot in facing([0, 0, 9], [4, 0, 0], [1, 5, 2])]
    np.testing.assert_allclose(hulls.nearest_to_axes(outlines), 0, atol=1e-12)


def test_a_hull_on_paper():
    """A silhouette's cone is a cylinder, or the hull is what any one silhouette covers.

    Six views from 10 away along the axes, f = 20, each of a square of 8 pixels: what a view covers
    at depth d reaches 4/20 d = 0.2 d from its axis. So the hull ends at 0.2 * 10 = 2 on an axis,
    where the views from the sides see its end, and on a diagonal at s = 0.2 (10 - s), s = 5/3.
    """
    places = 10 * np.vstack([np.eye(3), -np.eye(3)])
    outlines = [hulls.outline(shot, square(4))
                for shot in facing(*places, ups=np.roll(places, 1, axis=1))]
    points, reach = hulls.hull_around(outlines)
    assert reach < 0.1
    assert 2 - 2 * reach < np.abs(points).max() < 2 + 2 * reach
    assert abs(np.abs(points).min(1).max() - 5 / 3) < 2 * reach


def test_the_ball_is_found_and_it_is_said(folder):
    """The ball crops the object, or is so large that the grid is wasted. Nobody hears of it."""
    photos = captures.read(ring.LABS, folder)
    (radius, *_), centre = photos.world_from_grid[0, :3], photos.world_from_grid[:3, 3]
    assert 0.75 < radius < 0.85  # the ring's radius is 0.5 + 0.25
    np.testing.assert_allclose(centre, ring.CENTRE, atol=0.04)
    middle = f"({centre[0]:.3g}, {centre[1]:.3g}, {centre[2]:.3g})"
    assert photos.assumed == [f"the object is taken to lie in a ball of radius {radius:.3g} around "
                              f"{middle}, found from the silhouettes"]


def test_blame_is_sought_only_where_something_is_wrong(folder, monkeypatch):
    """Of a good folder, too, one picture after the other is left out: half of all reading."""
    monkeypatch.delattr(hulls, "disagreement")
    captures.read(ring.LABS, folder)


def test_the_ball_holds_the_object_of_cameras_that_are_a_little_wrong(folder):
    """The ball is that of the hull, of which wrong cameras cut a piece from all sides."""
    turns = Rotation.from_rotvec(np.radians(2) * np.random.default_rng(3).normal(size=(6, 3)))
    poses = np.array(ring.POSES)
    poses[:, :3, :3] = poses[:, :3, :3] @ turns.as_matrix()
    assert captures.read(ring.LABS, with_poses(folder, poses)).world_from_grid[0, 0] > 0.74


def test_thin_things_are_not_lost():
    """A wire falls between the points of the grid: cameras that agree are said to disagree."""
    wire = np.zeros((160, 160, 4))
    wire[16:144, 80] = 1  # 10 away, that is 8 long and 1/16 thick, and cells are 1/3
    shots = [silhouettes.resized(shot, 160, 160)
             for shot in facing([0, 0, 10], [7, 0, 7], [10, 0, 0], [7, 0, -7])]
    outlines = [hulls.outline(shot, wire) for shot in shots]
    assert len(hulls.hull_around(outlines)[0])


def test_one_camera_that_is_wrong_is_named(folder):
    """All of a hundred cameras are to be looked at."""
    poses = np.array(ring.POSES)
    poses[4, :3, 3] += poses[4, :3, 0] * 1.6
    sentence = ("no point of space is in the silhouettes of all pictures, but without 4.png there "
                "is one: look at the camera")
    assert sentence in told(folder, poses)
    poses[4] = ring.POSES[4] * [-1, 1, -1, 1]  # it looks back
    assert sentence in told(folder, poses)


def test_cameras_of_which_none_is_right_are_told(folder):
    """A search that cannot find anything."""
    poses = np.array(ring.POSES)
    poses[:, :3, 3] += 3 * np.random.default_rng(1).normal(size=(6, 3))
    assert "and leaving one out does not help: does " in told(folder, poses)


def test_cameras_at_one_place_are_told(folder):
    """A turned object: without its turns there is nothing to find."""
    poses = np.array(ring.POSES)
    poses[3] = poses[1]
    assert "3.png and 1.png have the same camera in transforms.json" in told(folder, poses)
    poses = np.array(ring.POSES)
    poses[:, :3, 3] = [0, 0, 4]
    assert "all cameras in transforms.json are at one place: is" in told(folder, poses)


def test_views_from_one_side_are_told():
    """The object's depth is guessed, and the user takes it for found. Or a ring of views from above
    is told to be from one side.
    """
    def looking(*places):
        return [hulls.outline(shot, square(3)) for shot in facing(*places)]

    with pytest.raises(ValueError, match="all views are from one side, within 9 degrees of their"):
        hulls.require_sides(looking((9, 0, 0), (9, 2, 0), (9, 0, 2)))
    hulls.require_sides(looking((0, 5, 9), (0, 5, -9), (9, 5, 0), (-9, 5, 0)))


def test_pixels_finer_than_the_grid_are_filled(folder):
    """Between the hull's points there seems to be nothing: good cameras are said to be bad."""
    ring.photograph(folder, [ring.picture(k, 240, 160) for k in range(6)])
    assumed = captures.read(ring.LABS, folder, longest=240).assumed
    assert [sentence[:21] for sentence in assumed] == ["the object is taken t"]


def test_silhouettes_that_agree_badly_are_told(folder):
    """Someone else's picture lies in the folder: the object is what is left of it."""
    image.write(folder / "1.png", np.roll(ring.picture(1), (5, -9), axis=(0, 1)))
    doubt = captures.read(ring.LABS, folder).assumed[-1]
    assert doubt.startswith("the silhouettes agree badly: ")
    assert doubt.endswith(", and 1.png leaves out most: look at its camera and its mask")
