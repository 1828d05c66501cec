"""The complete code, one module per lecture topic. Start with transforms."""
