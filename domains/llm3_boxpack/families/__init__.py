"""Problems that are made from a solution: each family draws a packing that the hand can do, and then how it begins."""
