"""The paper's whole study: every number and figure it states, with ours beside it."""

from circlepoint.reproduce.study import Reproduction, reproduce

__all__ = ["Reproduction", "reproduce"]
