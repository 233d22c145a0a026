"""Towers of blocks: an arm takes towers apart and builds others, given as on(a, b) facts."""
