"""A sweep that is killed and resumed
==================================

Thirty-six contacts, and the power fails in the middle. Every finished contact is kept in the store, so the second run solves
only what is left, and the table is the same as if nothing had happened.
"""

import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

import softlube

Path("plan.toml").write_text("""
[sweep]
combine = "product"

[parameters]
radius = "2 mm"
young_modulus = "3 MPa"
viscosity = "2 Pa s"
speed = { from = "25 um/s", to = "1 mm/s", count = 12 }
load = ["20 mN", "60 mN", "200 mN"]
""")
COMMAND = [sys.executable, "-m", "softlube", "sweep", "plan.toml", "--workers", "1"]  # softlube sweep plan.toml --workers 1


# %%
# The store is a database that any SQLite program reads. Ten contacts are solved, then the process is killed, without a chance
# to tidy up:


def solved() -> int:
    """Number of contacts in the store."""
    if not Path("plan.sweep").exists():
        return 0
    with closing(sqlite3.connect("plan.sweep", timeout=10)) as store:
        has_table = store.execute("SELECT 1 FROM sqlite_master WHERE name = 'outcomes'").fetchone()
        return store.execute("SELECT count(*) FROM outcomes").fetchone()[0] if has_table else 0


run = subprocess.Popen(COMMAND)
while solved() < 10 and run.poll() is None:
    time.sleep(0.05)
run.kill()
run.wait()
kept = solved()
print(f"{kept} contacts are in the store; is there a table? {Path('plan-results.csv').exists()}")

# %%
# The same command again takes it up:

second = subprocess.run(COMMAND, capture_output=True, text=True, check=True)
print(second.stdout)

# %%
# A run that was never killed gives the same table, to the last digit:

table = pd.read_csv("plan-results.csv")
whole = softlube.sweep("plan.toml", store="whole.sweep", workers=1)
whole.save("whole.csv")
print("same table:", Path("whole.csv").read_bytes() == Path("plan-results.csv").read_bytes())
print(table[["speed [m/s]", "load [N]", "film_min [m]", "film_min_error [m]", "friction_coefficient"]].iloc[::12].to_string())

# %%
# What was swept: the minimum film against the speed.

figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
for (load, rows), style in zip(table.groupby("load [N]"), ("-", "--", ":"), strict=True):
    axes.loglog(1e3 * rows["speed [m/s]"], 1e9 * rows["film_min [m]"], style, label=f"{1e3 * load:g} mN")
axes.set(xlabel="speed [mm/s]", ylabel="minimum film [nm]")
axes.legend()
figure.savefig("killed_sweep.png")
plt.close(figure)
