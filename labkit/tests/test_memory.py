"""Freed arrays stay with the course's own processes, on Linux with glibc."""
import platform
import subprocess
import sys

import pytest

from labkit import places

FREED = """
import numpy as np
from labkit import memory
{hold}
def resident():
    return int(open("/proc/self/statm").read().split()[1]) * 4096
before = resident()
array = np.ones(8_000_000)
del array
print(resident() - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="nothing changes elsewhere")
@pytest.mark.parametrize(("hold", "megabytes"), [("", (0, 8)), ("memory.hold()", (56, 72))])
def test_freed_memory_is_held(hold, megabytes):
    """The numbers of mallopt are wrong: it takes any, and does nothing."""
    told = subprocess.run([sys.executable, "-c", FREED.format(hold=hold)], cwd=places.ROOT,
                          capture_output=True, text=True, check=True).stdout
    assert megabytes[0] <= int(told) / 1e6 <= megabytes[1]
