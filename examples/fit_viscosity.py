"""Fitting a viscosity
===================

The friction of 72 combinations of load and speed gives the viscosity of the liquid. The data are **synthetic**: made by
``synthetic_friction.py`` from softlube's own solutions with a viscosity of 2 Pa s and 5 % of noise, in the shape of the paper's
experiments, whose numbers are not printed there. The table stands in ``examples/data`` of the repository; run the script in
``examples``.
"""

import softlube

data = softlube.read_measurements("data/synthetic_friction.csv")
fit = softlube.fit(data, radius="2 mm", young_modulus="3 MPa", free=["viscosity"], hold_out=0.2)

viscosity = fit.estimates["viscosity"]
print(
    f"viscosity {viscosity.value:.3f} Pa s, 95 % interval {viscosity.low:.3f} to {viscosity.high:.3f} (synthetic data, truth 2)"
)

# %%
# What the data can tell, and whether they predict the rows left out:

print(*fit.verdicts, sep="\n")

# %%
# The data on the load curve, as in the paper's Fig. 13, and the residuals:

figure = fit.plot("fit_viscosity.png")

# %%
# The viscosity hangs on which friction was measured. The same data, were they counted over another region, or were they the
# whole horizontal force instead of the shear on the sphere:

for (force, region), value in fit.others.items():
    print(f"{force:7} within {region:g} contact radii: {value:.2f} Pa s")

# %%
# Viscosity and modulus together are another matter: friction along a power law fixes one combination of the two.

both = softlube.fit(data, radius="2 mm", young_modulus="3 MPa", free=["viscosity", "modulus"])
print(*both.verdicts, sep="\n")
