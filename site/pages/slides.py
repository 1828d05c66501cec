"""The lectures as slides in out/slides, one file each, which needs no network.

A section begins with its sentence from teaching/slides.toml. Then come its figures, displayed
formulas, guesses, tables, exercises and steps, as they stand in the lecture. Its prose, its code,
and what follows from "On paper" on are left out.
"""
import base64
import html
import json
import re
import tomllib
from string import Template

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from labkit.places import ROOT

from . import put
from .formulas import TAG, formula

LECTURES, SITE = ROOT / "notebooks", ROOT / "site"
TEMPLATE, FONT = SITE / "templates/slides.html", SITE / "static/vendor/stix/stix-two-math.woff2"
GUESS, TASKS, PICTURE = "**Guess first", ("**Exercise", "**Step"), "<img "
SHOWN = re.compile(r"^(?:\$\$.*?\$\$|(?:\*\*(?:Guess first|Exercise|Step)|<img |\|).*?(?=\n\n|\Z))",
                   re.MULTILINE | re.DOTALL)


def write(folder):
    """Write the slides of each lecture that has sentences."""
    lectures = tomllib.loads((ROOT / "teaching/slides.toml").read_text("utf-8"))
    for name, sentences in lectures.items():
        put(folder / f"{name}.html", deck(LECTURES / f"{name}.ipynb", sentences))


def deck(path, sentences):
    """A lecture's page of slides. sentences: {a section's heading: its sentence}."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    text = "\n\n".join(map(as_text, cells)).partition("\n## On paper")[0]
    first, *sections = re.split(r"^## ", text, flags=re.MULTILINE)
    slides = ["\n\n".join([first.partition("\n")[0], *SHOWN.findall(first)])]
    for heading, _, body in (section.partition("\n") for section in sections):
        slides += [f"## {heading}\n\n{slide}"
                   for slide in joined(SHOWN.findall(body), sentences.get(heading, ""))]
    render = MarkdownIt("commonmark", {"html": True}).enable("table").use(
        dollarmath_plugin, renderer=numbered).render
    return Template(TEMPLATE.read_text("utf-8")).substitute(
        title=path.stem, font=coded(FONT),
        slides="\n".join(f"<section>{render(slide)}</section>" for slide in slides))


def as_text(cell):
    """A cell's Markdown, or the pictures that its code has drawn, as Markdown."""
    if cell["cell_type"] == "markdown":
        return re.sub(r'(?<=src=")openings/[^"]*', lambda opening: (
            f"data:image/png;base64,{coded(LECTURES / opening[0])}"), "".join(cell["source"]))
    return "\n\n".join(
        f'<img src="data:image/png;base64,{output["data"]["image/png"].strip()}" '
        f'alt="{html.escape(output["metadata"]["image/png"]["alt"])}">'
        for output in cell["outputs"] if "image/png" in output.get("data", {}))


def joined(parts, sentence):
    """A section's parts and its sentence -> its slides, in Markdown. What answers a guess comes on
    the next slide, and what is to be done stands on the slide of what it draws.
    """
    parts.insert(bool(parts) and parts[0].startswith(GUESS), f"**{sentence}**" if sentence else "")
    slides = parts[:1]
    for part in parts[1:]:
        is_full = PICTURE in slides[-1] or GUESS in slides[-1] or slides[-1].count("\n\n") > 2
        if is_full and not part.startswith(TASKS):
            slides.append(part)
        else:
            slides[-1] += "\n\n" + part
    return slides


def numbered(tex, options):
    """A formula as MathML, with its number."""
    shown = formula(TAG.sub("", tex), options["display_mode"])
    return shown + "".join(f"<small>({number})</small>" for number in TAG.findall(tex))


def coded(path):
    return base64.b64encode(path.read_bytes()).decode()
