"""Files of the user's: written whole or not at all, believed only if they are the user's own."""
