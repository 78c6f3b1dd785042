"""Measured data in, fitted parameters out; film and friction against speed.

Depends on: `files`, `physical` and all above them.
"""
