"""The feedback levels: what a model is told of its earlier attempts."""
