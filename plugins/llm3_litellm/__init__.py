"""Models of any provider that the library LiteLLM speaks to."""
