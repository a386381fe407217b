"""Define the data that the generator passes to the runtime; these modules import the standard library alone."""
