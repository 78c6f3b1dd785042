"""Pictures; the only place that knows axes, besides the paper's figures.

Depends on: `experiments` and all above it.  A new picture is a function here.
"""
