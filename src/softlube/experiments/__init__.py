"""Experiments in SI: measured friction and its fit, Stribeck curves, squeeze films and starts of sliding.

Depends on: `files`, `physical` and all above them.
"""
