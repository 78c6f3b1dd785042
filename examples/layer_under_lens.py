"""A layer under a lens
====================

A glass lens with a radius of curvature of 10 mm slides at 5 mm/s over a soft coating (E = 1 MPa) on glass, in glycerol and
water (10 mPa s) under 20 mN. How thick must the coating be before it may be taken for a half-space?
"""

import warnings

import softlube

BALL = {"radius": "10 mm", "young_modulus": "1 MPa", "viscosity": "10 mPa s", "speed": "5 mm/s", "load": "20 mN"}
THICKNESSES = ("5 mm", "2 mm", "1 mm", "0.5 mm", "0.3 mm")

half_space = softlube.Contact(**BALL).solve()
radius = half_space.dimensional["contact_radius"]
print(f"radius of the contact on a half-space: {1e3 * float(radius):.3f} mm")

# %%
# A thickness makes the substrate a layer, bonded to a rigid base. softlube warns how much it differs from a half-space. Here
# the warnings are kept, and the first one is shown.

with warnings.catch_warnings(record=True) as doubts:
    warnings.simplefilter("always", softlube.ValidityWarning)
    layers = {thickness: softlube.Contact(thickness=thickness, **BALL).solve() for thickness in THICKNESSES}
print(doubts[0].message)

# %%
# The lens sinks in less, long before film and friction notice anything. At a thickness of four contact radii the indentation is
# 18 % smaller, the film 0.7 %, and the friction 0.15 %.

names = ("indentation", "film_center", "film_min", "friction_total")
print(f"{'thickness':>9}  {'t/a':>5}", *(f"{name:>15}" for name in names))
changes = {}
for thickness, solution in layers.items():
    changes[thickness] = [float(solution.dimensional[name] / half_space.dimensional[name]) - 1 for name in names]
    ratio = float(thickness.removesuffix(" mm")) * 1e-3 / float(radius)
    print(f"{thickness:>9}  {ratio:5.1f}", *(f"{change:>+15.2%}" for change in changes[thickness]))

# %%
# On 0.3 mm the pressure is higher, and the contact narrower:

figure = layers["0.3 mm"].plot("layer_under_lens.png")
