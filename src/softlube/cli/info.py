"""``softlube info``: what a report of a fault should say.  Heavy imports live inside."""

from __future__ import annotations

from typing import Annotated, Any

from cyclopts import Parameter

PACKAGES = ("numpy", "scipy", "xarray", "h5py", "matplotlib", "pandas", "cyclopts", "rich", "threadpoolctl")
"""Packages whose versions matter."""


def info(*, as_json: Annotated[bool, Parameter(name="--json", negative=())] = False) -> int:
    """Show versions, processors, threads of the linear algebra, and the cache of curves: paste it into a report of a fault.

    Parameters
    ----------
    as_json
        Print one JSON object and nothing else.
    """
    found = _found()
    if as_json:
        import json

        print(json.dumps(found), flush=True)
        return 0
    for name, value in found.items():
        text = ", ".join(f"{key} {each}" for key, each in value.items()) if isinstance(value, dict) else value
        print(f"{name}: {text}")
    return 0


def _found() -> dict[str, Any]:
    """What is printed, in plain values."""
    import os
    import platform
    from importlib.metadata import PackageNotFoundError, version

    import numpy  # noqa: F401  its library is asked for its threads
    import scipy.linalg  # noqa: F401  likewise
    from threadpoolctl import threadpool_info

    import softlube
    from softlube.files.cache import Cache

    versions = {}
    for name in PACKAGES:
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            versions[name] = "not installed"
    kept = Cache()
    usage = kept.usage()
    return {
        "softlube": softlube.__version__,
        "python": platform.python_version(),
        "system": platform.platform(),
        "processors": os.cpu_count(),
        "packages": versions,
        "threads": {str(each["internal_api"]): each["num_threads"] for each in threadpool_info()},
        "cache": {"folder": str(kept.folder), "entries": usage.entries, "MB": round(usage.size / 1e6, 1)},
    }
