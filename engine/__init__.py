"""What all scenes share, in plain C: time loops, methods, contacts, events, batches. engine.c lists its parts."""
