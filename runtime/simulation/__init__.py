"""A loaded scene: one run, many runs, going on, how far to trust them."""
