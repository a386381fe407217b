"""The file's tree to a Mechanism, section by section, all mistakes at once."""
