"""``python -m ruledlab``: the command for those whose PATH does not have it."""

from __future__ import annotations

import sys

from ruledlab.cli import main

if __name__ == "__main__":
    sys.exit(main())
