"""What domains share in which an arm takes boxes from above, and puts them down on a table or on what stands on it."""
