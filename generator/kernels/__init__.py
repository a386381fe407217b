"""Every function of a scene, before it is text."""
