"""Accuracy under the paper's noise model, over many seeds: python bench/python/paper_noise.py [SEEDS].

The trials are those of `circlepoint reproduce` (circlepoint.reproduce.conditions) with a sensor that has nothing but a
bias: one joint of random direction a seed, 0.3 to 0.7 m away; 150 poses of one degree with 0.5 mm/s^2 of white noise;
eq. (11), 0.5 Hz over 150 degrees, one period at 500 Hz with 10 mm/s^2 of white noise and 100 mm/s^2 of vibration.
"""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np

from circlepoint.reproduce.accuracy import joint_trial
from circlepoint.reproduce.conditions import Conditions, only
from circlepoint.reproduce.estimates import Centre

METHODS = {"velocity": Centre("velocity"), "position": Centre("position")}
LIMITS = {"axis": 0.1, "velocity": 0.25, "position": 2.0, "regression": 0.2}


def main() -> int:
    """Run the trials and print their table; exit status 1 where a limit is exceeded."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    conditions = Conditions()
    conditions = replace(conditions, sensor=only(conditions.sensor, "bias_std"))
    trials = [joint_trial(conditions, METHODS, seed) for seed in range(seeds)]
    print(f"the paper's noise model, {seeds} seeds (0 to {seeds - 1}); paper: axis 0.3 mrad max, centre 3 mm max")
    print(f"{'figure':<28}{'median':>9}{'rms':>9}{'95 %':>9}{'max':>9}{'limit':>9}")
    failed = False
    for name, limit in LIMITS.items():
        errors = 1e3 * np.array([trial.axis if name == "axis" else trial.centre[name] for trial in trials])
        label = "static axis, mrad" if name == "axis" else f"centre by {name}, mm"
        figures = (np.median(errors), np.sqrt(np.mean(errors**2)), np.quantile(errors, 0.95), errors.max(), limit)
        print(f"{label:<28}" + "".join(f"{figure:>9.3f}" for figure in figures))
        failed |= bool(errors.max() > limit)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
