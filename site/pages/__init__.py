"""What writes the pages of the web site from what the course holds, and what extends Sphinx."""
import contextlib
import functools
import html
import http.server
import io
import threading

from PIL import ImageSequence

from labkit.places import write_whole


def put(path, content):
    """Write a text, or bytes, and the folders that lead there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, content.encode("utf-8") if isinstance(content, str) else content)


def picture(file, words, width, height, more=""):
    """An <img>, which is loaded when the reader comes near. more: further attributes."""
    return (f'<img src="{file}" alt="{html.escape(words)}" width="{width}" height="{height}" '
            f'loading="lazy" decoding="async"{more}>')


def webp(folder, name, opened):
    """Write an opened picture or film to name.webp, without loss, a third smaller than as a PNG ->
    how many frames it has. A film's first one, what it comes to, is name_still.webp, too.
    """
    frames = [frame.convert("RGB") for frame in ImageSequence.Iterator(opened)]
    times = [frame.info.get("duration", 0) for frame in ImageSequence.Iterator(opened)]
    files = {name: frames, f"{name}_still": frames[:1]} if len(frames) > 1 else {name: frames}
    for file, (first, *others) in files.items():
        made = io.BytesIO()
        first.save(made, "WEBP", lossless=True, quality=50, method=3, append_images=others,
                   save_all=bool(others), duration=times[:len(others) + 1], loop=0)
        put(folder / f"{file}.webp", made.getvalue())
    return len(frames)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@contextlib.contextmanager
def served(folder):
    """-> the address at which this folder's files are served."""
    handler = functools.partial(Quiet, directory=str(folder))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()
