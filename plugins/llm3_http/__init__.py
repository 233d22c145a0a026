"""Language models over HTTP: OpenAI's chat completions, which many servers speak, and Anthropic's Messages API."""
