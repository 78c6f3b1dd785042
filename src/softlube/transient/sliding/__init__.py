"""A sphere that starts to slide at an instant: the whole plane in time, up to steady sliding."""
