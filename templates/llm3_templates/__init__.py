"""The prompt strategies that ship with llm3, and the partials that any template may include."""
