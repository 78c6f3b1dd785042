"""SI in and out: units, materials, the physical contact, the rig, squeeze films and starts of sliding with units.

Depends on: `transient`, `theory` and all above them.  Units exist here and at the command line, nowhere else.
"""
