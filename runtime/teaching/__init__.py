"""Make teaching material of a scene: exercise sheets with solutions, and notebooks."""
