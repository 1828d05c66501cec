"""All right."""
