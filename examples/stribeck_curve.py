"""A Stribeck curve
================

Friction coefficient and film of a rig against its speed, for three loads, and what changes when both surfaces move.
"""

import softlube
from softlube.plots.experiments import plot_stribeck

rig = softlube.Rig(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s")
table = softlube.stribeck_curve(
    rig, ["20 mN", "60 mN", "200 mN"], slowest="0.2 mm/s", fastest="5 mm/s", points=31, roughness="30 nm"
)
plot_stribeck(table, "stribeck_curve.png")

# %%
# The film grows like the speed to the power 0.6 and the friction to the power 0.4: thicker films shear less, but faster.

columns = ["load [N]", "entrainment_speed [m/s]", "friction_coefficient", "film_min [m]", "lambda_ratio", "lubrication"]
print(table[columns].iloc[::10].to_string(index=False))

# %%
# With both surfaces moving, the film depends on the entrainment speed alone, and the Couette friction on how much of it is
# sliding. In pure rolling only the small rolling part is left, which is opposite on the two surfaces.

speeds = {"slowest": "0.5 mm/s", "fastest": "2 mm/s", "points": 3}
for ratio in (2.0, 0.5, 0.0):
    rows = softlube.stribeck_curve(rig, "60 mN", slide_to_roll=ratio, force="total", **speeds)
    print(f"slide-to-roll ratio {ratio:g}: friction coefficients", *(f"{value:.5f}" for value in rows["friction_coefficient"]))

# %%
# A soft ball on a soft flat is, for the film, a rigid ball on a flat of half the modulus:

both = softlube.Rig(radius="2 mm", young_modulus="3 MPa", ball_young_modulus="3 MPa", viscosity="2 Pa s")
print(f"E* = {rig.reduced_modulus:.3g} Pa with a rigid ball, {both.reduced_modulus:.3g} Pa with a soft one")
