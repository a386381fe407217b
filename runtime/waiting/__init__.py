"""What takes seconds: Ctrl-C, questions from C, programs that are started, late imports."""
