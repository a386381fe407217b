"""What a mechanism file may hold: its sections, the check of their shapes, overrides by address."""
