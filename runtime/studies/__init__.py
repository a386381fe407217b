"""Many runs judged: bench, stress map, box of parameters."""
