"""Read linkages of other programs as mechanisms, and export scenes as functional mock-up units (FMU)."""
