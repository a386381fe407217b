"""Many runs judged: bench, map of verdicts, box of parameters."""
