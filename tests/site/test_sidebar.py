"""The list of all pages: it shows where the reader is, and what belongs to it."""
import pytest
from serving import soup

HERE = """() => {
  const {left, right, top, bottom} =
    document.querySelector(".current-page > a").getBoundingClientRect();
  return [left >= 0 && right <= innerWidth && top >= 0 && bottom <= innerHeight, scrollY];
}"""


@pytest.mark.parametrize("width", [1280, 1440])
@pytest.mark.parametrize("name", ["lectures/16_reconstruction", "labs/08_antialiasing",
                                  "reference/antialiasing", "bibliography"])
def test_the_page_that_is_open_is_in_sight(name, width, page, address):
    """Ninety pages are listed, and the reader's own is below the window, or behind a button."""
    page.set_viewport_size({"width": width, "height": 900})
    page.goto(f"{address}/{name}.html", wait_until="load")
    assert page.evaluate(HERE) == [True, 0]


def test_what_belongs_to_a_topic_stands_below_it(page, address):
    """Lab 6, its code and the sequel of lecture 6 are in three places of a long list."""
    page.goto(f"{address}/reference/mipmapping.html")
    topic = page.locator(".sidebar-tree li.toctree-l1.current")
    assert topic.locator("> a").inner_text() == "6 Texturing"
    assert topic.locator("li > a").all_inner_texts() == [
        "Lab 6", "6b Cube maps", "texturing.py", "mipmapping.py", "cube_maps.py"]
    shown = [link for link in page.locator(".sidebar-tree a").all() if link.is_visible()]
    assert len(shown) < 40


@pytest.mark.parametrize(("name", "before", "after"), [
    ("lectures/08_antialiasing", "07_vertex_gradients", "08b_outline_walk"),
    ("labs/08_antialiasing", "07_vertex_gradients", "09_inverse_rendering"),
    ("lectures/06b_cube_maps", "06_texturing", "07_vertex_gradients")])
def test_next_leads_to_the_next_of_its_kind(name, before, after):
    """Who reads the lectures in their order is sent through the code of each."""
    leads = [soup(f"{name}.html").select_one(f".{way}-page")["href"] for way in ("prev", "next")]
    assert leads == [f"{before}.html", f"{after}.html"]
