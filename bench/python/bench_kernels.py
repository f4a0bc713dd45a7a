"""Times circlepoint's kernels against what a user would pick instead, and against the machine's limits.

One process, one thread, calls of both sides interleaved; medians of the ratio of neighbouring calls, with quartiles.
Times are processor time (page faults included), which other load disturbs less, though a neighbour on the same physical
core still halves the throughput of ours while it hardly slows what waits. The limits are measured in the same run: a
fresh copy of the same array, reading it once (BLAS dot), and the latency of the filter's recursion (one channel through
one section, in the first-level cache, where nothing else takes time). "of limit" is the limit's time over ours.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import json
import pathlib
import platform
import subprocess
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass

import numpy as np
import scipy
import scipy.integrate
import scipy.optimize
import scipy.signal
from matplotlib.figure import Figure

import circlepoint as cp

try:
    import numba
except ModuleNotFoundError:
    numba = None

RATE = 500.0
SOS = cp.butter(4, 20.0, RATE)
ONE_SECTION = cp.butter(2, 20.0, RATE)
POSES = 150
HOLDS_AT_ONCE = 12  # arrays of the size of the argument that SciPy's Simpson rule holds at once, with some to spare
Call = Callable[[], object]


@dataclass
class Row:
    kernel: str
    against: str
    samples: int
    channels: int
    order: str
    pairs: int
    ours_us: float
    theirs_us: float
    ratio: float
    quartiles: tuple[float, float]
    limit: str
    of_limit: float


def seconds(call: Call) -> float:
    start = time.process_time_ns()
    call()
    return 1e-9 * (time.process_time_ns() - start)


def interleaved(calls: list[Call], budget: float) -> np.ndarray:
    """Times of the calls, (rounds, calls): 5 to 201 rounds in about `budget` seconds."""
    first = [seconds(call) for call in calls]
    repeats = [max(1, round(2e-4 / max(t, 1e-7))) for t in first]
    rounds = int(np.clip(budget / max(sum(r * t for r, t in zip(repeats, first, strict=True)), 1e-6), 5, 201))

    def several(call: Call, times: int) -> float:
        start = time.process_time_ns()
        for _ in range(times):
            call()
        return 1e-9 * (time.process_time_ns() - start) / times

    return np.array([[several(c, r) for c, r in zip(calls, repeats, strict=True)] for _ in range(rounds)])


def compared(kernel: str, against: str, shape: tuple[int, int], order: str, calls: tuple[Call, Call, Call | float],
             limit: str, budget: float) -> Row:  # fmt: skip
    ours, theirs, bound = calls
    times = interleaved([ours, theirs, *([bound] if callable(bound) else [])], budget)
    ratio = times[:, 1] / times[:, 0]
    bound_time = np.median(times[:, 2]) if callable(bound) else bound
    ours_time, theirs_time = np.median(times[:, :2], axis=0)
    low, high = np.percentile(ratio, [25, 75])
    return Row(kernel, against, *shape, order, len(times), 1e6 * ours_time, 1e6 * theirs_time, float(np.median(ratio)),
               (float(low), float(high)), limit, float(bound_time / ours_time))  # fmt: skip


def recursion_latency() -> float:
    """Seconds a sample and direction of one section's recursion."""
    x = np.random.default_rng(0).normal(size=(2_000, 1))
    lengths = (x[:1000].copy(), x)
    short, long = np.median(interleaved([lambda y=y: cp.sosfiltfilt(ONE_SECTION, y) for y in lengths], 0.2), axis=0)
    return float((long - short) / 2_000)


def signal_rows(samples: int, channels: int, order: str, latency: float, budget: float) -> list[Row]:
    x = np.random.default_rng(0).normal(size=(samples, channels))
    c = np.ascontiguousarray
    a = np.asfortranarray(x) if order == "F" else x
    recursion = 2 * samples * latency
    table: list[tuple[str, Call, Call, Call | float, str]] = [
        ("sosfiltfilt order 4", lambda: cp.sosfiltfilt(SOS, c(a)), lambda: scipy.signal.sosfiltfilt(SOS, a, axis=0),
         recursion, "recursion"),
        ("cumulative_trapezoid", lambda: cp.cumulative_trapezoid(c(a), dx=0.002, initial=0),
         lambda: scipy.integrate.cumulative_trapezoid(a, dx=0.002, axis=0, initial=0), x.copy, "copy"),
        ("cumulative_simpson", lambda: cp.cumulative_simpson(c(a), dx=0.002, initial=0),
         lambda: scipy.integrate.cumulative_simpson(a, dx=0.002, axis=0, initial=0), x.copy, "copy"),
        ("savgol_filter 21, 3", lambda: cp.savgol_filter(c(a), 21, 3),
         lambda: scipy.signal.savgol_filter(a, 21, 3, axis=0), x.copy, "copy"),
        ("welch 256", lambda: cp.welch(c(a), RATE), lambda: scipy.signal.welch(a, RATE, axis=0),
         lambda: np.dot(x.ravel(), x.ravel()), "read"),
    ]  # fmt: skip
    return [
        compared(kernel, "SciPy", (samples, channels), order, (ours, theirs, bound), limit, budget)
        for kernel, ours, theirs, bound, limit in table
    ]


def regression_rows(samples: int, budget: float) -> list[Row]:
    random = np.random.default_rng(1)
    angle, rate, acceleration = random.uniform(-3, 3, samples), random.normal(size=samples), random.normal(size=samples)
    readings = random.normal(size=(samples, 3))
    rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]
    everything = np.zeros(6 * samples)

    def with_numpy() -> object:
        x = np.column_stack([np.ones(samples), np.cos(angle), np.sin(angle), acceleration, rate**2])
        y = readings @ rotation.T
        return x.T @ x, x.T @ y, (y**2).sum(axis=0)

    def ours() -> object:
        return cp.joint_statistics(angle, rate, acceleration, readings, rotation)

    def reading() -> object:
        return np.dot(everything, everything)

    def row(against: str, theirs: Call) -> Row:
        return compared("joint_statistics", against, (samples, 3), "C", (ours, theirs, reading), "read", budget)

    rows = [row("NumPy", with_numpy)]
    if numba is not None:
        fused = numba_statistics()
        rows.append(row("Numba", lambda: fused(angle, rate, acceleration, readings, rotation)))
    return rows


def numba_statistics() -> Callable[..., object]:
    @numba.njit
    def fused(angle, rate, acceleration, readings, rotation):  # type: ignore[no-untyped-def]
        information, score, squares = np.zeros((5, 5)), np.zeros((5, 3)), np.zeros(3)
        x, y = np.ones(5), np.zeros(3)
        for i in range(len(angle)):
            x[1], x[2], x[3], x[4] = np.cos(angle[i]), np.sin(angle[i]), acceleration[i], rate[i] * rate[i]
            for k in range(3):
                y[k] = (
                    rotation[k, 0] * readings[i, 0] + rotation[k, 1] * readings[i, 1] + rotation[k, 2] * readings[i, 2]
                )
                squares[k] += y[k] * y[k]
            for k in range(5):
                for m in range(k, 5):
                    information[k, m] += x[k] * x[m]
                for m in range(3):
                    score[k, m] += x[k] * y[m]
        return information, score, squares

    return fused


def axis_rows(budget: float) -> list[Row]:
    random = np.random.default_rng(2)
    turn = np.linspace(0, 2, POSES)
    circle = np.column_stack([9 * np.cos(turn), 9 * np.sin(turn), np.full(POSES, 3.0)])
    poses = circle + random.normal(size=(POSES, 3)) / 99
    poses = np.ascontiguousarray(poses @ np.linalg.qr(random.normal(size=(3, 3)))[0])

    def with_svd() -> object:
        return np.linalg.svd(poses - poses.mean(axis=0), full_matrices=False)[2][2]

    def residuals(p: np.ndarray) -> np.ndarray:
        return poses @ np.array([np.sin(p[0]) * np.cos(p[1]), np.sin(p[0]) * np.sin(p[1]), np.cos(p[0])]) - p[2]

    def with_least_squares() -> object:
        return scipy.optimize.least_squares(residuals, [1.0, 0.5, 3.0])

    def ours() -> object:
        return cp.fit_axis_direction(poses)

    def nothing() -> object:
        return np.dot(poses.ravel(), poses.ravel())

    return [
        compared("fit_axis_direction", against, (POSES, 3), "C", (ours, theirs, nothing), "read", budget)
        for against, theirs in [("SciPy least_squares", with_least_squares), ("NumPy SVD", with_svd)]
    ]


def available_bytes() -> int:
    for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return 1024 * int(line.split()[1])
    return 0


def machine() -> dict[str, str]:
    cpu = [line.split(":")[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
           if line.startswith("model name")]  # fmt: skip
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], capture_output=True, text=True, check=False,
                            cwd=pathlib.Path(__file__).parent).stdout.strip()  # fmt: skip
    return {
        "cpu": cpu[0] if cpu else platform.processor(),
        "cores": str(os.cpu_count()),
        "load": " ".join(f"{load:.1f}" for load in os.getloadavg()),
        "instruction_set": cp.instruction_set().name,
        "commit": commit,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "numba": numba.__version__ if numba is not None else "not installed",
    }


def plot(rows: list[Row], path: pathlib.Path) -> None:
    shown = [row for row in rows if row.order == "C"]
    figure = Figure(figsize=(8, 0.24 * len(shown) + 1.5))
    axes = figure.subplots()
    places = np.arange(len(shown))
    middle = np.array([row.ratio for row in shown])
    ends = np.array([row.quartiles for row in shown])
    axes.errorbar(middle, places, xerr=np.abs(ends - middle[:, None]).T, fmt="o", markersize=4, capsize=2)
    labels = [f"{row.kernel} / {row.against}, {row.samples:.0e} x {row.channels}" for row in shown]
    axes.set_yticks(places, labels, fontsize=7)
    axes.invert_yaxis()
    axes.set_xscale("log")
    axes.axvline(1.0, color="grey", linewidth=0.8)
    axes.grid(axis="x", which="both", alpha=0.3)
    axes.set_xlabel("times as fast (median, quartiles)")
    figure.tight_layout()
    figure.savefig(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    sizes = [5_000, 1_000_000, 10_000_000]
    parser.add_argument("--samples", type=lambda text: int(float(text)), nargs="+", default=sizes)
    parser.add_argument("--channels", type=int, nargs="+", default=[3, 10])
    parser.add_argument("--orders", nargs="+", choices=["C", "F"], default=["C", "F"])
    parser.add_argument("--budget", type=float, default=4.0, help="seconds a comparison (at least 5 rounds)")
    parser.add_argument("--out", type=pathlib.Path, help="folder for kernels.json and kernels.svg")
    options = parser.parse_args()

    latency = recursion_latency()
    print("  ".join(f"{key}: {value}" for key, value in machine().items()))
    print(f"recursion {1e9 * latency:.2f} ns a sample and direction")
    heading = f"{'kernel':22}{'against':21}{'samples':>13} {'':2}{'ours us':>12}{'theirs us':>13}{'ratio':>8}"
    print(heading + f"  {'quartiles':15}of limit")
    rows: list[Row] = []

    def report(new: list[Row]) -> None:
        for row in new:
            shape = f"{row.samples:.0e} x {row.channels}"
            quartiles = f"{row.quartiles[0]:.1f} .. {row.quartiles[1]:.1f}"
            print(f"{row.kernel:22}{row.against:21}{shape:>13} {row.order:2}{row.ours_us:12.2f}{row.theirs_us:13.1f}"
                  f"{row.ratio:8.1f}  {quartiles:15}{100 * row.of_limit:4.0f} % {row.limit}", flush=True)  # fmt: skip
        rows.extend(new)

    report(axis_rows(options.budget))
    for samples in options.samples:
        report(regression_rows(samples, options.budget))
        for channels in options.channels:
            needed = HOLDS_AT_ONCE * 8 * samples * channels
            if needed > available_bytes():
                print(f"{samples:.0e} x {channels} needs {needed / 1e9:.0f} GB with SciPy's temporaries, "
                      f"{available_bytes() / 1e9:.0f} GB are free: left out")  # fmt: skip
                continue
            for order in options.orders:
                report(signal_rows(samples, channels, order, latency, options.budget))
    if options.out is not None:
        options.out.mkdir(parents=True, exist_ok=True)
        document = {"machine": machine(), "recursion_ns": 1e9 * latency, "rows": [asdict(row) for row in rows]}
        (options.out / "kernels.json").write_text(json.dumps(document, indent=1) + "\n")
        plot(rows, options.out / "kernels.svg")


if __name__ == "__main__":
    main()
