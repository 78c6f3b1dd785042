"""A worn ball
===========

A ball of 2 mm radius has slid for a long time, and wear has made a flat of some 0.6 mm on it. A profilometer has traced it with
a noise of 20 nm. What has become of the film?
"""

import matplotlib.pyplot as plt
import numpy as np

import softlube

R, WORN, NOISE = 2e-3, 22e-6, 20e-9  # radius of the ball, height that is worn off, noise [m]

# %%
# Here the trace is made up: the sphere less its cap, with a border that is rounded over some 0.1 mm.

r = np.linspace(-1e-3, 1e-3, 401)
above = R - np.sqrt(R**2 - r**2) - WORN
z = (above + np.hypot(above, 14e-6)) / 2 + np.random.default_rng(7).normal(0, NOISE, r.size)
rows = [f"{a * 1e3:.4f}, {b * 1e6:.4f}" for a, b in zip(r, z - z.min(), strict=True)]
with open("worn_ball.csv", "w", encoding="utf-8") as file:
    file.write("\n".join(["r [mm], z [um]", *rows]))

# %%
# softlube smooths a profile by a spline that is even about the axis: with the fewest pieces that come as near to the heights as
# a tolerance says. Without a tolerance it finds the noise by itself.

indenter = softlube.Profile("worn_ball.csv")
print(f"smoothed to {indenter.tolerance * 1e9:.1f} nm, reference radius {indenter.reference_radius * 1e3:.2f} mm")

# %%
# The contact takes the profile in place of a radius. `softlube solve --profile worn_ball.csv …` does the same, and says what
# the next coarser smoothing would change.

rest = {"young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}
worn = softlube.Contact(indenter=indenter, **rest).solve()
new = softlube.Contact(radius=R, **rest).solve()
change = {}
for name in ("contact_radius", "pressure_max", "film_center", "film_min", "friction_total"):
    change[name] = float(worn.dimensional[name] / new.dimensional[name]) - 1
    print(f"{name:15} new {new.dimensional[name]:.4g}, worn {worn.dimensional[name]:.4g} {worn.dimensional[name].unit}")

# %%
# The flat lowers the pressure by a third. But towards its border the pressure rises more steeply than under the new ball, and
# the film goes by that: it is 7 % thinner at the centre, 22 % at its thinnest, and the friction is 40 % larger. How much of
# that hangs on the smoothing? With a tolerance of five times the noise the film changes by less than 1 %:

coarse = softlube.Contact(indenter=softlube.Profile("worn_ball.csv", tolerance="100 nm"), **rest).solve()
smoothing = float(coarse.dimensional["film_center"] / worn.dimensional["film_center"]) - 1
print(f"film at the centre {smoothing:+.1%}")

# %%
# The profile, and the pressure along the direction of sliding:

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
height, _ = indenter.smoothed[0].outline(np.abs(r))
left.plot(r * 1e3, (z - z[200]) * 1e6, ".", ms=2, label="trace")
left.plot(r * 1e3, height * 1e6, label="smoothed")
left.plot(r * 1e3, r**2 / (2 * R) * 1e6, "--", label="new ball")
left.set(xlabel="r [mm]", ylabel="z [µm]", xlim=(-0.8, 0.8), ylim=(-2, 120))
left.legend()
for solution, style in ((worn, "-"), (new, "--")):
    length = solution.contact.unit_length
    unit = solution.contact.scales(solution.contact.unit_height)["pressure"][0]
    x = np.linspace(-0.6e-3, 0.6e-3, 401)
    pressure = solution.fields.pressure_at(np.abs(x) / length, np.where(x > 0, 0.0, np.pi)) * unit
    right.plot(x * 1e3, pressure * 1e-3, style, label="worn" if solution is worn else "new")
right.set(xlabel="x [mm], inlet at the right", ylabel="pressure [kPa]")
right.legend()
figure.savefig("worn_ball.png")
