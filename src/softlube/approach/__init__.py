"""Normal approach and separation: a sphere that squeezes the liquid out from under it, or is pulled away; docs/squeeze.md."""
