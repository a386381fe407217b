"""What is written from a Model: C, documents, a JSON Schema."""
