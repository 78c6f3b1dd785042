"""The command line: its commands, what it says of a wrong input, and its exit codes.

Heavy modules are imported inside the commands, so that ``--help`` answers at once.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from cyclopts import App, CoercionError, CycloptsError, UnknownOptionError

EXIT_INPUT = 2
EXIT_NOT_CONVERGED = 3
EXIT_SYSTEM = 1
EXIT_BROKEN_PIPE = 141


def _version() -> str:
    from softlube import __version__

    return __version__


app = App(
    name="softlube",
    help="Lubricated sliding of a sphere on a soft elastic substrate: film, pressure and friction, with error bars.",
    version=_version,
)

# A module for each command, which is imported when the command is called.
app.command(
    "softlube.cli.solve:solve",
    name="solve",
    help="""Solve one contact and print film thickness, pressure and friction with their errors.

    Give --radius, --viscosity, --speed or --entrainment-speed, one of --young-modulus and --shear-modulus, and one of --load
    and --indentation; or --beta (or --beta-load) alone for the dimensionless problem.""",
)
app.command(
    "softlube.cli.line:line",
    name="line",
    help="""Solve one line contact, a cylinder under a load per length, and print film, pressure and friction.

    Give --radius, --viscosity, --speed or --entrainment-speed, one of --young-modulus and --shear-modulus, and
    --load-per-length; or --beta-load alone for the dimensionless problem.""",
)
app.command("softlube.cli.sweep:sweep", name="sweep", help="Solve many contacts or squeeze films; every finished one is kept.")
app.command("softlube.cli.stribeck:stribeck", name="stribeck", help="Film and friction against speed and Hersey number.")
app.command("softlube.cli.fit:fit", name="fit", help="Fit viscosity, modulus or offset to measured friction.")
liquid = App(name="liquid", help="Liquids from measurements: the law of a thinning liquid from a rheometer's viscosities.")
liquid.command("softlube.cli.liquid:fit", name="fit", help="Fit the law of a thinning liquid to viscosities and shear rates.")
app.command(liquid)
substrate = App(name="substrate", help="Substrates from measurements: the Prony series of a viscoelastic solid.")
substrate.command("softlube.cli.substrate:fit", name="fit", help="Fit a Prony series to moduli or to a creep compliance.")
app.command(substrate)
app.command("softlube.cli.curve:curve", name="curve", help="Print or draw any quantity as a function of β.")
app.command("softlube.cli.calculator:calculator", name="calculator", help="Write a calculator that runs in any browser.")
app.command("softlube.cli.info:info", name="info", help="Show versions, threads and folders, for a report of a fault.")
app.command("softlube.cli.cache:cache", name="cache", help="Show or clear what is kept of computed curves.")
app.command(
    "softlube.cli.reproduce:reproduce",
    name="reproduce",
    help="Draw the paper's figures and report our numbers beside its.",
)
app.command("softlube.cli.flow:flow", name="flow", help="Draw the flow in the gap: streamlines, velocities, wall shear.")
app.command(
    "softlube.cli.squeeze:squeeze",
    name="squeeze",
    help="Press a sphere through a film, or pull it away: film, pressure and load against time; the substrate may creep.",
)
app.command(
    "softlube.cli.completion:install_completion",
    name="--install-completion",
    help="Make the shell complete commands, options and their choices.",
)


# --- entry point ----------------------------------------------------------------------------------------------------


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit code: 0 done, 2 bad input, 3 not converged."""
    import warnings

    from softlube.errors import InputError, NotConvergedError, ValidityWarning

    if arguments is None:
        # One short job: looking for cycles in what the imports make costs more than it frees.
        import gc

        gc.disable()
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a terminal without Greek letters gets question marks, not a crash
            stream.reconfigure(errors="replace")
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # the commands print the doubts themselves
            result = app(
                given,
                exit_on_error=False,
                print_error=False,
                result_action="return_value",
            )
    except UnknownOptionError as error:
        return _complain(_unknown(error, (*given, "")[0]), EXIT_INPUT)
    except CycloptsError as error:
        if isinstance(error.__cause__, InputError):  # of an option that is read as all numbers are
            name = error.token.keyword if isinstance(error, CoercionError) and error.token is not None else None
            return _complain(f"{name}: {error.__cause__}" if name else str(error.__cause__), EXIT_INPUT)
        return _complain(" ".join(str(error).split()) + " See softlube --help.", EXIT_INPUT)
    except InputError as error:
        return _complain(_as_options(str(error)), EXIT_INPUT)
    except NotConvergedError as error:
        return _complain(str(error), EXIT_NOT_CONVERGED)
    except BrokenPipeError:
        # The reader (head, less) has gone; leave quietly, and keep Python from flushing into the closed pipe at exit.
        import os

        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_BROKEN_PIPE
    except OSError as error:
        return _complain(f"{error.filename or 'output'}: {error.strerror or error}", EXIT_SYSTEM)
    return result if isinstance(result, int) else 0


_WITHOUT_MODELS = {
    "reproduce": "the paper's figures are an incompressible half-space's with constant viscosity",
    "sweep": "what is to be solved stands in the plan; give it there",
}
"""Commands that take no other substrate or liquid than the paper's, and why."""


_RENAMED = {("curve", "--csv"): "--output"}
"""Options that have another name since 0.3, by their command."""


def _unknown(error: UnknownOptionError, command: str) -> str:
    """What to say of an option that a command does not have."""
    from softlube.model.parts import vocabulary
    from softlube.physical.inputs import BODIES

    option = (error.token.keyword or error.token.value).split("=")[0]
    if (command, option) in _RENAMED:
        return f"{option}: softlube {command} calls it {_RENAMED[command, option]} since 0.3."
    if command in _WITHOUT_MODELS and option.lstrip("-").replace("-", "_") in vocabulary(BODIES):
        return f"{option}: softlube {command} does not take it, {_WITHOUT_MODELS[command]}."
    return " ".join(str(error).split()) + " See softlube --help."


def _as_options(message: str) -> str:
    """A message that names parameters of Python, with the options of the command line instead."""
    names, colon, rest = message.partition(":")
    parts = names.split(", ")
    if not colon or not all(part.isidentifier() for part in parts):
        return message
    return ", ".join(f"--{part.replace('_', '-')}" for part in parts) + colon + rest


def _complain(message: str, code: int) -> int:
    from softlube.errors import one_line

    print(f"softlube: {one_line(message)}", file=sys.stderr)
    return code
