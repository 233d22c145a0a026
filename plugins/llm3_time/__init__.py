"""Times for paths: as fast as the joints' limits allow, along the path that was checked for collision."""
