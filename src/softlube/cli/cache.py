"""``softlube cache``: where computed curves are kept, how much there is, and how to be rid of it."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter


def cache(
    *,
    clear: Annotated[bool, Parameter(negative=())] = False,
    as_json: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> int:
    """Show where the contacts behind curves are kept, how many there are and how much room they take.

    They are kept so that a curve that was computed once is there at once. Without them it is computed again; the numbers are
    the same. The environment variable SOFTLUBE_CACHE names another folder.

    Parameters
    ----------
    clear
        Remove them all.
    as_json
        Print one JSON object and nothing else.
    """
    from softlube.files.cache import LARGEST, Cache

    kept = Cache()
    usage = kept.clear() if clear else kept.usage()
    if as_json:
        import json

        content = {"folder": str(kept.folder), "entries": usage.entries, "bytes": usage.size, "largest": LARGEST}
        print(json.dumps(content | {"cleared": clear}), flush=True)
        return 0
    print(f"Folder: {kept.folder}")
    what = f"{usage.entries} solved contacts, {usage.size / 1e6:.3g} MB"
    print(f"Removed: {what}" if clear else f"Kept: {what} of at most {LARGEST / 1e6:.0f} MB (the oldest used go first)")
    return 0
