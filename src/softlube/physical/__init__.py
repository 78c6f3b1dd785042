"""SI in and out: units, materials, the physical contact, the rig, squeeze films and starts of sliding with units.

Depends on: `transient`, `theory` and all above them.  All rooms above compute with plain numbers, normalised.
"""
