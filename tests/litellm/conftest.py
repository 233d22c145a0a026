from __future__ import annotations

from importlib.util import find_spec

# LiteLLM is large and comes with an extra; what needs the library itself is left out where it is not installed.
collect_ignore = [] if find_spec("litellm") else ["test_litellm_library.py"]
