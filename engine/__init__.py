"""The C code that all scenes share: time loops, methods, contacts, events, batches. engine.c lists its parts."""
