"""Numerical methods for vectors: Newton's method for complementarity problems, continuation.  No physics.

Depends on: `softlube.errors` only.  A new method is a module here, tested on problems with a known answer.
"""
