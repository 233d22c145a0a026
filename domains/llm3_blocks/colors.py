"""The colours that blocks are called by."""

COLORS = ("red", "blue", "green", "yellow", "orange", "purple", "cyan", "pink", "brown", "tan")
