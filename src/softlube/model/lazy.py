"""Modules that are imported when they are first used: the command line lists the inputs of liquids without loading NumPy."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

readers: dict[str, Any] = {}
"""Readers of files by the input whose file they read.  This room reads none: the package gives it the readers."""

if TYPE_CHECKING:
    import numpy as numpy
else:

    class _Lazy(ModuleType):
        """Stands for a module until one of its names is asked for."""

        def __getattr__(self, name: str) -> Any:
            value = getattr(import_module(self.__name__), name)
            setattr(self, name, value)
            return value

    numpy = _Lazy("numpy")
