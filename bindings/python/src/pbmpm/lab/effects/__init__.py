"""What each effect of a scene costs, and which ones it calls for."""
