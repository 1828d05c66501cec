"""What writes the pages of the web site, from what the course holds already."""
from course.given.places import write_whole


def put(path, content):
    """Write a text, or bytes, and the folders that lead there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, content.encode("utf-8") if isinstance(content, str) else content)
