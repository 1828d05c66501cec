"""python3 -m labkit: the commands of a course that has no others."""
import sys

from .cli import main

sys.exit(main())
