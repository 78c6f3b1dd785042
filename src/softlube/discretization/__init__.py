"""The equations on a grid: polar grid, ring potentials, elasticity, Reynolds equation, the coupled system, its fields.

Depends on: `model`, `solvers`.  A term of an equation belongs to the module of that equation.
"""
