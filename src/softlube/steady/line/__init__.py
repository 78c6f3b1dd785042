"""Steady sliding of a line contact: continuation, mesh, error estimates, quantities, the `LineSolution`.

Depends on: `discretization.line` and all above it.
"""
