"""Calls timed in turns, their ratios, and what is kept of them.

Everything runs in one process, linear algebra on one thread (import this module before NumPy), calls of all sides in
turns, so that load on the machine meets them alike; printed are the median of the ratio of neighbouring calls and its
quartiles. Times are the wall clock's, page faults included: those of circlepoint's results above 32 MB a second thread
takes upon itself where there is another processor.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import gc
import json
import pathlib
import platform
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field

import numpy as np
import scipy
from matplotlib.figure import Figure

import circlepoint as cp

try:
    import numba
except ModuleNotFoundError:
    numba = None

Call = Callable[[], object]
HEADING = f"{'kernel':24}{'against':26}{'samples':>13} {'':2}{'ours us':>13}{'theirs us':>13}{'ratio':>8}"
HEADING += f"  {'quartiles':17}limit"


@dataclass
class Row:
    """One comparison; `limits` holds the times (us) of what ours cannot be faster than, by name."""

    kernel: str
    against: str
    samples: int
    channels: int
    order: str
    rounds: int
    ours_us: float
    theirs_us: float
    ratio: float
    quartiles: tuple[float, float]
    limits: dict[str, float] = field(default_factory=dict)

    @property
    def shape(self) -> str:
        """Samples and channels in words."""
        samples = f"{self.samples:.3g}" if self.samples < 1000 else f"{self.samples:.0e}".replace("e+0", "e")
        return f"{samples} x {self.channels}"

    def line(self) -> str:
        """One line of the table; limits as their share of our time."""
        quartiles = f"{self.quartiles[0]:.1f} .. {self.quartiles[1]:.1f}"
        limits = ", ".join(f"{100 * us / self.ours_us:.0f} % {name}" for name, us in self.limits.items())
        return (f"{self.kernel:24}{self.against:26}{self.shape:>13} {self.order:2}{self.ours_us:13.2f}"
                f"{self.theirs_us:13.1f}{self.ratio:8.1f}  {quartiles:17}{limits}")  # fmt: skip


def seconds(call: Call, times: int = 1) -> float:
    """Return the time of one call, the mean of several."""
    start = time.perf_counter_ns()
    for _ in range(times):
        call()
    return 1e-9 * (time.perf_counter_ns() - start) / times


def interleaved(calls: Sequence[Call], budget: float, fewest: int = 5) -> np.ndarray:
    """Return times of the calls, (rounds, calls), for about `budget` seconds: `fewest` (3 of 5 s) to 201 rounds."""
    gc.disable()
    try:
        first = [seconds(call) for call in calls]
        repeats = [max(1, round(2e-4 / max(t, 1e-7))) for t in first]
        once = max(sum(r * t for r, t in zip(repeats, first, strict=True)), 1e-6)
        rounds = int(np.clip(budget / once, fewest if once < 5.0 else min(fewest, 3), 201))
        return np.array([[seconds(c, r) for c, r in zip(calls, repeats, strict=True)] for _ in range(rounds)])
    finally:
        gc.enable()


def compared(kernel: str, against: str, shape: tuple[int, int], order: str, ours: Call, theirs: Call,
             limits: dict[str, Call | float], budget: float, fewest: int = 5) -> Row:  # fmt: skip
    """Time both sides and the limits in turns; a limit that is a number is in seconds."""
    called = {name: limit for name, limit in limits.items() if callable(limit)}
    times = interleaved([ours, theirs, *called.values()], budget, fewest)
    ratio = times[:, 1] / times[:, 0]
    medians = np.median(times, axis=0)
    measured = dict(zip(called, medians[2:], strict=True))
    shares = {name: float(1e6 * measured.get(name, limit)) for name, limit in limits.items()}
    low, high = np.percentile(ratio, [25, 75])
    return Row(kernel, against, *shape, order, len(times), float(1e6 * medians[0]), float(1e6 * medians[1]),
               float(np.median(ratio)), (float(low), float(high)), shares)  # fmt: skip


def machine() -> dict[str, str]:
    """Return what the figures depend on."""
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


def available_bytes() -> int:
    """Return how much memory is free."""
    for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return 1024 * int(line.split()[1])
    return 0


def keep(folder: pathlib.Path, name: str, rows: Sequence[Row], **more: object) -> None:
    """Write `name`.json, and `name`.svg with the ratios."""
    folder.mkdir(parents=True, exist_ok=True)
    document = {"machine": machine(), **more, "rows": [asdict(row) for row in rows]}
    (folder / f"{name}.json").write_text(json.dumps(document, indent=1) + "\n")
    plot_ratios(rows, folder / f"{name}.svg")


def plot_ratios(rows: Sequence[Row], path: pathlib.Path) -> None:
    """Draw ratios with quartiles, a panel for each thing compared with, a line for each kernel and size in C order."""
    shown = [row for row in rows if row.order == "C"]
    kernels = list(dict.fromkeys((row.kernel, row.against) for row in shown))
    shapes = list(dict.fromkeys(row.shape for row in shown))
    colours = {shape: f"C{i}" for i, shape in enumerate(shapes)}
    figure = Figure(figsize=(8.5, 0.42 * len(kernels) + 1.6), layout="constrained")
    axes = figure.subplots()
    for place, (kernel, against) in enumerate(kernels):
        mine = [row for row in shown if (row.kernel, row.against) == (kernel, against)]
        for offset, row in zip(np.linspace(-0.25, 0.25, len(mine)) if len(mine) > 1 else [0.0], mine, strict=True):
            ends = np.abs(np.array(row.quartiles) - row.ratio)[:, None]
            axes.errorbar(
                row.ratio, place + offset, xerr=ends, fmt="o", markersize=4.5, capsize=2, color=colours[row.shape]
            )
    for shape in shapes:
        axes.plot([], [], "o", markersize=4.5, color=colours[shape], label=shape)
    axes.set_yticks(range(len(kernels)), [f"{kernel}\nagainst {against}" for kernel, against in kernels], fontsize=7)
    axes.set_ylim(len(kernels) - 0.5, -0.5)  # the first on top
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    ticks = [t for t in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if 0.9 * min(low, 1) <= t <= high]
    axes.set_xticks(ticks, [f"{t}x" for t in ticks])
    axes.minorticks_off()
    axes.axvline(1.0, color="grey", linewidth=0.8)
    axes.grid(axis="x", alpha=0.3)
    axes.set_xlabel("times as fast (median and quartiles of neighbouring calls)")
    axes.legend(title="samples x channels", fontsize=7, title_fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(path)
