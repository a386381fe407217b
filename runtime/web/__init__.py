"""Simulate a scene in a web page: its C as WebAssembly, a description in JSON, and JavaScript (simulator.js)."""
