"""Makes the web site: writes the sources of its pages to out/site-source, then runs Sphinx.

    python3 -m course site            the site in out/site; lectures are shown as they are saved
    python3 -m course site --serve    and opens it in the browser
    python3 -m course site --lite     and with JupyterLite: the labs in the browser
"""
import contextlib
import functools
import http.server
import shutil
import sys
import webbrowser
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1]))  # after this folder, for the course

from pages import benchmarks, front, instructors, labs, lectures, sources, texts_links
from sphinx.cmd.build import build_main

from course.given.places import ROOT, out, shown_path

SITE = ROOT / "site"
SOURCE, TARGET = out("site-source", "pages"), out("site")
EXTRA = SOURCE.parent / "extra"  # files that go to the site as they are


def write_sources(lite):
    """All pages, as Sphinx reads them, and the files beside them."""
    for part in labs, sources:
        part.write(SOURCE)
    for part in lectures, benchmarks, instructors:
        part.write(SOURCE, EXTRA)
    front.write(SOURCE, EXTRA, lite)
    texts_links.write(SOURCE, lite)


def make():
    """-> Sphinx's exit status. A warning is an error: a link that leads nowhere, say."""
    return build_main(["-b", "html", "-j", "auto", "-q", "--fail-on-warning", "--keep-going",
                       "-c", str(SITE), "-d", str(SOURCE.parent / "doctrees"),
                       "-D", f"html_extra_path={EXTRA}", str(SOURCE), str(TARGET)])


def serve():
    """Show the site in the browser, until Ctrl-C."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(TARGET))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        address = f"http://127.0.0.1:{server.server_port}"
        print(f"The site is at {address} until you press Ctrl-C.")
        webbrowser.open(address)
        with contextlib.suppress(KeyboardInterrupt):
            server.serve_forever()


def main(options):
    for folder in SOURCE.parent, TARGET:
        shutil.rmtree(folder, ignore_errors=True)
    write_sources("--lite" in options)
    status = make()
    if status:
        return status
    if "--lite" in options:
        from pages import lite  # needs more packages
        lite.write(TARGET / "lite")
    print(f"The site is in {shown_path(TARGET)}. Its figures need a server: "
          "python3 -m course site --serve")
    if "--serve" in options:
        serve()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
