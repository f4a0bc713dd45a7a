"""The command: ``circlepoint demo | calibrate | check | simulate | export``."""

from circlepoint.cli.main import main

__all__ = ["main"]
