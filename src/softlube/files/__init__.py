"""Files: NetCDF of solutions and of films in time, CSV with units, whole-file writes.

Depends on: `physical` and all above it.  A new format is a module here.
"""
