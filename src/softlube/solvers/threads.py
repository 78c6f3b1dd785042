"""One thread for the linear algebra: the matrices of a contact are too small to share out among several.

On a machine that is busy, threads that wait for each other make a solution six times slower.
"""

from __future__ import annotations

import scipy.linalg  # noqa: F401  it loads SciPy's library beside NumPy's, and both must be known
from threadpoolctl import ThreadpoolController

one_thread = ThreadpoolController().wrap(limits=1, user_api="blas")
"""Decorator of a function during which the linear algebra of the process has one thread."""
