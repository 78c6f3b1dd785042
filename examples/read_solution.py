"""Reading a saved solution
========================

A solution goes to a NetCDF file whole, with its inputs, errors and history, and comes back whole. Any program that reads NetCDF
reads it, too.
"""

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
