"""One file a force element: what `forces:` of a file may hold."""
