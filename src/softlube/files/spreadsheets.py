"""Spreadsheets as text: the first sheet of an .xlsx or .ods file, a line for each row, cells parted by tabs."""

from __future__ import annotations

import io
from importlib.util import find_spec
from pathlib import Path
from zipfile import BadZipFile, ZipFile

from softlube.errors import InputError

ENGINES = {".xlsx": "openpyxl", ".ods": "odf"}
"""Packages that read the formats, by the ending; the extra "spreadsheets" has them."""
UNREAD = (".xls", ".xlsm", ".xlsb", ".numbers")
"""Endings of spreadsheets that are not read."""
LARGEST = 320_000_000
"""Bytes of a file's parts when they are unpacked: text is packed ten times at most."""


def is_spreadsheet(path: Path) -> bool:
    """Whether a file is a spreadsheet, by its ending."""
    return path.suffix.lower() in (*ENGINES, *UNREAD)


def sheet_text(path: Path, content: bytes) -> str:
    """The first sheet of a spreadsheet as text.

    Parameters
    ----------
    path : Path
        The file, for its ending and for messages.
    content : bytes
        All of the file.

    Raises
    ------
    InputError
        If the format is not read, the package that reads it is not installed, or the file is damaged.
    """
    ending = path.suffix.lower()
    if ending in UNREAD:
        raise InputError(f"{path.name}: {ending} files are not read; save the table as CSV or .xlsx")
    if find_spec(ENGINES[ending]) is None:
        raise InputError(
            f"{path.name}: {ending} files need the extra spreadsheets: pip install 'softlube[spreadsheets]'; "
            "or save the table as CSV"
        )
    import pandas as pd

    try:
        with ZipFile(io.BytesIO(content)) as parts:
            if sum(part.file_size for part in parts.infolist()) > LARGEST:
                raise InputError(f"{path.name}: is larger than {LARGEST:g} bytes when unpacked; thin the table out")
        cells = pd.read_excel(  # type: ignore[no-matching-overload]
            io.BytesIO(content),
            header=None,
            dtype=object,
            na_filter=False,
            engine=ENGINES[ending],
        )
    except InputError:
        raise
    except BadZipFile:
        raise InputError(f"{path.name}: is no spreadsheet, or damaged; save the table as CSV") from None
    except Exception as error:  # whatever the readers make of a damaged file
        raise InputError(f"{path.name}: cannot be read ({error}); save the table as CSV") from None
    return "\n".join("\t".join(" ".join(str(cell).split()) for cell in row) for row in cells.itertuples(index=False))
