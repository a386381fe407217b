"""One file a joint type."""
