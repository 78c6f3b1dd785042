"""When is the parabola good enough?  Contacts of a true sphere against those of its paraboloid under one load, as a table.

    python benchmarks/true_sphere.py [--accuracy 3e-4]

Both are solved under one load and speed.  a is the radius of the paraboloid's dry contact.  After a change by solution stands
the one that the law of the Hertz limit tells (`softlube.physical.indenter_effect`), with its error.
"""

from __future__ import annotations

import argparse
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import softlube
from softlube.model.dry import dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.indenters import SphereShape
from softlube.model.substrates import HalfSpaceKernel
from softlube.physical.indenter_effect import LAW_ERROR
from softlube.theory import profiles

LAWS = {"film_center": "film at the centre", "film_min": "minimum film", "friction_contact": "shear on the ball, r ≤ a"}
OTHERS = {"pressure_max": "largest pressure", "friction_total": "total friction, r ≤ 2a"}


def main() -> None:
    """Solve the contacts and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accuracy", type=float, default=3e-4)
    accuracy = parser.parse_args().accuracy
    plain = dry_contact_at(HalfSpaceKernel(), load=HERTZ_LOAD)
    print("| a/R | β by the load | depth of the dry contact | " + " | ".join([*LAWS.values(), *OTHERS.values()]) + " |")
    print("|---|---|---|---|---|---|---|---|")
    for share in (0.05, 0.1, 0.2, 0.3, 0.5):
        true = SphereShape(share**2, 1.0)
        dry = dry_contact_at(HalfSpaceKernel(), load=HERTZ_LOAD, indenter=true)
        for beta in (1e2, 1e3, 1e5):
            own, other = (softlube.solve(beta_load=beta, indenter=each, accuracy=accuracy) for each in (true, None))
            cells = []
            for name in (*LAWS, *OTHERS):
                # On equal grids most of the errors are the same, and the difference has a small part of them.
                change = own.quantities[name] / other.quantities[name] - 1
                cell = f"{100 * change:+.2g} %"
                if name in LAWS and beta >= 300:
                    law = getattr(profiles, name)
                    terms = (1,) if name == "film_center" else ()
                    told = float(law(dry, beta, *terms) / law(plain, beta, *terms)) - 1
                    cell += f" ({100 * told:+.2g} ± {100 * LAW_ERROR * beta**-0.2 * abs(told):.1g})"
                cells.append(cell)
            depth = f"{100 * (dry.indentation / plain.indentation - 1):+.2g} %"
            print(f"| {share:g} | 10^{len(str(int(beta))) - 1} | {depth} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
