"""A sphere that moves along its axis: films of rings in time."""
