"""The stability map: the catalogue of hard cases over solvers, rates, iterations and materials."""
