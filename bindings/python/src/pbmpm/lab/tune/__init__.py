"""Settings for a user's own scene: error against its converged solution over milliseconds per frame, and presets."""
