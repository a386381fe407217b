"""From a name or file to C and a library: shipped, cached, compiled."""
