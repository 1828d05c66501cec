"""Makes the web site: writes its pages' sources to out/site-source, and lets Sphinx make out/site.

    python3 -m course site            the site, from what the course holds; nothing is run
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

from pages import benchmarks, front, instructors, labs, lectures, put, sources, texts_links
from sphinx.cmd.build import build_main

from course.given.places import ROOT, out

SITE = ROOT / "site"
SOURCE, TARGET = out("site-source", "pages"), out("site")
EXTRA = SOURCE.parent / "extra"  # files that go to the site as they are


def write_sources(lite):
    """All pages, as Sphinx reads them, and the files beside them."""
    for part in labs, sources, instructors:
        part.write(SOURCE)
    for part in lectures, benchmarks:
        part.write(SOURCE, EXTRA)
    front.write(SOURCE, EXTRA, lite)
    texts_links.write(SOURCE, lite)
    for name in "three.min.js", "three.LICENSE":
        put(EXTRA / "_static" / "vendor" / name, (SITE / "vendor" / "three" / name).read_bytes())


def make():
    """-> Sphinx's exit status. A warning is an error: a link that leads nowhere, say."""
    return build_main(["-b", "html", "-j", "auto", "-q", "--fail-on-warning", "--keep-going",
                       "-c", str(SITE), "-d", str(SOURCE.parent / "doctrees"),
                       "-D", f"html_extra_path={EXTRA}", str(SOURCE), str(TARGET)])


def serve(port=8000):
    """Show the site in the browser, until Ctrl-C."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(TARGET))
    with http.server.ThreadingHTTPServer(("127.0.0.1", port), handler) as server:
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
    if status == 0 and "--lite" in options:
        from pages import lite  # needs more packages
        lite.write(TARGET / "lite")
    if status == 0:
        print(f"The site is in {TARGET.relative_to(ROOT)}. Its figures need a server: "
              "python3 -m course site --serve")
    if "--serve" in options:
        serve()
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
