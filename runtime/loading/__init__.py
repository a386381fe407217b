"""Load a mechanism: find or generate its C, compile it or take the library from the cache, and open the library."""
