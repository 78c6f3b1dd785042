"""Pictures of results; the paper's figures are in `paper.figures`.

Depends on: `experiments` and all above it.  A new picture is a function here.
"""
