"""Kinematic calibration of robot arms by a triaxial accelerometer on the end-point.

The names of the C++ core (filters, integrators, chains, estimators, the simulator) are here, beside those of the main
job: `load_arm`, `read_recording`, `recording_from_arrays`, `check_recording`, `load_sensor` and `calibrate`.
"""

try:
    from circlepoint._core import *
except ModuleNotFoundError as error:
    if error.name != "circlepoint._core":
        raise
    raise ModuleNotFoundError(
        f"circlepoint._core, the compiled part, is missing in {__path__[0]}: this is a source tree, or an install for "
        "another version of Python. Run `pip install .` (or `make install`) in the source tree and leave its python "
        "folder off the path.",
        name=error.name,
    ) from error

from circlepoint import _core
from circlepoint._core import __version__
from circlepoint.arm import Arm, load_arm
from circlepoint.arrays import recording_from_arrays
from circlepoint.calibration import Calibration, calibrate
from circlepoint.check import check_recording
from circlepoint.recording_io import read_recording
from circlepoint.sensor_presets import load_sensor

__all__ = [
    "Arm",
    "Calibration",
    "__version__",
    "calibrate",
    "check_recording",
    "load_arm",
    "load_sensor",
    "read_recording",
    "recording_from_arrays",
]
__all__ += _core.__all__
