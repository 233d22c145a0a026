"""Backends that need no network and no language model."""
