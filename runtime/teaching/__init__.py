"""What a class gets of a scene: exercise sheets with their solutions, notebooks."""
