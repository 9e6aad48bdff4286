"""Speed: what an iteration and a step cost with each solver, on matter in motion."""
