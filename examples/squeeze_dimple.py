"""A squeeze film and its dimple
=============================

A ball falls through a viscous oil onto rubber. The pressure flattens the rubber before the ball arrives, and liquid is caught
in the middle: a dimple. How long does the film take to drain?
"""

import numpy as np

import softlube

fall = softlube.squeeze(
    radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", load="100 mN", initial_height="100 um", duration="10 s"
)
print(f"after {fall.time[-1]:.3g} s:", fall.final["film_center"], "at the centre,", fall.final["film_min"], "at the rim")

# %%
# The dimple is born when the film becomes thinnest off the axis:

print(f"dimple after {1e3 * fall.dimple_time:.2f} ms")

# %%
# From then on the film at the centre falls like t^(-1/2). The local exponent over the last decade of time:

late = fall.time > 0.1 * fall.time[-1]
exponent = np.polyfit(np.log(fall.time[late]), np.log(fall.histories["film_center"][late]), 1)[0]
print(f"film at the centre ~ t^({exponent:.3f})")

# %%
# When does the rim come down to the roughness of the surfaces, say 1 µm? Stop there:

touch = softlube.squeeze(
    radius="2 mm",
    young_modulus="3 MPa",
    viscosity="2 Pa s",
    load="100 mN",
    initial_height="100 um",
    duration="100 s",
    film_limit="1 um",
)
print(f"minimum film of 1 µm after {touch.time[-1]:.4g} ± {touch.time_error:.1g} s")

# %%
# Profiles of film and pressure at some times, and the histories:

figure = fall.plot("squeeze_dimple.png")
