"""Reading a saved solution
========================

A solution goes to a NetCDF file whole, with its inputs, errors and history, and comes back whole. Any program that reads NetCDF
reads it, too.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import softlube

softlube.solve(beta=300).save("contact.nc")

# %%
# Back as a solution, with everything that a fresh one can do:

solution = softlube.load("contact.nc")
print(solution.film_min, "at", solution.film_min_angle_deg, "degrees from the inlet")
print("film on the y axis at r = 0.9:", float(solution.fields.film_at(0.9, np.pi / 2)))

# %%
# Or as a plain dataset:

with xr.open_dataset("contact.nc", engine="h5netcdf") as dataset:
    print(dataset["pressure"].sizes, dataset.attrs["softlube_version"])
    highest = float(dataset["pressure"].max())

# %%
# The film along the y axis, across the sliding, between the nodes of the grid. It is thinnest near the edge of
# the contact:

y = np.linspace(0.0, 1.2, 200)
film = solution.fields.film_at(y, np.full_like(y, np.pi / 2))
figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
axes.plot(y, film)
axes.set(xlabel="y / a", ylabel="film / |h₀|", ylim=(0, 0.1))
figure.savefig("read_solution.png")
plt.close(figure)
