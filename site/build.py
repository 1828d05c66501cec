"""Makes the web site: writes the sources of its pages to out/site-source, then runs Sphinx.

    python3 -m course site            the site in out/site; lectures are shown as they are saved
    python3 -m course site --serve    and opens it in the browser
    python3 -m course site --lite     and with JupyterLite: the labs in the browser

Sphinx reads again only what has changed, and all pages after a change of the site's own code. The
new site replaces the old one when it is whole.
"""
import contextlib
import filecmp
import functools
import http.server
import shutil
import sys
import webbrowser
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1]))  # after this folder, for the course

from pages import benchmarks, front, labs, lectures, sources, texts_links
from sphinx.cmd.build import build_main

from course.given.places import ROOT, out, shown_path

SITE = ROOT / "site"
WORK, TARGET = out("site-source"), out("site")


def write_sources(folder, extra, lite):
    """All pages, as Sphinx reads them, and to extra the files beside them."""
    for part in labs, sources:
        part.write(folder)
    benchmarks.write(folder, extra)
    for part in lectures, front, texts_links:
        part.write(folder, extra, lite)


def bring_in_step(folder, new):
    """Make a folder's files those of another, touching only those that differ.

    -> whether the same files are there as before.
    """
    names = [{path.relative_to(root) for path in root.rglob("*") if path.is_file()}
             for root in (folder, new)]
    for name in names[0] - names[1]:
        (folder / name).unlink()
    for name in names[1]:
        if name not in names[0] or not filecmp.cmp(folder / name, new / name, shallow=False):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(new / name, folder / name)
    return names[0] == names[1]


def code_is_newer(file):
    """-> whether the site's own code has changed since a file was written."""
    return file.exists() and file.stat().st_mtime < max(
        path.stat().st_mtime for path in SITE.rglob("*.py"))


def publish(parts, target):
    """The files of these folders, together, replace the site."""
    new, old = (target.with_name(f"{target.name}-{age}") for age in ("new", "old"))
    for folder in new, old:
        shutil.rmtree(folder, ignore_errors=True)
    for part in parts:
        shutil.copytree(part, new, dirs_exist_ok=True,
                        ignore=shutil.ignore_patterns("_sources", ".buildinfo*"))
    if target.exists():
        target.rename(old)
    new.rename(target)
    shutil.rmtree(old, ignore_errors=True)


def serve():
    """Show the site in the browser, until Ctrl-C."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(TARGET))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        address = f"http://127.0.0.1:{server.server_port}"
        print(f"The site is at {address} until you press Ctrl-C.")
        webbrowser.open(address)
        with contextlib.suppress(KeyboardInterrupt):
            server.serve_forever()


def make(lite):
    """-> exit status. Unless it is 0, the site is the one before.

    A warning of Sphinx is an error: a link that leads nowhere, say.
    """
    pages, new, extra, html, read = (WORK / name for name in (
        "pages", "new", "extra", "html", "doctrees"))
    for folder in new, extra:
        shutil.rmtree(folder, ignore_errors=True)
    write_sources(new, extra, lite)
    if not bring_in_step(pages, new) or code_is_newer(read / "environment.pickle"):
        for folder in html, read:  # pages that are no more, or as older code made them
            shutil.rmtree(folder, ignore_errors=True)
    status = build_main(["-b", "html", "-j", "auto", "-q", "--keep-going", "--fail-on-warning",
                         "-c", str(SITE), "-d", str(read), str(pages), str(html)])
    if status:  # what Sphinx has read it does not read again, and would say nothing of the fault
        shutil.rmtree(read, ignore_errors=True)
        return status
    if lite:
        from pages import lite as jupyter_lite  # needs more packages
        jupyter_lite.write(extra / "lite")
    publish([html, extra], TARGET)
    return 0


def main(options):
    status = make("--lite" in options)
    if not status:
        print(f"The site is in {shown_path(TARGET)}. Its figures need a server: "
              "python3 -m course site --serve")
        if "--serve" in options:
            serve()
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
