"""Prints what calibrating costs against samples, joints, tests and threads, and what memory it takes.

Each row fits time ~ size^p to the upper half of its sizes (the lower ones hold constant parts). What should be linear:
all that goes through samples, at any number of tests; forward kinematics in joints. The whole-arm estimate of n joints
has 4 n parameters and, with every joint tested, n times the rows: its normal equations cost n^3.

Memory is the peak of a process of its own, above what it held before. It should not grow where samples stream: the
normal equations in pieces, and logs read from files above 1.5 million rows, where only what the estimate needs is kept.
"""

import argparse
import json
import multiprocessing
import pathlib
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass

import measuring
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, NullLocator
from measuring import machine, seconds

import circlepoint as cp
from circlepoint.arm import load_arm
from circlepoint.demo import ARM_FILE
from circlepoint.recording_io import read_recording

PIECE = 1_000_000
PARQUET_PIECE = 200_000


@dataclass
class Growth:
    """Sizes and what they cost."""

    what: str
    against: str
    sizes: list[float]
    values: list[float]
    unit: str = "s"
    expected: float = 1.0

    @property
    def exponent(self) -> float:
        """Of the upper half of the sizes."""
        half = max(2, (len(self.sizes) + 1) // 2)
        x, y = np.log(self.sizes[-half:]), np.log(np.maximum(self.values[-half:], 1e-9))
        return float(np.polyfit(x, y, 1)[0])

    def lines(self) -> str:
        """Two lines of the table."""
        sizes = "".join(f"{size:>10.3g}" for size in self.sizes)
        values = "".join(f"{value:>10.3g}" for value in self.values)
        of = f"exponent {self.exponent:5.2f} (expected {self.expected:g})"
        return f"{self.what:44}{self.against:>8} {sizes}\n{of:44}{self.unit:>8} {values}"


def best(call: Callable[[], object], budget: float = 0.5) -> float:
    """Return the least processor time of some calls: the first ones may have to wait for pages to be moved together."""
    first = seconds(call)
    return min([first, *(seconds(call) for _ in range(int(np.clip(budget / max(first, 1e-6), 3, 20))))])


# Samples through the kernels


def kernels(sizes: Sequence[int]) -> list[Growth]:
    sos = cp.butter(4, 20.0, 500.0)
    calls: dict[str, Callable[[np.ndarray], object]] = {
        "sosfiltfilt, 3 channels": lambda x: cp.sosfiltfilt(sos, x),
        "cumulative_trapezoid, 3 channels": lambda x: cp.cumulative_trapezoid(x, dx=0.002, initial=0),
        "welch, 3 channels": lambda x: cp.welch(x, 500.0),
    }
    times: dict[str, list[float]] = {name: [] for name in calls}
    for size in sizes:
        x = np.random.default_rng(0).normal(size=(size, 3))
        for name, call in calls.items():
            times[name].append(best(lambda call=call, x=x: call(x)))
    return [Growth(name, "samples", list(sizes), values) for name, values in times.items()]


def streamed_statistics(samples: int) -> float:
    """Add up a test of any length, a piece in memory at a time; return the seconds it took."""
    random = np.random.default_rng(1)
    piece = min(samples, PIECE)
    angle, rate, acceleration = random.uniform(-3, 3, piece), random.normal(size=piece), random.normal(size=piece)
    readings = random.normal(size=(piece, 3))
    total = cp.RegressionStatistics()
    start = time.process_time()
    for _ in range(samples // piece):
        total += cp.joint_statistics(angle, rate, acceleration, readings)
    return time.process_time() - start


# Whole arms


def arm(joints: int) -> cp.ScrewChain:
    """Return revolute joints across one another in turns, 0.15 m apart."""
    axes = []
    for i in range(joints):
        direction = np.array([0.1, 0.2, 1.0] if i % 2 == 0 else [0.2, 1.0, -0.1])
        point = [0.05, 0.1, 0.15 * (i - joints)]
        axes.append(cp.ScrewAxis(cp.JointType.revolute, cp.make_line(direction / np.linalg.norm(direction), point)))
    return cp.ScrewChain(axes, np.zeros(joints))


def log_of(joints: int, rounds: int, rate: float) -> cp.Recording:
    """Return rests and eq. (11) of every joint, 14 s each."""
    pieces = []
    for _ in range(rounds):
        for joint in range(joints):
            pieces.append(cp.SteppedSweep(joint=joint, steps=8, span=2.4, dwell=0.6, move=0.5))
            pieces.append(cp.RaisedCosine(joint=joint, span=2.4, frequency=0.5, duration=4.0))
    trajectory = cp.joint_trajectory(np.full(joints, -1.2), pieces, rate, 0.2)
    options = cp.SimulationOptions(noise_std=0.01, encoder_counts_per_revolution=np.full(joints, 262_144.0), seed=1)
    up = cp.STANDARD_GRAVITY * np.array([0.48, -0.6, 0.64])
    return cp.simulate(arm(joints), up, cp.AccelerometerModel(), trajectory, options)


def whole_arm_seconds(recording: cp.Recording, threads: int = 1) -> float:
    options = cp.WholeArmOptions()
    options.threads = threads
    return seconds(lambda: cp.calibrate_whole_arm(recording, cp.segment(recording), options))


def arms(
    against: str, sizes: Sequence[float], recordings: Callable[[float], cp.Recording], expected: float
) -> list[Growth]:
    """Time all three stages on the same recordings; against samples the sizes are theirs."""
    stages: dict[str, list[float]] = {"segment": [], "calibrate_joints": [], "calibrate_whole_arm": []}
    at: list[float] = []
    for size in sizes:
        recording = recordings(size)
        at.append(len(recording.time) if against == "samples" else size)
        segmentation = cp.segment(recording)
        stages["segment"].append(seconds(lambda r=recording: cp.segment(r)))
        stages["calibrate_joints"].append(seconds(lambda r=recording, s=segmentation: cp.calibrate_joints(r, s)))
        stages["calibrate_whole_arm"].append(whole_arm_seconds(recording))
    # A tested joint is a column more and rows more.
    exponents = {"calibrate_whole_arm": expected, "calibrate_joints": min(expected, 2.0), "segment": min(expected, 2.0)}
    return [Growth(name, against, at, values, expected=exponents[name]) for name, values in stages.items()]


def forward_kinematics(sizes: Sequence[int]) -> Growth:
    times = []
    for joints in sizes:
        q = np.random.default_rng(0).uniform(-3, 3, (2_000, joints))
        chain = arm(joints)
        times.append(best(lambda chain=chain, q=q: cp.forward_kinematics(chain, q)))
    return Growth("forward_kinematics, 2000 poses", "joints", list(sizes), times)


# Threads, by the clock on the wall


def threads(counts: Sequence[int]) -> list[Growth]:
    recording = log_of(7, 1, 500.0)
    segmentation = cp.segment(recording)

    def wall(call: Callable[[], object]) -> float:
        times = []
        for _ in range(3):
            start = time.perf_counter()
            call()
            times.append(time.perf_counter() - start)
        return min(times)

    def whole_arm(count: int) -> object:
        options = cp.WholeArmOptions()
        options.threads = count
        return cp.calibrate_whole_arm(recording, segmentation, options)

    def sums(count: int) -> object:
        with ThreadPoolExecutor(count) as pool:
            return list(pool.map(streamed_statistics, [16 * PIECE // count] * count))

    tasks = {"calibrate_whole_arm, wall clock": whole_arm, "joint_statistics in threads, wall clock": sums}
    return [
        Growth(name, "threads", list(counts), [wall(lambda n=n, task=task: task(n)) for n in counts], expected=-1)
        for name, task in tasks.items()
    ]


# Memory, each in a process of its own


def peak(task: Callable[..., float], *arguments: object) -> tuple[float, float]:
    """Return what the task returns, its seconds, and the peak (MB) above what the process held before."""
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        return pool.apply(_peak, (task, *arguments))


def _peak(task: Callable[..., float], *arguments: object) -> tuple[float, float]:
    pathlib.Path("/proc/self/clear_refs").write_text("5")  # the peak begins anew
    before = status("VmRSS")
    return task(*arguments), status("VmHWM") - before


def status(name: str) -> float:
    """Return a figure (MB) of /proc/self/status."""
    for line in pathlib.Path("/proc/self/status").read_text().splitlines():
        if line.startswith(name):
            return float(line.split()[1]) / 1024
    raise SystemExit(f"/proc/self/status has no {name}")


def write_log(path: pathlib.Path, rows: int) -> None:
    """Write a log of seven joints at 1 kHz, in pieces: the same motion over and over."""
    piece = log_of(7, 1, 1_000.0)
    position, force = (
        np.asarray(piece.joint_positions)[:PARQUET_PIECE],
        np.asarray(piece.specific_force)[:PARQUET_PIECE],
    )
    size = len(force)
    names = ["t", *(f"q{i + 1}" for i in range(7)), "ax", "ay", "az"]
    writer = None
    for begin in range(0, rows, size):
        n = min(size, rows - begin)
        columns = [np.arange(begin, begin + n) / 1_000.0, *position[:n].T, *force[:n].T]
        table = pa.table(dict(zip(names, columns, strict=True)))
        writer = writer or pq.ParquetWriter(path, table.schema, compression="zstd")
        writer.write_table(table)
    if writer is not None:
        writer.close()


def memory(streamed: Sequence[int], logged: Sequence[int]) -> list[Growth]:
    sums = [peak(streamed_statistics, n) for n in streamed]
    with tempfile.TemporaryDirectory() as folder:
        logs = []
        for n in logged:
            path = pathlib.Path(folder) / "log.parquet"
            write_log(path, n)
            logs.append(peak(read, str(path)))
            path.unlink()
    return [
        Growth("joint_statistics streamed", "samples", list(streamed), [t for t, _ in sums]),
        Growth(
            "joint_statistics streamed, peak memory",
            "samples",
            list(streamed),
            [max(m, 0.1) for _, m in sums],
            "MB",
            0.0,
        ),
        Growth("reading a log file", "samples", list(logged), [t for t, _ in logs]),
        Growth("reading a log file, peak memory", "samples", list(logged), [m for _, m in logs], "MB", 0.0),
    ]


def read(path: str) -> float:
    start = time.process_time()
    read_recording([path], load_arm(ARM_FILE))
    return time.process_time() - start


def plot(rows: Sequence[Growth], path: pathlib.Path) -> None:
    """Draw a panel for each thing grown, and one for memory."""
    panels = [("samples", "s"), ("tests", "s"), ("joints", "s"), ("threads", "s"), ("samples", "MB")]
    figure = Figure(figsize=(11, 9), layout="constrained")
    grid = figure.subplots(2, 3).ravel()
    for axes, (against, unit) in zip(grid, panels, strict=False):
        shown = [row for row in rows if (row.against, row.unit) == (against, unit)]
        for row in shown:
            axes.plot(row.sizes, row.values, "o-", markersize=3.5, label=f"{row.what} ({row.exponent:.2f})")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(against)
        axes.set_ylabel({"s": "seconds", "MB": "peak memory, MB"}[unit])
        axes.yaxis.set_minor_formatter(NullFormatter())
        if against != "samples":
            sizes = sorted({size for row in shown for size in row.sizes})
            axes.set_xticks(sizes, [f"{size:g}" for size in sizes])
            axes.xaxis.set_minor_locator(NullLocator())
        low, high = min(min(row.values) for row in shown), max(max(row.values) for row in shown)
        axes.set_ylim(10 ** np.floor(np.log10(low)), 10 ** np.ceil(np.log10(high)))
        axes.grid(alpha=0.3)
        axes.legend(fontsize=7, title="(exponent)", title_fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.15))
    grid[-1].set_axis_off()
    figure.savefig(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="smaller sizes, a minute")
    parser.add_argument("--out", type=pathlib.Path, help="folder for growth.json and growth.svg")
    options = parser.parse_args()
    quick = options.quick
    print("  ".join(f"{key}: {value}" for key, value in machine().items()), flush=True)
    rows: list[Growth] = []

    def report(new: Sequence[Growth]) -> None:
        for row in new:
            print(row.lines(), flush=True)
        rows.extend(new)

    report(kernels([10_000, 100_000, 1_000_000] if quick else [10_000, 100_000, 1_000_000, 10_000_000]))
    report(memory([10_000, 1_000_000, 10_000_000] if quick else [10_000, 100_000, 1_000_000, 10_000_000, 100_000_000],
                  [1_600_000, 3_200_000] if quick else [1_600_000, 3_200_000, 6_400_000]))  # fmt: skip
    # Samples alone: the same 200 s of motion at higher and higher rates.
    report(arms("samples", [100.0, 1_000.0] if quick else [100.0, 250.0, 1_000.0, 2_500.0, 10_000.0],
                lambda rate: log_of(7, 2, rate), 1.0))  # fmt: skip
    report(arms("tests", [7, 14] if quick else [7, 14, 28, 56], lambda tests: log_of(7, round(tests / 7), 250.0), 1.0))
    report(
        arms("joints", [2, 4, 8] if quick else [2, 4, 8, 15, 30], lambda joints: log_of(round(joints), 1, 100.0), 3.0)
    )
    report([forward_kinematics([2, 4, 8, 15, 30])])
    report(threads([1, 2]))
    if options.out is not None:
        options.out.mkdir(parents=True, exist_ok=True)
        document = {"machine": measuring.machine(), "rows": [asdict(row) | {"exponent": row.exponent} for row in rows]}
        (options.out / "growth.json").write_text(json.dumps(document, indent=1) + "\n")
        plot(rows, options.out / "growth.svg")


if __name__ == "__main__":
    main()
