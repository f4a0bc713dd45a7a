"""Every number the paper states, once: what it is, what was printed, and how ours is made."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Stated:
    """Something the paper states as a number; `value` in SI."""

    id: str
    section: str
    quantity: str
    printed: str
    """As the paper writes it."""
    value: float | None
    """None where it states the fact and no number."""
    unit: str
    """SI, of `value`."""
    shown: str
    """Unit of what is shown."""
    factor: float
    """From SI to that."""
    how: str
    """How ours is computed."""
    upper: bool = False
    """True for a bound: ours agrees when it is not larger."""


_ten = "median of the statistic over groups of ten trials, and the interval of 95 % of the groups"
STATED = (
    Stated(
        "fundamental",
        "5",
        "f₀ of the dynamic test, eq. (11)",
        "0.5 Hz",
        0.5,
        "Hz",
        "Hz",
        1.0,
        "strongest line of the simulated encoder's spectrum",
    ),
    Stated(
        "span",
        "5",
        "spanned angle",
        "150 degrees",
        math.radians(150.0),
        "rad",
        "°",
        180.0 / math.pi,
        "range of the simulated encoder",
    ),
    Stated(
        "rate",
        "3.1, 5",
        "sampling frequency",
        "500 Hz",
        500.0,
        "Hz",
        "Hz",
        1.0,
        "samples of the simulated recording over its duration",
    ),
    Stated(
        "bound_angle",
        "4",
        "bound of the gravity direction",
        "5.6\N{MULTIPLICATION SIGN}10⁻⁴ rad",
        5.6e-4,
        "rad",
        "mrad",
        1e3,
        "(ε_w + ε_p)/g from the sensor's figures; right: the largest axis error of all trials",
        upper=True,
    ),
    Stated(
        "bound_end_point",
        "4",
        "the same at the end-point, reach 1 m",
        "5.6\N{MULTIPLICATION SIGN}10⁻⁴ m",
        5.6e-4,
        "m",
        "mm",
        1e3,
        "bound times reach; right: the largest axis error of all trials times reach",
        upper=True,
    ),
    Stated("axis_max", "4", "axis direction, simulated: maximum of ten", "0.3 mrad", 0.3e-3, "rad", "mrad", 1e3, _ten),
    Stated(
        "axis_std",
        "4",
        "axis direction, simulated: standard deviation",
        "0.1 mrad",
        0.1e-3,
        "rad",
        "mrad",
        1e3,
        f"root mean square about the truth; {_ten}",
    ),
    Stated(
        "percussion_iterations",
        "4",
        "corrections for the centre of percussion until no further improvement",
        "2",
        2.0,
        "1",
        "",
        1.0,
        "corrections until the error is within a quarter of the converged one; at 1 m, and over distances",
    ),
    Stated(
        "centre_position_max",
        "4",
        "centre, method 1, simulated: maximum of ten",
        "3 mm",
        3e-3,
        "m",
        "mm",
        1e3,
        f"position method, converged; {_ten}",
    ),
    Stated(
        "centre_position_std",
        "4",
        "centre, method 1, simulated: standard deviation",
        "2 mm",
        2e-3,
        "m",
        "mm",
        1e3,
        f"root mean square about the truth; {_ten}",
    ),
    Stated(
        "centre_velocity_max",
        "4",
        "centre, method 2, simulated: maximum of ten",
        "3 mm",
        3e-3,
        "m",
        "mm",
        1e3,
        f"printed means over samples whose rate is above 2 % of its peak; {_ten}",
    ),
    Stated(
        "centre_velocity_std",
        "4",
        "centre, method 2, simulated: standard deviation",
        "2 mm",
        2e-3,
        "m",
        "mm",
        1e3,
        f"root mean square about the truth; {_ten}",
    ),
    Stated(
        "averaged_noise",
        "5",
        "environmental noise of a second's mean",
        "0.1 mm/s²",
        0.1e-3,
        "m/s²",
        "mm/s²",
        1e3,
        "standard deviation of the means, bootstrap interval; left: noise of 12.5 Hz bandwidth, right: white",
    ),
    Stated(
        "repeat_max",
        "5",
        "axis direction, measured: maximum of ten repeats",
        "0.3 mrad",
        0.3e-3,
        "rad",
        "mrad",
        1e3,
        "largest distance of ten repeats from their mean, axis 2; left: the sensor's temperature wanders by 3 °C",
    ),
    Stated(
        "repeat_std",
        "5",
        "axis direction, measured: standard deviation of ten repeats",
        "0.1 mrad",
        0.1e-3,
        "rad",
        "mrad",
        1e3,
        "standard deviation of ten repeats about their mean, axis 2",
    ),
    Stated(
        "axes_angle",
        "5",
        "angle between axes 1 and 2, repeatability",
        "0.4 ± 0.3 mrad",
        0.3e-3,
        "rad",
        "mrad",
        1e3,
        "largest deviation from the mean of ten repeats of a known misalignment",
    ),
    Stated(
        "bandwidth",
        "5",
        "filter bandwidth the spectrum suggests",
        "10 Hz",
        10.0,
        "Hz",
        "Hz",
        1.0,
        "last harmonic of the motion above noise and vibration",
        upper=True,
    ),
    Stated(
        "centre_measured",
        "5",
        "centre, measured",
        "15 mm",
        15e-3,
        "m",
        "mm",
        1e3,
        f"the three named causes together, method 1 with the two corrections of section 4; {_ten} (rms)",
    ),
    Stated(
        "measured_axis",
        "6",
        "axis direction, rms",
        "0.3 mrad",
        0.3e-3,
        "rad",
        "mrad",
        1e3,
        f"seven-joint arm, plane fit; {_ten}",
    ),
    Stated(
        "end_point",
        "6",
        "end-point, cumulative",
        "15 mm",
        15e-3,
        "m",
        "mm",
        1e3,
        "seven-joint arm as measured, method 2 as printed: rms over 200 poses, median and 95 % of arms",
    ),
    Stated(
        "improvement",
        "6",
        "better sensor, higher rate, converter at the sensor",
        "“could be increased”",
        None,
        "m",
        "mm",
        1e3,
        f"centre error of the measured case with all three, position method; {_ten} (rms)",
    ),
    Stated(
        "tracking",
        "5, Figure 9",
        "accelerometer as position sensor",
        "“quite smooth”",
        None,
        "m",
        "mm",
        1e3,
        "distance from the true position after 2 s, median and 95 % of trials",
    ),
)
