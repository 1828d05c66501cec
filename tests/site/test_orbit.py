"""The meshes that a reader turns: three.js comes when it is asked for, and every hand can turn."""
import html
import io
import json
import shutil

import numpy as np
import pytest
import trimesh
from hands import drag, spot, swipe
from PIL import Image
from serving import ROOT, served

SIZE = 320
PAGE = """<!doctype html><html lang="en"><title>A mesh</title><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,"><link rel="stylesheet" href="_static/players/orbit.css">
<body style="margin: 0"><h1 style="height: 40px; margin: 0">A mesh</h1>
<figure class="orbit" style="margin: 0" data-shading="flat" {eye} data-meshes="{meshes}">
<img src="still.png" alt="Two balls" width="{size}" height="{size}"></figure>
<p style="height: 2000px">Below</p>
<script type="module">
  import {{ show }} from "./_static/players/orbit.js";
  show(document.querySelector("figure"));
</script>"""


def ball(level):
    """An icosphere whose vertices have colours: a GLB file."""
    made = trimesh.creation.icosphere(subdivisions=level)
    colours = np.rint(127 * (made.vertices + 1)).astype(np.uint8)
    made.visual.vertex_colors = np.pad(colours, ((0, 0), (0, 1)), constant_values=255)
    return made.export(file_type="glb")


def painted():
    """A box with a blue texture: a GLB file."""
    made = trimesh.creation.box()
    blue = trimesh.visual.material.PBRMaterial(baseColorTexture=Image.new("RGB", (4, 4), "#0000ff"))
    made.visual = trimesh.visual.TextureVisuals(uv=made.vertices[:, :2], material=blue)
    return made.export(file_type="glb")


def page_of(files, eye=""):
    meshes = [{"file": file, "label": label} for file, label in files.items()]
    return PAGE.format(meshes=html.escape(json.dumps(meshes)), size=SIZE, eye=eye)


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """A small site: pages with one mesh, with two, with paint."""
    folder = tmp_path_factory.mktemp("orbit")
    shutil.copytree(ROOT / "site" / "static" / "players", folder / "_static" / "players")
    shutil.copytree(ROOT / "site" / "static" / "vendor", folder / "_static" / "vendor")
    Image.new("RGB", (SIZE, SIZE), "#edf2f7").save(folder / "still.png")
    (folder / "coarse.glb").write_bytes(ball(0))
    (folder / "fine.glb").write_bytes(ball(3))
    (folder / "box.glb").write_bytes(trimesh.creation.box((1, 2, 3)).export(file_type="glb"))
    (folder / "painted.glb").write_bytes(painted())
    (folder / "painted.html").write_text(page_of({"painted.glb": "12 faces"}))
    (folder / "two.html").write_text(page_of({"coarse.glb": "20 faces", "fine.glb": "1,280 faces"}))
    (folder / "box.html").write_text(page_of({"box.glb": "12 faces"}, 'data-eye="3 4 5"'))
    with served(folder) as place:
        yield place


@pytest.fixture
def turnable(page, address):
    """turnable(name): open this page and ask for its first mesh -> the page, where it is drawn."""
    def opened(name):
        page.goto(f"{address}/{name}.html")
        page.get_by_role("button", name="Turn it").click()
        page.locator("canvas").wait_for()
        page.wait_for_timeout(100)
        return page
    return opened


@pytest.fixture
def two(turnable):
    """The page with two meshes, of which the first can be turned."""
    return turnable("two")


def picture(page):
    """What stands in the figure's box: (H, W, 3) bytes."""
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    shot = page.locator(".stage").screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)


def changed(before, after):
    """The share of pixels that changed visibly."""
    return np.mean(np.abs(before - after).max(2) > 8)


def test_three_is_loaded_only_when_asked_for(page, address):
    """The page carries 640 kB for readers who turn nothing."""
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(f"{address}/two.html")
    page.wait_for_timeout(300)
    assert not any(url.endswith(("three.min.js", ".glb")) for url in asked)
    still = picture(page)
    page.get_by_role("button", name="Turn it").focus()
    page.keyboard.press("Enter")
    page.locator("canvas").wait_for()
    assert any(url.endswith("three.min.js") for url in asked)
    assert any(url.endswith("coarse.glb") for url in asked)
    assert not any(url.endswith("fine.glb") for url in asked)
    assert changed(still, picture(page)) > 0.2


def test_the_canvas_takes_the_stills_box(page, address):
    """The text below jumps, or the mesh is stretched."""
    page.set_viewport_size({"width": 250, "height": 600})
    page.goto(f"{address}/two.html")
    before = page.locator("img").bounding_box()
    page.get_by_role("button", name="Turn it").click()
    assert page.locator("canvas").bounding_box() == before
    assert before["width"] == before["height"] == 250
    page.set_viewport_size({"width": 600, "height": 600})
    page.wait_for_timeout(100)
    assert page.locator("canvas").bounding_box()["width"] == SIZE
    assert page.locator("canvas").evaluate("canvas => [canvas.width, canvas.height]") == [SIZE] * 2


@pytest.mark.parametrize("name, least", [("two", 0.05), ("painted", 0.1)])
def test_colours_and_textures_are_shown(turnable, name, least):
    """A vertex's colour or a texture is lost, and all is brass: red and no blue."""
    red, _, blue = np.moveaxis(picture(turnable(name)), 2, 0)
    assert np.mean(blue > red + 40) > least


def test_keys_turn_and_zoom(two):
    """A key does nothing, scrolls the page, or does what its opposite does."""
    first = picture(two)
    for there, back in ("ArrowLeft", "ArrowRight"), ("ArrowUp", "ArrowDown"), ("+", "-"):
        two.keyboard.press(there)
        two.keyboard.press(there)
        assert changed(first, picture(two)) > 0.04, there
        two.keyboard.press(back)
        two.keyboard.press(back)
        assert changed(first, picture(two)) < 0.005, back
    assert two.evaluate("scrollY") == 0


def test_the_mouse_turns_reset_turns_back_and_an_arrow_turns_as_the_mouse(two):
    """The reset's picture is another than the first one, or the right arrow turns to the left."""
    first, step = picture(two), SIZE // 48
    drag(two, two.locator(".stage"), 4 * step, 0)
    dragged = picture(two)
    assert changed(first, dragged) > 0.04
    two.get_by_role("button", name="Reset view").click()
    assert np.array_equal(first, picture(two))
    two.locator("canvas").focus()
    for _ in range(4):
        two.keyboard.press("ArrowRight")
    assert changed(dragged, picture(two)) < changed(dragged, picture(two)[:, ::-1]) / 2


def test_the_wheel_zooms_only_where_the_reader_works(two):
    """A reader who scrolls past is held at the canvas."""
    first = picture(two)
    two.mouse.move(*spot(two.locator(".stage")))
    two.mouse.wheel(0, 60)
    assert changed(first, picture(two)) > 0.02
    assert two.evaluate("scrollY") == 0
    zoomed = picture(two)
    two.evaluate("document.activeElement.blur()")
    two.mouse.wheel(0, 60)
    two.wait_for_function("scrollY > 0")
    two.evaluate("scrollTo(0, 0)")
    assert np.array_equal(zoomed, picture(two))


def test_the_slider_changes_the_mesh_and_the_camera_stays(two):
    """The label and the mesh are not of one step, or the view jumps back."""
    two.keyboard.press("ArrowLeft")
    coarse, slider = picture(two), two.get_by_role("slider")
    assert slider.get_attribute("aria-valuetext") == "20 faces"
    slider.focus()
    two.keyboard.press("ArrowRight")
    two.get_by_text("1,280 faces").wait_for()
    two.wait_for_load_state("networkidle")
    two.wait_for_timeout(200)
    assert slider.get_attribute("aria-valuetext") == "1,280 faces"
    assert changed(coarse, picture(two)) > 0.1
    two.keyboard.press("ArrowLeft")
    assert np.array_equal(coarse, picture(two))


def test_edges_are_drawn_and_taken_away(two):
    """The button does not say whether it is pressed."""
    first, edges = picture(two), two.get_by_role("button", name="Edges")
    assert edges.get_attribute("aria-pressed") == "false"
    edges.click()
    dark = picture(two).max(2) < 60
    assert edges.get_attribute("aria-pressed") == "true"
    assert dark.mean() > (first.max(2) < 60).mean() + 0.005
    edges.click()
    assert np.array_equal(first, picture(two))


def test_nothing_is_drawn_while_nothing_moves(two):
    """An endless loop warms the reader's lap."""
    two.evaluate("""() => {
      window.drawn = 0;
      const draw = WebGL2RenderingContext.prototype.drawElements;
      WebGL2RenderingContext.prototype.drawElements = function (...all) {
        window.drawn += 1;
        return draw.apply(this, all);
      };
    }""")
    two.wait_for_timeout(400)
    assert two.evaluate("drawn") == 0
    two.keyboard.press("ArrowLeft")
    assert two.evaluate("drawn") > 0


def test_the_picture_comes_back_when_the_system_took_its_memory(two):
    """The canvas stays empty."""
    first = picture(two)
    two.evaluate("""async () => {
      const canvas = document.querySelector("canvas");
      const memory = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
      const back = new Promise(done => canvas.addEventListener("webglcontextrestored", done));
      memory.loseContext();
      await new Promise(done => setTimeout(done, 100));
      memory.restoreContext();
      await back;
    }""")
    assert np.array_equal(first, picture(two))


def test_one_mesh_has_no_slider_and_is_seen_first_from_the_eye_that_is_given(turnable):
    """A slider that moves nothing; or the mesh jumps when it takes the still's place."""
    page = turnable("box")
    page.get_by_text("12 faces").wait_for()
    assert page.get_by_role("slider").count() == 0
    seen = np.ptp(picture(page), axis=2) > 20  # brass on grey
    eye, scale = np.array([3.0, 4.0, 5.0]), SIZE / 2 / np.tan(np.radians(24))
    back = eye / np.linalg.norm(eye)
    right = np.cross([0, 1, 0], back)
    right /= np.linalg.norm(right)
    corners = trimesh.creation.box((1, 2, 3)).vertices - eye
    depth = -corners @ back
    x = SIZE / 2 + scale * corners @ right / depth
    y = SIZE / 2 - scale * corners @ np.cross(back, right) / depth
    rows, columns = np.nonzero(seen)
    found = columns.min(), columns.max() + 1, rows.min(), rows.max() + 1
    assert np.allclose(found, [x.min(), x.max(), y.min(), y.max()], atol=1.5)


def test_a_finger_scrolls_before_and_turns_after(new_page, address):
    """The figure holds a reader who scrolls past, before or after; or it scrolls away below a
    finger that turns."""
    page = new_page(has_touch=True, viewport={"width": SIZE, "height": 500})
    page.goto(f"{address}/two.html")
    x, y = spot(page.locator(".stage"))
    swipe(page, ((x, y), (x, y - 90)))
    page.wait_for_function("scrollY > 0")
    page.goto("about:blank")  # the scrolling goes on for a while
    page.goto(f"{address}/two.html")
    page.get_by_role("button", name="Turn it").tap()
    page.locator("canvas").wait_for()
    first = picture(page)
    swipe(page, ((x, y), (x + 60, y - 30)))
    turned = picture(page)
    assert changed(first, turned) > 0.1
    swipe(page, ((x - 20, y), (x - 60, y)), ((x + 20, y), (x + 60, y)))
    larger = (np.ptp(picture(page), axis=2) > 30).mean()
    assert larger > 1.3 * (np.ptp(turned, axis=2) > 30).mean()
    assert page.evaluate("scrollY") == 0
    swipe(page, ((x, y), (x, y - 90)))
    page.wait_for_function("scrollY > 0")


def test_without_webgl_the_still_stays(page, address):
    """An empty box, and no word."""
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.goto(f"{address}/two.html")
    page.get_by_role("button", name="Turn it").click()
    page.get_by_text("this browser has no WebGL").wait_for()
    assert page.locator("img").is_visible()
    assert page.get_by_role("button").count() == page.locator("canvas").count() == 0


@pytest.mark.parametrize("missing", ["coarse.glb", "three.min.js"])
def test_what_does_not_come_is_told_and_asked_for_again(new_page, address, missing):
    """The button says Loading for ever, or is gone, and the reader has to load the page anew."""
    page = new_page(missing=missing)
    page.route(f"**/{missing}", lambda route: route.abort(), times=1)
    page.goto(f"{address}/two.html")
    page.get_by_role("button", name="Turn it").click()
    page.get_by_text("The mesh did not load. Press the button to try again.").wait_for()
    assert page.locator("img").is_visible()
    page.get_by_role("button", name="Turn it").click()
    page.locator("canvas").wait_for()
    assert not page.get_by_text("did not load").count()


def test_a_later_mesh_that_does_not_come_is_told(new_page, address):
    """The old mesh stands below the new one's name, and the next try fails as well."""
    page = new_page(missing="fine.glb")
    page.route("**/fine.glb", lambda route: route.abort(), times=1)
    page.goto(f"{address}/two.html")
    page.get_by_role("button", name="Turn it").click()
    slider = page.get_by_role("slider")
    slider.press("End")
    page.get_by_text("20 faces. The mesh of 1,280 faces did not load: move the slider").wait_for()
    assert slider.input_value() == "0"
    coarse = picture(page)
    slider.press("End")
    page.get_by_text("1,280 faces", exact=True).wait_for()
    assert changed(coarse, picture(page)) > 0.1
