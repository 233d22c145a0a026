"""``python -m llm3``."""

import sys

from llm3.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
