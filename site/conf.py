"""How Sphinx makes the web site of the pages that build.py has written."""
import os
import sys
from pathlib import Path
from urllib.parse import urlsplit

SITE = Path(__file__).parent
sys.path[:0] = [str(SITE), str(SITE.parent)]

project = "Differentiable rasterization in plain NumPy"
author = "the authors of the course"
copyright = "Code: MIT License. Lectures and figures: CC BY 4.0"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.viewcode", "pages.sources",
              "pages.formulas", "pages.references", "pages.folds", "pages.search",
              "pages.sidebar", "sphinx_copybutton"]

autodoc_typehints = "none"
autodoc_preserve_defaults = True
add_module_names = False
toc_object_entries_show_parents = "hide"

myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist", "attrs_inline",
                          "attrs_block"]
myst_heading_anchors = 3
myst_dmath_double_inline = True
nb_execution_mode = "off"
nb_merge_streams = True
nb_code_prompt_show = "How it is drawn"
copybutton_selector = ":not(.output) > div.highlight > pre"
copybutton_exclude = ".gp, .go"  # prompts, and what was printed

templates_path = ["templates"]
html_theme = "furo"
html_favicon = str(SITE / "static" / "icon.svg")
html_title = project
html_short_title = "Differentiable rasterization"
html_math_renderer = "mathml"
html_static_path = [str(SITE / "static")]
html_css_files = ["style.css", "source.css", "players/players.css", "figures/figures.css"]
html_additional_pages = {"search": "search.html"}
html_js_files = [("scrolling.js", {"defer": "defer"}), ("figures/begin.js", {"type": "module"}),
                 ("players/animation.js", {"type": "module"})]
html_copy_source = False
html_domain_indices = False  # reference/index lists the modules
html_show_sphinx = False
html_permalinks_icon = "#"
html_theme_options = {
    "navigation_with_keys": False,
    # how bright the white of a drawn picture is: its colours have a meaning, so none is inverted
    "light_css_variables": {"white": "1"}, "dark_css_variables": {"white": "0.82"}}

# Where the site will be, as its publisher says: search engines and chats want whole addresses.
ADDRESS = os.environ.get("SITE_ADDRESS", "").rstrip("/")
extensions += ["pages.descriptions", "sphinxext.opengraph", "notfound.extension"]
ogp_social_cards = {"enable": False}
notfound_urls_prefix = f"{urlsplit(ADDRESS).path}/"
notfound_context = {"title": "Page not found", "body": f"""<h1>Page not found</h1>
<p>There is no page at this address. Look for it with
<a href="{notfound_urls_prefix}search.html">the search</a>, in
<a href="{notfound_urls_prefix}labs/index.html">the list of all labs</a>, or begin at
<a href="{notfound_urls_prefix}index.html">the front page</a>.</p>"""}
if ADDRESS:
    html_baseurl = ogp_site_url = f"{ADDRESS}/"
    ogp_image = f"{ADDRESS}/still_life.jpg"
    ogp_image_alt = "a terracotta bunny, a teal teapot, a ball and a brass ring on a tiled floor"
