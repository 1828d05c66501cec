"""Makes the web site: writes the sources of its pages to out/site-source, then runs Sphinx. And
the lectures' slides, in out/slides.

    python3 -m course site            the site in out/site; lectures are shown as they are saved
    python3 -m course site --serve    and opens it in the browser
    python3 -m course site --python DIR    its exercises run the Pyodide in this folder
    python3 -m course site --stills   and its figures' stills, for the lectures' notebooks

The new site replaces the old one when it is whole.
"""
import contextlib
import shutil
import sys
import threading
import webbrowser
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1]))  # after this folder, for the course

from pages import front, labs, lectures, served, slides, sources, texts_links
from sphinx.cmd.build import build_main

from labkit.places import ROOT, out, shown_path

SITE = ROOT / "site"
WORK, TARGET = out("site-source"), out("site")


def write_sources(folder, extra, python):
    """All pages, as Sphinx reads them, and to extra the files beside them."""
    sources.write(folder)
    labs.write(folder, extra, python)
    for part in lectures, front, texts_links:
        part.write(folder, extra)
    slides.write(out("slides"))


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
    with served(TARGET) as address, contextlib.suppress(KeyboardInterrupt):
        print(f"The site is at {address} until you press Ctrl-C.")
        webbrowser.open(address)
        threading.Event().wait()


def make(python=None):
    """-> exit status. Unless it is 0, the site is the one before. python: a folder with Pyodide,
    which the site gets a copy of.

    A warning of Sphinx is an error: a link that leads nowhere, say.
    """
    shutil.rmtree(WORK, ignore_errors=True)
    pages, extra, html = (WORK / name for name in ("pages", "extra", "html"))
    write_sources(pages, extra, python)
    status = build_main(["-b", "html", "-j", "auto", "-q", "--keep-going", "--fail-on-warning",
                         "-c", str(SITE), "-d", str(WORK / "doctrees"), str(pages), str(html)])
    if status:
        return status
    publish([html, extra], TARGET)
    return 0


def main(options):
    python = options[options.index("--python") + 1] if "--python" in options else None
    status = make(python)
    if not status:
        print(f"The site is in {shown_path(TARGET)}. Its figures need a server: "
              "python3 -m course site --serve")
        if "--stills" in options:
            import stills  # needs a browser
            stills.write(TARGET)
        if "--serve" in options:
            serve()
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
