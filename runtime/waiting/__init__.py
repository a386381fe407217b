"""Keep long calls interruptible: Ctrl-C, cancellation of C functions, other programs, imports on demand."""
