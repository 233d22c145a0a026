"""Food is fetched from among clutter, washed, heated and served."""
