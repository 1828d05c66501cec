"""The page about a mesh that was found from a folder of pictures."""
import base64
import html.parser
import http.server
import io
import re
import shutil
import subprocess
import time
import urllib.parse

import numpy as np
import pytest
from found_objects import LABS, found_of, painted_ball
from PIL import Image, ImageSequence

from course.experiments.folder import captures, command, exports, fit_report
from course.experiments.scenes import viewing
from reference import multi_view_fit, reconstruction

LOOK_AND_TURN = """<script>
const plain = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind) {
  return plain.call(this, kind, { preserveDrawingBuffer: true });
};
const told = [];
console.error = (...words) => told.push(words.join(" "));
onerror = message => told.push(message);
onunhandledrejection = e => told.push(String(e.reason));
const wait = ms => new Promise(done => setTimeout(done, ms));
(async () => {
  let canvas = null;
  for (let k = 0; k < 50 && !canvas; k++) {
    await wait(100);
    canvas = document.querySelector("canvas");
  }
  await wait(500);
  const before = canvas && canvas.toDataURL();
  if (canvas) canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
  await wait(500);
  const moved = canvas && before !== canvas.toDataURL();
  const answer = `canvas ${!!canvas}, moved ${moved}, told ${told.join("; ") || "nothing"}`;
  await fetch("ADDRESS/" + encodeURIComponent(answer), { mode: "no-cors" });
})();
</script>"""


def painted():
    """A Scene of 8^3 cells: a ball in many colours, in uneven light."""
    x = painted_ball(8)
    return x._replace(light=x.light + 0.2 * np.random.default_rng(1).uniform(-1, 1, (9, 3)))


@pytest.fixture(scope="module")
def made():
    """Ten pictures of a smaller, brighter ball than the one that was found."""
    cameras = viewing.cameras_around(LABS, 10)
    truth = painted()._replace(distance=painted().distance + 0.1, light=1.1 * painted().light)
    found = found_of(truth)
    pictures = list(fit_report.rendered(LABS, found.surface, found.colours[:, :3], cameras,
                                        np.ones(3), (24, 32)))
    return captures.Photos([f"<{k}>.png" for k in range(10)], pictures, cameras, np.ones(3),
                           np.diag([2.0, 2.0, 2.0, 1.0]), ["Green & blue are <right>."])


@pytest.fixture(scope="module")
def page(made, tmp_path_factory):
    """report.html of the ball, as a path."""
    path = tmp_path_factory.mktemp("report") / "ball.glb"
    found = found_of(painted(), tuple(np.geomspace(1, 0.1, 30)), 83.0)
    dark = found.kept.x._replace(light=0.5 * found.kept.x.light)
    found = found._replace(kept=found.kept._replace(x=dark),
                           colours=found.colours * np.repeat([0.9, 1.0], 3),
                           count=np.maximum(found.surface.vertices[:, 1], 0))
    exports.save_textured(LABS, found.surface, found.count, path, made.world_from_grid)
    judged = fit_report.judged(LABS, found, made, [10, 10, 10], command.kept_out(made))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fit_report, "WORST", 9)
        fit_report.write(LABS, judged, made, path, time.process_time() - 125)
    return path.with_name("report.html")


class Found(html.parser.HTMLParser):
    """The pictures of a page with their alternative texts, and its text, in cells."""

    def __init__(self, text):
        super().__init__()
        self.images, self.links, self.cells = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.links += [given[name] for name in ("src", "href", "srcset") if name in given]
        if tag == "img":
            self.images.append(given)

    def handle_data(self, text):
        self.cells.append(text.strip())


def number(page, name, column=1):
    """A number of the page's tables."""
    cells = [cell for cell in Found(page.read_text()).cells if cell]
    return float(re.match(r"[\d.,]+", cells[cells.index(name) + column])[0].replace(",", ""))


def test_the_page_is_one_small_file(page):
    """It asks another host, or a picture is missing when the file is sent to a friend."""
    found = Found(page.read_text())
    assert page.stat().st_size < 5e6
    assert all(link.startswith("data:") for link in found.links)
    assert not re.search(r"https?://(?!www\.w3\.org)", page.read_text())
    assert len(found.images) == 2 + 3 * 9
    for given in found.images:
        kind, content = given["src"].removeprefix("data:").split(";base64,")
        assert given["alt"].strip()
        if kind != "image/svg+xml":
            Image.open(io.BytesIO(base64.b64decode(content))).load()


def test_the_page_holds_the_very_mesh(page):
    """The viewer shows an older mesh than the file beside it."""
    held = re.search(r'id="mesh">data:model/gltf-binary;base64,([^<]*)<', page.read_text())[1]
    assert base64.b64decode(held) == page.with_name("ball.glb").read_bytes()


def test_names_and_assumptions_are_text(page):
    """A file that is named <b> changes the page."""
    found = Found(page.read_text())
    assert "<7>.png" in found.cells and "Green & blue are <right>." in found.cells
    assert {given["alt"] for given in found.images} >= {"<7>.png: the picture",
                                                        "<7>.png: the difference"}


def seen_again(made, factor=1.0):
    """Pictures and renderings as a screen takes them, and where the object is: all rendered and
    encoded by another way than the report's. The colours are multiplied by a factor.
    """
    x = painted()
    ball = multi_view_fit.surface(x)
    colours = factor * (reconstruction.sh_basis(ball.normals) @ x.light * ball.albedo)
    capture = multi_view_fit.Capture(made.pictures, made.cameras, made.background)
    shape = LABS.pipeline.make_mesh(ball.vertices, ball.faces)
    targets = multi_view_fit.targets_of(capture, 1, 2)
    rendered, _ = multi_view_fit.render_views(shape, colours, targets)
    both = np.clip(np.stack([made.pictures, rendered]), 0, 1)
    encoded = np.where(both > 0.0031308, 1.055 * both**(1 / 2.4) - 0.055, 12.92 * both)[..., :3]
    return *encoded, both[0, ..., 3], both[1, ..., 3]


def test_the_numbers_are_right(made, page):
    """The report flatters: it counts the background, or views that the search saw, or the colours
    of eq. (10) in the place of paint times light.
    """
    new = 7
    for column, factor in (1, 0.5), (2, 0.9), (3, 1.0):
        picture, rendering, there, found = seen_again(made, factor)
        squares = (picture - rendering)**2
        for name, expected in (
                ("New views, on the object", squares[new][there[new] > 0]),
                ("New views, whole pictures", squares[new]),
                ("Views of the search, whole pictures", np.delete(squares, new, 0))):
            assert number(page, name, column) == pytest.approx(-10 * np.log10(expected.mean()),
                                                               abs=0.02)
    both, either = (there >= 0.5) & (found >= 0.5), (there >= 0.5) | (found >= 0.5)
    share = both.sum((1, 2)) / either.sum((1, 2))
    assert number(page, "IoU of the silhouettes, mean of all") == pytest.approx(share.mean(),
                                                                                abs=1e-4)
    assert 0.5 < share.mean() < 0.95
    assert number(page, "Faces") == len(multi_view_fit.surface(painted()).faces)
    assert (number(page, "Pieces"), number(page, "Genus"), number(page, "Steps")) == (1, 0, 30)
    cells = Found(page.read_text()).cells
    assert cells[cells.index("Processor time to the end of the search") + 1] == "1 min 23 s"
    assert cells[cells.index("Processor time of all") + 1].startswith("2 min ")
    assert number(page, "Area that no picture of the search shows") == pytest.approx(50, abs=5)


def test_the_worst_views_are_shown_first(made, page):
    """Two hundred views that are met, and the one that is not is the last, or is left out."""
    picture, rendering, there, _ = seen_again(made)
    squares = [each[seen > 0].mean() for each, seen in zip((picture - rendering)**2, there,
                                                           strict=True)]
    shown = re.findall(r"<br><small>([\d.]+) dB", page.read_text())
    np.testing.assert_allclose(np.array(shown, float), np.sort(-10 * np.log10(squares))[:9],
                               atol=0.07)


def test_the_turntable_turns_on_nothing(page):
    """One frame, or a white box on a dark page."""
    turntable = Image.open(page.with_name("turntable.png"))
    assert turntable.n_frames == fit_report.FRAMES
    frames = [np.asarray(each.convert("RGBA")) for each in ImageSequence.Iterator(turntable)]
    assert all(frame[0, 0, 3] == 0 and frame[120, 120, 3] == 255 for frame in frames)
    assert (frames[0] != frames[10]).any()


@pytest.mark.parametrize("height", [0.55, 0.75, 0.95])
def test_up_is_found_from_pictures_that_stand_or_lie(height):
    """The object lies on its side or stands on its head: z is up in the folder's world, or a gantry
    turned the camera.
    """
    around = viewing.directions(np.linspace(0, 1, 12, endpoint=False), np.full(12, height))
    stand = np.array([LABS.transforms.look_at(3 * eye[[2, 0, 1]], np.zeros(3), np.eye(3)[2])
                      for eye in around])[:, [0, 1, 2, 2]]
    lie = stand[:, [1, 0, 2, 3]] * [[[-1.0], [1], [1], [1]]]
    lie[::2, :2] *= -1
    for cameras in stand, lie:
        cameras[:, 3] *= -1
        np.testing.assert_allclose(fit_report.upwards(cameras), [0, 0, 1], atol=1e-9)


def test_the_viewer_draws_and_turns_by_keys(page):
    """The page shows a still picture only, or the console shows an error."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if not browser:
        pytest.skip("needs chromium")
    answers = []

    class Listener(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            answers.append(urllib.parse.unquote(self.path[1:]))
            self.send_response(204)
            self.end_headers()

    server = http.server.HTTPServer(("127.0.0.1", 0), Listener)
    server.timeout = 60
    script = LOOK_AND_TURN.replace("ADDRESS", f"http://127.0.0.1:{server.server_port}")
    watched = page.with_name("watched.html")
    watched.write_text(page.read_text().replace("<h1>", f"{script}<h1>", 1))
    running = subprocess.Popen(
        [browser, "--headless", "--no-sandbox", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", f"--user-data-dir={page.parent / 'browser'}",
         "--remote-debugging-port=0", watched.as_uri()], stderr=subprocess.DEVNULL)
    try:
        server.handle_request()
        assert answers == ["canvas true, moved true, told nothing"]
    finally:
        running.terminate()
        running.wait()
        server.server_close()
