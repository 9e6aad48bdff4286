"""What accuracy costs: reference cases swept over rate and iterations, error against milliseconds."""
