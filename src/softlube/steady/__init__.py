"""Steady sliding: regime, mesh, first guess, the ladder of grids, error estimates, refinements, the `Solution`.

Depends on: `discretization` and all above it.  A refinement is a module of `refinements`.
"""
