"""What drives the time loops in C."""
