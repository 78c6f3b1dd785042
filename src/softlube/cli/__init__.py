"""The command line: a module for each command.  Heavy imports live inside the commands, because start-up counts.

Depends on: everything.  A new command is a module here and a line in `main`.
"""
