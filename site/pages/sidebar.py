"""The tree of all pages, which stands in the margin of each."""
from course import exercises
from course.given.places import ROOT

from .names import lab_page

TREE = """
```{{toctree}}
:hidden:
:caption: {caption}

{pages}
```
"""


def trees(lite):
    """What stands in the margin of every page."""
    lectures = [f"lectures/{path.stem}" for path in sorted((ROOT / "notebooks").glob("*.ipynb"))]
    labs = [lab_page(topics[0]) for topics in exercises.LABS]
    groups = {"Lectures": lectures, "Labs": ["labs/index", *labs],
              "Code": ["reference/index", "given/index", "benchmarks"],
              "More": ["own_pictures", "real_projects", "instructors", "errata", "glossary",
                       "bibliography"]}
    if lite:
        groups["Labs"].append("in_the_browser")
    for caption, pages in groups.items():
        yield TREE.format(caption=caption, pages="\n".join(pages))
