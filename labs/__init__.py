"""Your copy of the code: every exercise is yours to write. Start with transforms.

Modules with nothing to write stand in course/complete and in course/fast, and are imported from
here, too.
"""
from course.given import places

__path__ += places.of_both()
