"""What was computed, kept in the user's cache folder: one file an entry, named by a digest of all that determines its content.

An entry is there whole or not at all, whatever process is killed at whatever time, and processes that work side by side see
each other's entries.  Nothing depends on an entry: where the folder cannot be written to, nothing is kept.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from softlube.errors import InputError
from softlube.files.writing import write_whole

VARIABLE = "SOFTLUBE_CACHE"
"""Environment variable that names another folder."""
LARGEST = 100_000_000
"""Bytes up to which entries are kept; the oldest used go first."""
LEFT = 0.8
"""Part of `LARGEST` that is left when entries have gone."""
ABANDONED = 3600.0
"""Seconds after which a file that a killed process has begun is removed."""


def cache_folder() -> Path:
    """The folder: what SOFTLUBE_CACHE says, else the platform's place for files that can be made again."""
    said = os.environ.get(VARIABLE)
    if said:
        return Path(said)
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local") / "softlube" / "Cache"
    if sys.platform == "darwin":
        return home / "Library" / "Caches" / "softlube"
    return Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache") / "softlube"


@dataclass(frozen=True)
class Usage:
    """How much is kept.

    Attributes
    ----------
    entries : int
    size : int
        Bytes.
    """

    entries: int
    size: int


class Cache:
    """Entries in a folder.

    Parameters
    ----------
    folder : Path, optional
        `cache_folder` if not given; made when the first entry is kept.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or cache_folder()

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.json"

    def get(self, key: str) -> Any:
        """An entry, None if there is none.  It counts as used now."""
        path = self._path(key)
        try:
            found = json.loads(path.read_bytes())
            os.utime(path)
        except (OSError, ValueError):  # none, or one that a failing disk has left incomplete
            return None
        return found

    def put(self, key: str, content: Mapping[str, Any]) -> None:
        """Keep an entry; without effect where the folder cannot be written to."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            write_whole({self._path(key): json.dumps(content).encode()})
        except (InputError, OSError):
            return

    def _files(self) -> list[tuple[Path, os.stat_result]]:
        found = []
        try:
            for each in os.scandir(self.folder):
                if each.name.endswith(".json"):
                    try:
                        found.append((Path(each.path), each.stat()))
                    except OSError:  # removed by another process meanwhile
                        continue
        except OSError:  # no folder, no entries
            return []
        return found

    def usage(self) -> Usage:
        """How much is kept."""
        sizes = [status.st_size for path, status in self._files() if not path.name.startswith(".")]
        return Usage(len(sizes), sum(sizes))

    def trim(self, largest: int = LARGEST) -> None:
        """Remove the entries that were not used for longest, if there are too many, and what killed processes have begun."""
        files = sorted(self._files(), key=lambda item: item[1].st_mtime)
        total, now = sum(status.st_size for _, status in files), time.time()
        bound = LEFT * largest if total > largest else total
        for path, status in files:
            abandoned = path.name.startswith(".") and now - status.st_mtime > ABANDONED
            if abandoned or total > bound:
                _remove(path)
                total -= status.st_size

    def clear(self) -> Usage:
        """Remove every entry; returns how much there was."""
        before = self.usage()
        for path, _ in self._files():
            _remove(path)
        return before


def _remove(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError:
        return
