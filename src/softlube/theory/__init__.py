"""What is known without solving: laws of the Hertz limit, their similarity problems, the master curve, formulas, scaling.

Depends on: `steady` (for `Solution`) and all above it.  A law or a formula from the literature is a module here.
"""
