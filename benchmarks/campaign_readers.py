"""Malformed input for every reader: texts with units, tables, histories, plans, NetCDF files, stores, and whole commands.

A reader takes an input or refuses it in one printable line of at most 300 characters.  What is taken is compared with what
the input was made of.
"""

from __future__ import annotations

import io
import math
import os
import re
import sqlite3
import subprocess
import sys
import time
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from contextlib import closing
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import h5py
import numpy as np

import softlube
from softlube.errors import InputError, printable
from softlube.experiments.measurements import read_measurements
from softlube.files import netcdf, transient
from softlube.files.histories import read_history
from softlube.physical.inputs import declared
from softlube.sweeps.plan import read_plan

Verdict = tuple[str, str] | tuple[str, str, float]

UNITS = {
    "m": {"m": 1, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9, "cm": 1e-2, "in": 0.0254, "metres": 1},
    "s": {"s": 1, "ms": 1e-3, "min": 60, "h": 3600},
    "m/s": {"m/s": 1, "mm/s": 1e-3, "um/s": 1e-6, "m s^-1": 1, "mm/min": 1e-3 / 60},
    "N": {"N": 1, "mN": 1e-3, "uN": 1e-6, "kgf": 9.80665, "dyn": 1e-5},
    "Pa": {"Pa": 1, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "bar": 1e5, "N/mm^2": 1e6},
    "1/Pa": {"1/Pa": 1, "GPa^-1": 1e-9, "1/MPa": 1e-6},
    "Pa s": {"Pa s": 1, "mPa s": 1e-3, "cP": 1e-3, "P": 0.1, "kg/(m s)": 1},
    "kg/m^3": {"kg/m^3": 1, "g/cm^3": 1e3, "kg m^-3": 1},
}
"""Factors to SI that a unit has, by hand."""
HOSTILE = (
    *(
        "",
        " ",
        "nan",
        "inf",
        "-inf",
        "1e999 m",
        "1e-999 m",
        "1e300",
        "9" * 5000,
        "1" + "0" * 400 + " mm",
        "\0",
        "2\0 mm",
        "\x1b[2J",
    ),
    *(
        "[" * 900 + "]" * 900,
        "{" * 300,
        "2 mm\n3 mm",
        "1_000 mm",
        "2 mm mm",
        "٣ mm",
        "½ mm",
        "0x10 mm",
        "1e5e5 m",
        "- mm",
        "m",
        "mm 2",
    ),
    *(
        "$x$ mm",
        "2 <b>mm</b>",
        "%s mm",
        "2 m" + "/s" * 40,
        "2 " + "m " * 45,
        "2 " + "(" * 90,
        "2 m^999",
        "2 m^-9",
        "2 kg/m/s/m",
        "\ud800",
    ),
)
"""Texts that are no quantities, nor parts of a file."""
OBJECTS: tuple[Callable[[], Any], ...] = (
    lambda: float("nan"),
    lambda: -math.inf,
    lambda: 10**5000,
    lambda: 1e300,
    lambda: 5e-324,
    lambda: nested(900),
    lambda: {"a": nested(900)},
    lambda: np.array([1.0, 2.0]),
    lambda: np.array("text"),
    lambda: True,
    lambda: 1j,
    lambda: b"2 mm",
    lambda: object(),
)
"""Things of Python that are no quantities."""


def nested(depth: int) -> list[Any]:
    """A list in lists."""
    made: list[Any] = []
    for _ in range(depth):
        made = [made]
    return made


def tried(read: Callable[[], str | None]) -> Verdict:
    """Read, or be refused in one line; `read` says what is wrong with what it has taken."""
    try:
        wrong = read()
    except InputError as error:
        message = str(error)
        if len(message) > 300 or not message.isprintable():
            return "WRONG", f"message: {message[:400]!r}"
        return "refused", message
    return ("WRONG", wrong) if wrong else ("taken", "")


def mutated(rng: Random, text: str) -> str:
    """A text with some characters changed, or a hostile text in it."""
    for _ in range(rng.choice([1, 1, 2, 5])):
        place = rng.randrange(len(text) + 1)
        kind = rng.random()
        if kind < 0.35:
            text = text[:place] + rng.choice("0123456789.,;-+eE_ \t\n\"'[](){}/#=\0\x1b$µ²%\u2028") + text[place:]
        elif kind < 0.6:
            text = text[:place] + text[place + rng.choice([1, 1, 3, 20]) :]
        elif kind < 0.8:
            text = text[:place] + rng.choice(HOSTILE) + text[place:]
        else:
            end = min(len(text), place + rng.randrange(30))
            text = text[:place] + text[place:end] * rng.choice([2, 3, 50]) + text[end:]
    return text


# --- texts ------------------------------------------------------------------------------------------------------------


def text(seed: int, number: int, folder: Path) -> Verdict:
    """A quantity as a text, sound or not, or something else in its place."""
    rng = Random(f"{seed} text {number}")
    known = rng.choice([each for each in declared().values() if each.unit in UNITS])
    unit, factor = rng.choice(list(UNITS[known.unit].items()))
    digits = rng.choice(["2", "0.5", "1e-3", "12.75", ".25", "3,5", "-1", "0", "7E2"])
    made = f"{digits}{' ' if unit[0] == '1' else rng.choice([' ', '', '  '])}{unit}"
    sound, kind = float(digits.replace(",", ".")) * factor, rng.random()
    given: Any = made
    if kind > 0.85:
        given = rng.choice(OBJECTS)()
    elif kind > 0.7:
        given = rng.choice(HOSTILE)
    elif kind > 0.2:
        given = mutated(rng, made)

    def read() -> str | None:
        value = known.read(given)
        if isinstance(given, str) and given != made:
            # Read once more in another way: the longest number in front, and a unit known by hand.
            front = re.match(r"\s*([+\-−–]?[0-9]*[.,]?[0-9]*(?:[eE][+-]?[0-9]+)?)\s*(.*?)\s*$", given)
            again = UNITS[known.unit].get(front[2]) if front and "1/" not in given else None  # 21/MPa: 21 over MPa
            expected = (
                None if again is None or front is None else float(re.sub("[−–]", "-", front[1]).replace(",", ".")) * again
            )
        else:
            expected = sound if given == made else float(given)
        if expected is not None and not math.isclose(value, expected, rel_tol=1e-12):
            return f"{given!r} was read as {value!r} and is {expected!r} {known.unit}"
        return None if math.isfinite(value) and abs(value) < 1e31 else f"{given!r} was read as {value!r}"

    return tried(read)


# --- tables -----------------------------------------------------------------------------------------------------------


def _lines(rng: Random, header: str, rows: list[str]) -> tuple[str, set[int]]:
    """A table with some lines changed, and which; the header is line 1."""
    lines, changed = [header, *rows], set()
    for _ in range(rng.choice([1, 1, 2])):
        line = rng.choice([0, rng.randrange(len(lines))])
        changed.add(line + 1)
        if rng.random() < 0.4:
            cells = re.split("([,;\t])", lines[line])
            cells[2 * rng.randrange((len(cells) + 1) // 2)] = rng.choice(HOSTILE)
            lines[line] = "".join(cells)
        else:
            lines[line] = mutated(rng, lines[line])
    return "\n".join(lines) + "\n", changed


def _written(rng: Random, path: Path, content: str) -> None:
    raw = content.encode(rng.choice(["utf-8", "utf-8", "utf-8-sig", "utf-16"]), "surrogatepass")
    if rng.random() < 0.1:
        place = rng.randrange(len(raw))
        raw = raw[:place] + rng.randbytes(3) + raw[place:]
    path.write_bytes(raw)


def table(seed: int, number: int, folder: Path) -> Verdict:
    """Measured friction."""
    rng = Random(f"{seed} table {number}")
    loads, speeds = [rng.uniform(1, 100) for _ in range(8)], [rng.uniform(0.1, 10) for _ in range(8)]
    mark = rng.choice([", ", ";", "\t"])
    rows = [mark.join((f"{load!r}", f"{speed!r}", "1.5")) for load, speed in zip(loads, speeds, strict=True)]
    content, changed = _lines(rng, mark.join(("load [mN]", "speed [mm/s]", "friction [mN]")), rows)
    _written(rng, folder / "data.csv", content)

    def read() -> str | None:
        found = read_measurements(folder / "data.csv")
        every = np.concatenate([found.load, found.speed, np.abs(found.friction)])
        if not np.all(np.isfinite(every)) or not np.all(found.load > 0):
            return f"{content!r}: not finite"
        if 1 in changed or len(content.splitlines()) != 9:
            return None  # another header may mean other units
        for line, load in zip(found.lines, found.load, strict=True):
            if line not in changed and not math.isclose(load, loads[line - 2] * 1e-3, rel_tol=1e-12):
                return f"line {line} of {content!r} was read as {load!r} N"
        return None

    return tried(read)


def history(seed: int, number: int, folder: Path) -> Verdict:
    """A load or a height against time."""
    rng = Random(f"{seed} history {number}")
    what = rng.choice(["load [mN]", "height (um)", "load"])
    rows = [f"{i * 0.5},{rng.uniform(-5, 50)!r}" for i in range(10)]
    content, _ = _lines(rng, f"time [s],{what}", rows)
    _written(rng, folder / "h.csv", content)

    def read() -> str | None:
        found = read_history(folder / "h.csv")
        sound = found.time[0] == 0 and np.all(np.diff(found.time) > 0) and np.all(np.isfinite(found.values))
        return None if sound else f"{content!r}: {found}"

    return tried(read)


# --- plans ------------------------------------------------------------------------------------------------------------

PLAN = """[sweep]
accuracy = 0.01
combine = "product"
[parameters]
radius = "2 mm"
young_modulus = ["3 MPa", "4 MPa"]
viscosity = 2.0
load = { from = "10 mN", to = "1 N", count = 4, spacing = "log" }
speed = { csv = "speeds.csv", column = "speed" }
"""
VALUES = (
    *(
        "nan",
        "inf",
        "-inf",
        "1e999",
        "9" * 5000,
        "9" * 4000,
        "true",
        "1979-05-27",
        '""',
        "[]",
        "{}",
        "[" * 900 + "]" * 900,
        '["log"]',
    ),
    *(
        '{ csv = "a\\u0000b" }',
        '{ csv = "/dev/zero" }',
        '{ csv = "." }',
        '{ csv = ["a"] }',
        '{ csv = "speeds.csv", column = "x" }',
    ),
    *(
        '{ from = 1.0, to = 2.0, count = 3, spacing = ["log"] }',
        "{ from = 1.0, to = 2.0, count = 1e9 }",
        '{ from = "1 m", to = [1], count = 3 }',
    ),
    *(
        "{ from = -1e308, to = 1e308, count = 9, spacing = 'linear' }",
        "{ from = nan, to = 2.0, count = 3 }",
        "0x7fffffffffffffffffff",
        "'\x1b'",
    ),
)
"""TOML values where others are expected."""


def plan(seed: int, number: int, folder: Path) -> Verdict:
    """A plan of a sweep."""
    rng = Random(f"{seed} plan {number}")
    lines = PLAN.splitlines()
    if rng.random() < 0.5:
        line = rng.choice([1, 2, 4, 5, 6, 7, 8])
        key = rng.choice([lines[line].split(" =")[0], rng.choice(list(declared())), "motion", "beta"])
        lines[line] = f"{key} = {rng.choice(VALUES)}"
        content = "\n".join(lines)
    else:
        content = mutated(rng, PLAN)
    (folder / "speeds.csv").write_text("speed [mm/s]\n0.1\n0.2\n")
    _written(rng, folder / "plan.toml", content)

    def read() -> str | None:
        found = read_plan(folder / "plan.toml")
        numbers = [value for case in found.cases for value in case.inputs.values() if isinstance(value, float)]
        return None if found.cases and all(map(math.isfinite, numbers)) else f"{content!r}: {found.inputs()}"

    return tried(read)


# --- NetCDF -----------------------------------------------------------------------------------------------------------


def prepare() -> None:
    """Make the sound files, before the clock runs."""
    images()
    swept()


@cache
def images() -> dict[str, bytes]:
    """Sound files of several sorts, made in another process, so that the solver's memory does not count as the reader's."""
    with ProcessPoolExecutor(1, get_context("spawn")) as other:
        return other.submit(made_images).result()


def made_images() -> dict[str, bytes]:
    """Sound files of several sorts."""
    warnings.simplefilter("ignore")
    ball = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
    moving = ball | {"speed": "0.1 mm/s"}
    sorts = {
        "load": moving | {"load": "100 mN"},
        "gap": moving | {"indentation": "-1 um"},
        "oil on a layer": moving | {"load": "50 mN", "pressure_viscosity": "1 MPa^-1", "thickness": "1 mm"},
        "no condition": moving | {"load": "100 mN", "cavitation": "none"},
    }
    made = {name: netcdf.contents(softlube.Contact(**each).solve(accuracy=0.03)) for name, each in sorts.items()}
    made["paper"] = netcdf.contents(softlube.solve(beta=10, method="relaxation"))
    film = softlube.squeeze(**ball, load="100 mN", initial_height="100 um", duration="0.1 s", accuracy=0.05)
    made["squeeze"] = transient.contents(film)
    return made


@cache
def sound(name: str) -> Any:
    """What a sound file says."""
    return transient.load(images()[name]) if name == "squeeze" else netcdf.load(images()[name])


def damaged(rng: Random, image: bytes) -> bytes:
    """What disks, networks and editors of bytes do to a file."""
    made = bytearray(image)
    kind = rng.choice(["flip", "flip", "zero", "burst", "cut", "double"])
    for _ in range(rng.choice([1, 1, 3, 20])):
        place = rng.randrange(len(made)) if rng.random() < 0.4 else rng.randrange(min(len(made), 16000))
        if kind == "flip":
            made[place] ^= 1 << rng.randrange(8)
        elif kind == "zero":
            length = rng.choice([8, 64, 512])
            made[place : place + length] = bytes(len(made[place : place + length]))
        elif kind == "burst":
            made[place : place + 8] = rng.randbytes(len(made[place : place + 8]))
    if kind == "cut":
        return bytes(made[: rng.randrange(len(made))])
    return bytes(made * 2) if kind == "double" else bytes(made)


def edited(rng: Random, image: bytes) -> bytes:
    """What a program does that knows HDF5: numbers, attributes, shapes and links that are others."""
    stream = io.BytesIO(image)
    with h5py.File(stream, "r+") as file:
        name = rng.choice([*list(file), *["pressure", "film"] * 20])
        kind = rng.choice(["cell", "cell", "cell", "attribute", "attribute", "gone", "link", "shape", "kind", "large"])
        if kind == "cell":
            values = file[name][()]
            place = tuple(rng.randrange(size) for size in values.shape)
            old = float(values[place])
            file[name][place] = rng.choice([np.nan, np.inf, -1.0, 0.0, 1e6, 1e300, -1e-3, 2 * old, -old, old + 0.1, old * 1.01])
        elif kind == "attribute":
            key = rng.choice([each for each in file.attrs if not each.startswith("_")])
            text = file.attrs[key]
            other = rng.choice(
                [*HOSTILE[:12], "[]", "{}", "[{}]", "null", '{"kind": 3}', "3", 1e300, np.nan, -1.0, np.arange(3.0)]
            )
            if isinstance(text, str) and rng.random() < 0.5:
                other = re.sub(r"[0-9]+", lambda found: rng.choice([found[0], found[0], "-1", "1e9", "NaN", "7"]), text)
            if isinstance(other, str):
                other = np.bytes_(other.encode("utf-8", "replace").replace(b"\0", b"?") or b" ")
            file.attrs[key] = other
        else:
            del file[name]
            if kind == "link":
                file[name] = rng.choice(
                    [h5py.ExternalLink("/etc/passwd", "/a"), h5py.SoftLink("/film"), h5py.SoftLink(f"/{name}")]
                )
            elif kind == "shape":
                file[name] = np.ones(rng.choice([(), (1,), (3, 3), (0,), (2, 2, 2), (500, 500)]))
            elif kind == "kind":
                file[name] = rng.choice(["text", np.arange(5), np.ones(3, complex), np.bool_(True)])
            elif kind == "large":
                file.create_dataset(name, (10**5, 10**6), "f8", chunks=(100, 100), compression="gzip")
    return stream.getvalue()


def netcdf_file(seed: int, number: int, folder: Path) -> Verdict:
    """A file of a solution or of a film in time."""
    rng = Random(f"{seed} netcdf {number}")
    name = rng.choice(list(images()))
    image = (damaged if rng.random() < 0.5 else edited)(rng, images()[name])

    def read() -> str | None:
        if name == "squeeze":
            film, expected = transient.load(image), sound(name)
            same = all(
                np.allclose(film[each], expected[each], rtol=0.5, equal_nan=True) for each in ("film_min", "pressure_max")
            )
            return None if same else "a film in time was changed"
        found, expected = netcdf.load(image), sound(name)
        for each, quantity in expected.quantities.items():
            size = 1e-5 * abs(quantity) + (0 if math.isnan(quantity.error) else quantity.error) + 1e-12
            if not (abs(found.quantities[each] - quantity) <= size or math.isnan(quantity)):
                return f"{name}: {each} was {quantity} and is {found.quantities[each]}"
        near = expected.fields.r <= 2
        for each in ("film", "pressure"):
            one, two = (getattr(of.fields, each)[near] for of in (found, expected))
            if not np.allclose(one, two, rtol=1e-2, atol=1e-3 * np.max(np.abs(two))):
                return f"{name}: {each} was changed by {np.max(np.abs(one - two)):.3g} of {np.max(np.abs(two)):.3g}"
        return None

    return tried(read)


# --- stores -----------------------------------------------------------------------------------------------------------

BETAS = (1.0, 30.0, 1000.0)


@cache
def swept() -> tuple[bytes, str]:
    """A finished store, and the table of its sweep."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "a.sweep"
        table = softlube.sweep({"beta": list(BETAS)}, accuracy=0.1, workers=1, store=path).table
        return path.read_bytes(), table.to_csv(index=False)


SQL = (
    "DROP TABLE outcomes",
    "DROP TABLE claims",
    "DROP TABLE log",
    "PRAGMA user_version = 7",
    "PRAGMA application_id = 7",
    "DELETE FROM outcomes",
    "UPDATE outcomes SET quantities = '{'",
    "UPDATE outcomes SET quantities = replace(quantities, '1', '2')",
    "UPDATE outcomes SET facts = replace(facts, '1', '2')",
    "UPDATE outcomes SET quantities = '[1]'",
    "UPDATE outcomes SET quantities = x'ff00'",
    "UPDATE outcomes SET facts = '{\"beta\": 1e999}'",
    "UPDATE outcomes SET reason = 'too light'",
    "UPDATE outcomes SET status = 'failed'",
    "UPDATE outcomes SET key = lower(hex(randomblob(32)))",
    "ALTER TABLE outcomes DROP COLUMN finished",
    "INSERT INTO claims SELECT key, 'x', 'elsewhere', 1, 1e300 FROM outcomes",
)
"""What may have happened to a store through SQLite itself."""


def store(seed: int, number: int, folder: Path) -> Verdict:
    """A sweep that is taken up again with a damaged store: its table is what it was, or the store is refused unchanged."""
    rng = Random(f"{seed} store {number}")
    image, expected = swept()
    path = folder / "a.sweep"
    if rng.random() < 0.5:
        path.write_bytes(damaged(rng, image))
    else:
        path.write_bytes(image)
        with closing(sqlite3.connect(path)) as connection:
            connection.execute(rng.choice(SQL))
            connection.commit()
    before = path.read_bytes()

    def read() -> str | None:
        try:
            table = softlube.sweep({"beta": list(BETAS)}, accuracy=0.1, workers=1, store=path).table
        except InputError:
            if path.read_bytes() != before:
                return "the refused store was changed"
            raise
        return None if table.to_csv(index=False) == expected else "the table is another one"

    return tried(read)


# --- commands ---------------------------------------------------------------------------------------------------------


def command(seed: int, number: int, folder: Path) -> Verdict:
    """A whole command with one malformed input."""
    rng = Random(f"{seed} command {number}")
    ball = {"--radius": "2 mm", "--young-modulus": "3 MPa", "--viscosity": "2 Pa s", "--speed": "0.1 mm/s", "--load": "100 mN"}
    kind = rng.choice(["option", "option", "number", "flow", "sweep", "fit", "squeeze", "target"])
    hostile = rng.choice([each.replace("\0", "").encode("utf-8", "replace").decode() for each in HOSTILE if len(each) < 6000])
    if kind == "option":
        option = rng.choice(list(ball))
        arguments = ["solve", "--fast", *(part for pair in (ball | {option: hostile}).items() for part in pair)]
    elif kind == "number":
        arguments = [
            *rng.choice([("solve", "--fast", "--beta"), ("curve", "--points"), ("stribeck", "--slide-to-roll")]),
            hostile,
        ]
    elif kind == "flow":
        image = (damaged if rng.random() < 0.5 else edited)(rng, images()["load"])
        (folder / "a.nc").write_bytes(image)
        arguments = ["flow", "--solution", str(folder / "a.nc"), "--plot", str(folder / "a.png")]
    elif kind == "sweep":
        (folder / "speeds.csv").write_text("speed [mm/s]\n-1\n0.2\n")
        (folder / "plan.toml").write_text(PLAN.replace('"2 mm"', rng.choice(VALUES)))
        arguments = ["sweep", str(folder / "plan.toml")]
    elif kind == "fit":
        content, _ = _lines(rng, "load [mN], speed [mm/s], friction [mN]", ["nan,1,2", "1e999,2,3"])
        _written(rng, folder / "data.csv", content)
        arguments = ["fit", str(folder / "data.csv"), "--radius", "2 mm", "--young-modulus", "3 MPa"]
    elif kind == "squeeze":
        (folder / "h.csv").write_text("time [s], load [N]\n0, 1e300\n1, nan\n")
        arguments = [
            "squeeze",
            "--radius",
            "2 mm",
            "--young-modulus",
            "3 MPa",
            "--viscosity",
            "2 Pa s",
            "--history",
            str(folder / "h.csv"),
        ]
    else:
        (folder / "file").write_text("")
        target = rng.choice(
            [("--plot", "a.gif"), ("--plot", "file/a.png"), ("--output", "none/a.nc"), ("--output", "."), ("--plot", "a\x1b.x")]
        )
        arguments = ["solve", "--beta", "1000", target[0], str(folder / target[1])]
    began = time.perf_counter()
    with (folder / "said").open("w+b") as said:
        process = subprocess.Popen(
            [sys.executable, "-m", "softlube", *arguments], stdout=subprocess.DEVNULL, stderr=said, cwd=folder
        )
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        message = said.read().decode("utf-8", "replace")
    seconds, peak = time.perf_counter() - began, usage.ru_maxrss / 1024
    where = f"{arguments} ({seconds:.1f} s, {peak:.0f} MB): {message[:300]!r}"
    if "Traceback" in message or process.returncode < 0:
        return "CRASHED", where, peak
    if process.returncode == 0:
        return "taken", "", peak
    body = message.removesuffix("\n").removeprefix("softlube: ")
    if process.returncode not in (2, 3) or len(body) > 300 or printable(body) != body:
        return "WRONG", f"exit code {process.returncode}, {where}", peak
    return "refused", body, peak
