"""The tree of all pages, which stands in the margin of each: a topic's lab and code below it.

An extension of Sphinx, too: "next" leads from lecture to lecture, and from lab to lab.
"""
import re

from labkit import exercises
from labkit.places import ROOT
from labkit.table import WITH_LABS

from .names import lab_page

TREE = """
```{{toctree}}
:hidden:
{caption}
{pages}
```
"""
WHOLE = ["All exercises </labs/index>", "/reference/index", "/given/index", "/benchmarks",
         "/glossary", "/bibliography", "/errata"]
FURTHER = ["/own_pictures", "/real_projects", "/instructors", "/first_week", "/grading"]
HEADING = re.compile(r'"# 0?(\d+[bc]?) ([^:"\\]+)')


def setup(app):
    app.connect("html-page-context", lead_on)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def trees():
    """What stands in the margin of every page."""
    topics = [entry(path.stem) for path in lectures() if not is_sequel(path.stem)]
    for caption, pages in (("Lectures, labs, code", topics), ("The whole", WHOLE),
                           ("Further", FURTHER)):
        yield TREE.format(caption=f":caption: {caption}\n", pages="\n".join(pages))


def below(lecture):
    """What stands below a lecture in the tree: its lab, its sequels, its code."""
    number = int(lecture[:2])
    topics = exercises.LABS[number - 1] if number else ()
    pages = [f"Lab {number} </{lab_page(topics[0])}>"] if topics else []
    pages += [entry(path.stem) for path in lectures()
              if is_sequel(path.stem) and path.stem[:2] == lecture[:2]]
    with_it = [path.stem for topic in topics if topic in WITH_LABS
               for path in sorted(ROOT.glob(WITH_LABS[topic])) if path.stem != "__init__"]
    pages += [f"{topic}.py </reference/{topic}>" for topic in (*topics, *with_it)]
    return "" if is_sequel(lecture) else TREE.format(caption="", pages="\n".join(pages))


def lectures():
    return sorted((ROOT / "notebooks").glob("*.ipynb"))


def is_sequel(lecture):
    """06b_cube_maps is."""
    return lecture[2] in "bc"


def entry(lecture):
    """06b_cube_maps -> its line in the tree: 6b Cube maps."""
    text = (ROOT / "notebooks" / f"{lecture}.ipynb").read_text("utf-8")
    number, name = HEADING.search(text).groups()
    shown = f"{number} {name}" if number.strip("0bc") else name
    return f"{shown} </lectures/{lecture}>"


def lead_on(app, name, _template, context, _tree):
    """Next and previous stay among the lectures, among the labs, among the modules."""
    if "/" in name:
        for way, step in (("prev", 1), ("next", 2)):
            there = near(app.builder.relations, name, step)
            context[way] = there and {
                "link": app.builder.get_relative_uri(name, there),
                "title": app.builder.render_partial(app.env.titles[there])["title"]}


def near(relations, name, step):
    """The page before (1) or after (2) a page in its folder, or None."""
    there = name
    while there := relations.get(there, [None] * 3)[step]:
        if there.rpartition("/")[0] == name.rpartition("/")[0]:
            return there
    return None
