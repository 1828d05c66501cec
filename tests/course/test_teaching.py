"""What teachers get: its sections are those of the lectures, and its exam has numbers."""
import re
import tomllib

from labkit.places import ROOT
from teaching import exam


def test_a_section_that_is_named_is_there():
    """A heading was written anew: its slide has lost its sentence, or its week what to show."""
    slides = tomllib.loads((ROOT / "teaching" / "slides.toml").read_text("utf-8"))
    for path in (ROOT / "teaching" / "weeks").glob("*.md"):
        name, week = path.stem, path.read_text("utf-8")
        lecture = (ROOT / "notebooks" / f"{name}.ipynb").read_text("utf-8")
        assert sum(map(int, re.findall(r"^\| (\d+) \|", week, re.MULTILINE))) == 90, name
        named = [*slides.pop(name, ()), *re.findall(r"\| \*(.+)\* \|", week)]
        assert [each for each in named if f"## {each}\\n" not in lecture] == [], name
    assert not slides, "slides of no lecture that has a week"


def test_an_exam_has_sixty_points_and_each_seed_its_own_numbers():
    """A name in exam.md that nobody computes; or whoever knows last year's paper knows this one."""
    papers = {exam.paper(seed) for seed in range(20)}
    assert len(papers) == 20
    assert sum(map(int, re.findall(r"\((\d) points\)\*\*", min(papers)))) == 60
    assert not any(re.search(r"nan|inf\b|[{}]", paper) for paper in papers)
