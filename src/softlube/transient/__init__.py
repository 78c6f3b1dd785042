"""Films that change with time, in numbers: squeeze films and starts of sliding, over motions and drives.

Depends on: `steady` and all above it.  A new drive is a class in `drives`.
"""
