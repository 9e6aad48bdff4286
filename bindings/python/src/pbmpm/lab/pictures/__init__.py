"""Pictures of scenes: flat ones of 2D, traced ones of 3D."""
