"""What the generator hands over and the runtime reads: the standard library alone."""
