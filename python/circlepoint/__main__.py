"""``python -m circlepoint``."""

import sys

from circlepoint.cli import main

if __name__ == "__main__":
    sys.exit(main())
