"""What is imported late: the declarations of parts do without NumPy."""

import subprocess
import sys

import numpy as np

from softlube.model import lazy


def test_it_is_the_module():
    assert lazy.numpy.exp is np.exp
    assert vars(lazy.numpy)["exp"] is np.exp


def test_parts_are_known_without_numpy():
    code = "import sys, softlube.physical.inputs; sys.exit('numpy' in sys.modules or 'scipy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
