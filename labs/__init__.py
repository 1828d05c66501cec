"""Your copy of the code: every exercise is yours to write. Start with transforms.

Modules with nothing to write stand in course/complete and in course/fast, and are imported from
here, too.
"""
from pathlib import Path

__path__ += [str(Path(__file__).parents[1] / "course" / folder) for folder in ("complete", "fast")]
