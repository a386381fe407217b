"""Drive the time loops in C: choice of method, batches of runs, threads, SIMD lanes, stored results."""
