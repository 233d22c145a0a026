"""Language models over HTTP, by the chat completions interface that OpenAI, Ollama, vLLM and others share."""
