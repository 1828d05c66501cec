"""The search: what a reader types, and what stands first."""
import re

from serving import SITE

WEIGHT_LIMIT = 500_000  # bytes of the first search, with all that the page loads

# What is asked, and the addresses of which one stands among the first three.
QUERIES = {
    **{f"{one} 8": [rf"{one}s?/08_\w+\.html$"] for one in ("lab", "lecture")},
    **dict.fromkeys(["8.4", "exercise 8.4"], (r"labs/08_\w+\.html#exercise-8-4$",)),
    **dict.fromkeys(["zbuffer", "z-buffer"], (r"#term-z-buffer$", r"lectures/02_.*z-buffer$")),
    "crossing equation": [r"lectures/08_.*#where-does-the-edge-cross$", r"#exercise-8-4$"],
    **dict.fromkeys(["install", "download", "get the course", "requirements"], (r"index\.html#",)),
    "top-left rule": [r"#term-top-left-rule$"],
    "antialias gradient": [r"lectures/08_", r"outlines\.antialias_backward$"],
    "bilinear": [r"#term-bilinear$", r"lectures/06_.*#one-texel"],
    "quadric": [r"#term-quadric", r"lectures/12_.*#the-distance"],
    "shadow acne": [r"#term-shadow-acne$", r"lectures/14_.*#acne"],
    "perspective divide": [r"#term-perspective-divide$", r"lectures/01_.*#the-divide$"],
    "Adam": [r"#term-Adam$", r"lectures/09_.*#downhill-adam$"],
    "mipmap": [r"#term-mip", r"lectures/06_", r"labs/06_", r"mipmapping\.html$"],
    "soft rasterizer": [r"#term-SoftRas$", r"lectures/10_.*softras$", r"soft_rasterizer\.html$"],
    **dict.fromkeys(["silhouette", "what is a silhouette edge", "silhouettes"],
                    (r"#term-silhouette-edge$", r"lectures/08_.*#which-edges-silhouettes$")),
    "finite difference": [r"#term-central-difference$", r"given/gradcheck\.html"],
    **dict.fromkeys(["barycentric", "barycentic", "baricentric", "barycenttric"],
                    (r"#term-barycentrics$", r"lectures/02_.*barycentric", r"lectures/05_")),
    "marching tetrahedra": [r"#term-marching-tetrahedra$", r"lectures/15_.*#marching"],
    "antialias_backward": [r"outlines\.antialias_backward$"],
    "nvdiffrast": [r"real_projects\.html"],
    **dict.fromkeys(["grade", "plagiarism", "grades csv"], (r"grading\.html",)),
    "autograd": [r"#term-automatic-differentiation$", r"lectures/09c_"],
    "tie rule": [r"#term-top-left-rule$", r"is_top_left$", r"#exercise-2-2$"],
    "own photographs": [r"own_pictures\.html"],
    "how long does it take": [r"index\.html#how-long-it-takes$"],
    "run in the browser": [r"index\.html#run-it-in-the-browser$"],
    "points for each exercise": [r"#term-points-of-an-exercise$", r"labs/index\.html$"],
    "my python is too old": [r"index\.html#if-your-python-is-too-old$"],
    **dict.fromkeys(["why black", "black picture", "my picture is black"],
                    (r"#term-black-picture$",)),
    "nan": [r"#term-nan$"],
    "hand in": [r"index\.html#run-it-in-the-browser$", r"(instructors|first_week|grading)\.html"],
}


def found(page, words):
    """The addresses that the search shows for these words, and what it says."""
    page.wait_for_function("words => document.getElementById('found-count').textContent"
                           ".includes(`“${words}”`)", arg=words)
    links = page.eval_on_selector_all("#found a", "all => all.map(one => one.href)")
    return links, page.text_content("#found-count")


def test_what_a_reader_looks_for_is_among_the_first_three(page, address):
    """The words are on forty pages, and the one that says what they mean comes last."""
    page.goto(f"{address}/search.html")
    wrong = {}
    for words, right in QUERIES.items():
        page.fill("#search input", words)
        links, _ = found(page, words)
        if not any(re.search(one, link) for one in right for link in links[:3]):
            wrong[words] = links[:3]
    assert wrong == {}


def test_a_search_loads_less_than_half_a_megabyte_and_shows_a_lab_once(page, address):
    """It fetches whole pages to quote a line of each, or an index that it does not need. The page
    of the lab and its part of the list of labs say the same words."""
    weight = {}
    page.on("requestfinished", lambda request: weight.update(
        {request.url: request.sizes()["responseBodySize"]}))
    page.goto(f"{address}/search.html?q=lab+8", wait_until="networkidle")
    links, _ = found(page, "lab 8")
    assert not [link for link in links if "/labs/index.html#" in link]
    assert f"{address}/search_records.js" in weight
    assert sum(weight.values()) < WEIGHT_LIMIT, weight


def test_results_are_announced_and_reached_by_keyboard(page, address):
    """A reader without a mouse has to guess whether something was found, and where it is."""
    page.goto(f"{address}/search.html?q=shadow+acne")
    _, said = found(page, "shadow acne")
    assert page.get_attribute("#found-count", "role") == "status"
    assert re.match(r"\d+ places for", said)
    page.press("#search input", "Tab")
    page.keyboard.press("Enter")
    page.wait_for_url("**/glossary.html#term-shadow-acne")


def test_a_row_marks_whole_words_in_its_title_and_has_no_shapes(page, address):
    """Half a word is yellow; a docstring is quoted as "where the line meets: c (...). (3)", a
    sentence without its formulas.
    """
    page.goto(f"{address}/search.html?q=crossin")
    found(page, "crossin")
    marks = page.eval_on_selector_all("#found a mark", "all => all.map(one => one.textContent)")
    assert "crossing" in marks and "crossin" not in marks
    page.fill("#search input", "8.4")
    found(page, "8.4")
    words = page.text_content("#found p")
    assert "Equation (3): where the line through (x0, y0) and (x1, y1) meets y = 0: c." in words
    assert "..." not in words and "c. (3)" not in words
    page.fill("#search input", "perspective divide")
    found(page, "perspective divide")
    assert "The division by w that makes what is far small." in page.text_content("#found p")


def test_the_search_finds_from_disk_too(browser):
    """The site was copied to a laptop, and what the search fetches may not be fetched there."""
    page = browser.new_page()
    page.goto(f"{(SITE / 'search.html').as_uri()}?q=8.4")
    links, _ = found(page, "8.4")
    page.close()
    assert links[0].endswith("labs/08_antialiasing.html#exercise-8-4")
