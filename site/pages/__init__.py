"""What writes the pages of the web site, from what the course holds already."""
from course.given.places import read_whole, write_whole


def put(path, content):
    """Write a file unless it is there already: Sphinx makes anew only what has changed."""
    content = content.encode("utf-8") if isinstance(content, str) else content
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or read_whole(path) != content:
        write_whole(path, content)
