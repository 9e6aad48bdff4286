"""Scene files and presets: their parts, how they are read, what is checked, how obstacles move."""
