"""What one can ask of a `Solution`: friction in its parts, flow, the free boundary.

Depends on: `steady` and all above it.  A new read-out is a module with functions of a Solution.
"""
