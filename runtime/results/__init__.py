"""What a run has: its data here; files, figures and reports of them in folders above."""
