"""One compiled scene before it runs: arrays for C, numbers, start, rank, default step."""
