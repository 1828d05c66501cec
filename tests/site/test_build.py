"""The site's build: what changes is made anew, and the site is whole or the one before."""

import build
import pytest


@pytest.fixture
def made(tmp_path, monkeypatch):
    """made(**texts): build a site of these pages -> exit status, {file: time of change}."""
    monkeypatch.setattr(build, "WORK", tmp_path / "work")
    monkeypatch.setattr(build, "TARGET", tmp_path / "site")
    monkeypatch.setattr(build, "SITE", tmp_path)
    (tmp_path / "conf.py").write_text('extensions = ["myst_parser"]\n')

    def make(**texts):
        def write(folder, extra, lite):
            for part in folder, extra:
                part.mkdir(parents=True)
            for name, text in texts.items():
                (folder / f"{name}.md").write_text(text)
            (extra / "film.png").write_bytes(b"")
        monkeypatch.setattr(build, "write_sources", write)
        status = build.make(lite=False)
        return status, {path.name: path.stat().st_mtime_ns
                        for path in (tmp_path / "site").glob("*.*")}
    return make


INDEX = "# Home\n\n```{toctree}\none\ntwo\n```\n"


def test_one_letter_changes_one_page(made):
    """Whoever changes a sentence waits for a hundred pages."""
    status, before = made(index=INDEX, one="# One", two="# Two")
    assert status == 0 and {"index.html", "one.html", "two.html", "film.png"} <= before.keys()
    status, after = made(index=INDEX, one="# One\n\nMore.", two="# Two")
    assert status == 0 and after["one.html"] > before["one.html"]
    assert after["two.html"] == before["two.html"]


def test_new_code_makes_all_pages_anew(made, tmp_path):
    """A way to write formulas is changed, and most pages have them as before."""
    _, before = made(index=INDEX, one="# One", two="# Two")
    with (tmp_path / "conf.py").open("a") as file:
        file.write('project = "New"\n')
    _, after = made(index=INDEX, one="# One", two="# Two")
    assert after["one.html"] > before["one.html"]


def test_a_build_that_fails_leaves_the_site_that_was_there(made):
    """A dead link in a draft, and the last good site is gone; or the second try says nothing."""
    _, before = made(index=INDEX, one="# One", two="# Two")
    for _ in range(2):
        status, after = made(index=INDEX, one="# One\n\n[dead](nowhere.md)", two="# Two")
        assert status != 0 and after == before


def test_a_page_that_is_no_more_leaves_the_site(made):
    """A lecture is renamed, and its old page stays on the site for ever."""
    made(index=INDEX, one="# One", two="# Two")
    status, after = made(index=INDEX.replace("two\n", ""), one="# One")
    assert status == 0 and "one.html" in after and "two.html" not in after
