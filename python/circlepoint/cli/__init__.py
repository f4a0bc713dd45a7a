"""The command: ``circlepoint demo | calibrate | check | simulate``."""

from circlepoint.cli.main import main

__all__ = ["main"]
