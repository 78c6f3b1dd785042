"""The line contact on a mesh: panels with polynomials of high degree, logarithmic potentials, the equations.

Depends on: `model` and `solvers`.  A substrate or a liquid needs nothing here: the equations take their kernels and laws.
"""
