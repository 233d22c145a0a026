"""Answers from what was recorded: a cassette, or a run's folder."""
