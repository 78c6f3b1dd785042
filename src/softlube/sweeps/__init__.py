"""Many contacts at once: a plan of cases, a store that loses nothing, and workers here or on a cluster.

    plan (TOML, CSV or Python) ─► cases ─► problems, each once ─► workers ─► store ─► table, NetCDF

Depends on: everything but `cli`.  Another kind of case is a module like `steady`, and a line in `plan.MOTIONS`.  The name is
plural because `softlube.sweep` is the function.
"""

from softlube.sweeps.plan import Plan, read_plan
from softlube.sweeps.run import Sweep, sweep
from softlube.sweeps.store import Store

__all__ = ["Plan", "Store", "Sweep", "read_plan", "sweep"]
