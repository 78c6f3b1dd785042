"""Files: NetCDF of solutions and transients, CSV with units, whole-file writes.

Depends on: `physical` and all above it.  A new format is a module here.
"""
