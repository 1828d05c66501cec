"""Links of the course's own texts, made links of the site.

A text in the repository links to files beside it: `[renderers.py](renderers.py)`. What has a page on
the site becomes a link to this page. The name of any other file is left, as code.
"""
import os
import re
from pathlib import Path

from course import exercises

ROOT = Path(__file__).resolve().parents[2]
LINK = re.compile(r"\[([^\[\]]+)\]\(([^()\s]+)\)")


def pages():
    """{file of the repository: its page}, without the page's ending."""
    found = {"README.md": "index", "benchmarks/README.md": "benchmarks",
             "course/grading/README.md": "instructors", "notebooks/errata.md": "errata"}
    lectures = [path.stem for path in sorted((ROOT / "notebooks").glob("[0-9]*.ipynb"))]
    found |= {f"notebooks/{name}.ipynb": f"lectures/{name}" for name in lectures}
    for topics, name in zip(exercises.LABS, lectures[1:], strict=True):
        found |= {f"labs/{topic}.py": f"labs/{name}" for topic in topics}
        found |= {f"reference/{topic}.py": f"reference/{topic}" for topic in topics}
    return found | {f"course/given/{path.name}": f"given/{path.stem}"
                    for path in (ROOT / "course" / "given").glob("[a-z]*.py")}


def mapped(text, folder, found):
    """Markdown of a file in this folder of the repository, its links by found {file: page}."""
    def on_site(match):
        label, target = match.groups()
        if "://" in target or target.startswith("#"):
            return match[0]
        file, _, anchor = os.path.normpath(f"{folder}/{target}").partition("#")
        if file in found:
            return f"[{label}]({found[file]}{'#' * bool(anchor)}{anchor})"
        return label if "`" in label else f"`{label}`"

    return LINK.sub(on_site, text)
