"""The paper as published: its numerical method, its figures, a report of our numbers beside the paper's.

Depends on: `plots` and all above it.  A figure is a function in `figures`.
"""
