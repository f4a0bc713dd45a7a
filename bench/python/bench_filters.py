"""Times circlepoint's signal kernels against SciPy's: one process, interleaved, medians of pairs with their spread.

The times are processor time, which other load on the machine disturbs less; both sides use one thread.
"""

import argparse
import time
from collections.abc import Callable

import numpy as np
import scipy.integrate
import scipy.signal

import circlepoint as cp

SAMPLE_RATE = 500.0
CHANNELS = 3
Call = Callable[[np.ndarray], object]

SOS = cp.butter(4, 20.0, SAMPLE_RATE)
KERNELS: dict[str, tuple[Call, Call]] = {
    "sosfiltfilt (order 4)": (
        lambda x: cp.sosfiltfilt(SOS, x),
        lambda x: scipy.signal.sosfiltfilt(SOS, x, axis=0),
    ),
    "cumulative_trapezoid": (
        lambda x: cp.cumulative_trapezoid(x, dx=0.002, initial=0),
        lambda x: scipy.integrate.cumulative_trapezoid(x, dx=0.002, axis=0, initial=0),
    ),
    "cumulative_simpson": (
        lambda x: cp.cumulative_simpson(x, dx=0.002, initial=0),
        lambda x: scipy.integrate.cumulative_simpson(x, dx=0.002, axis=0, initial=0),
    ),
    "savgol_filter (21, 3)": (
        lambda x: cp.savgol_filter(x, 21, 3),
        lambda x: scipy.signal.savgol_filter(x, 21, 3, axis=0),
    ),
    "welch (256)": (
        lambda x: cp.welch(x, SAMPLE_RATE),
        lambda x: scipy.signal.welch(x, SAMPLE_RATE, axis=0),
    ),
}


def seconds(call: Call, samples: np.ndarray) -> float:
    start = time.process_time()
    call(samples)
    return time.process_time() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=int, nargs="+", default=[5_000, 1_000_000])
    parser.add_argument("--pairs", type=int, default=31, help="timed pairs a kernel and length")
    options = parser.parse_args()
    print(f"{'kernel':24}{'samples':>14}{'circlepoint ms':>16}{'scipy ms':>12}{'ratio':>8}   quartiles of the ratio")
    for rows in options.rows:
        samples = np.random.default_rng(0).normal(size=(rows, CHANNELS))
        for name, (ours, theirs) in KERNELS.items():
            seconds(ours, samples), seconds(theirs, samples)
            pairs = np.array([(seconds(ours, samples), seconds(theirs, samples)) for _ in range(options.pairs)])
            ratio = pairs[:, 1] / pairs[:, 0]
            ours_ms, theirs_ms = 1e3 * np.median(pairs, axis=0)
            low, high = np.percentile(ratio, [25, 75])
            shape = f"{rows} x {CHANNELS}"
            times = f"{ours_ms:16.4f}{theirs_ms:12.4f}"
            print(f"{name:24}{shape:>14}{times}{np.median(ratio):8.1f}   {low:.1f} .. {high:.1f}")


if __name__ == "__main__":
    main()
