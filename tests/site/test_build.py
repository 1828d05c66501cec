"""The site's build: the site is whole, or the one before."""
import build


def test_a_build_that_fails_leaves_the_site_that_was_there(tmp_path, monkeypatch):
    """A dead link in a draft, and the last good site is gone; or the second try says nothing."""
    monkeypatch.setattr(build, "WORK", tmp_path / "work")
    monkeypatch.setattr(build, "TARGET", tmp_path / "site")
    monkeypatch.setattr(build, "SITE", tmp_path)
    (tmp_path / "conf.py").write_text('extensions = ["myst_parser"]\n')

    def made(text):
        def write(folder, extra, python):
            for part in folder, extra:
                part.mkdir(parents=True)
            (folder / "index.md").write_text(text)
        monkeypatch.setattr(build, "write_sources", write)
        return build.make(), (tmp_path / "site" / "index.html").read_text()

    _, before = made("# Home")
    assert "Home" in before
    for _ in range(2):
        status, after = made("# Draft\n\n[dead](nowhere.md)")
        assert status != 0 and after == before
