"""Kinematic calibration of robot arms by a triaxial accelerometer on the end-point.

The names of the C++ core are re-exported here: filters, integrators, chains, estimators and the simulator.
"""

from circlepoint._core import *
from circlepoint._core import __version__

__all__ = ["__version__"]
