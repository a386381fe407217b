"""A scene for a page: its C as WebAssembly, a description in JSON, and the JavaScript that runs it (simulator.js)."""
