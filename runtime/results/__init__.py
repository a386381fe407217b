"""What a run has: series, files, figures, report."""
