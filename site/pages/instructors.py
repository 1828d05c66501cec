"""The instructor's guide and the errata: texts of the repository, with the site's links."""
from pages import texts_links

TEXTS = {"instructors.md": "course/grading/README.md", "errata.md": "notebooks/errata.md"}


def write(folder):
    """Write folder/instructors.md and folder/errata.md."""
    found = texts_links.pages()
    for name, source in TEXTS.items():
        path = texts_links.ROOT / source
        text = path.read_text(encoding="utf-8")
        place = path.parent.relative_to(texts_links.ROOT)
        (folder / name).write_text(texts_links.mapped(text, place, found), encoding="utf-8")
