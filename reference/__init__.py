"""The complete code, one module per lecture topic. Start with transforms.

Modules with nothing to write are no files of labs/. They stand once, in course/complete and in
course/fast, and are imported from here as from labs: what they import in turn is of that package.
"""
from pathlib import Path

__path__ += [str(Path(__file__).parents[1] / "course" / folder) for folder in ("complete", "fast")]
