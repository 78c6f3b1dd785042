"""What is solved, in numbers and without a grid: the problem, substrates, liquids, dry contacts, exact solutions, quantities.

Depends on: `softlube.errors` only.  A new liquid law or substrate is a module here; a new quantity is a row in `quantities`.
"""
