"""One compiled scene before it runs: arrays for C, numbers, default step."""
