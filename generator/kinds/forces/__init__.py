"""Contains one file for each force element: what `forces:` of a file may contain."""
