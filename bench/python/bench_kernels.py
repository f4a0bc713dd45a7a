"""Times circlepoint's kernels against what a user would pick instead, and against the machine's limits.

The limits are measured in the same run: a fresh copy of the same array; fresh memory of its size filled once, which
is page faults for the most part; reading it once (BLAS dot); and the latency of the filter's recursion (one channel
through one section, in the first-level cache, where nothing else takes time). A limit is printed as its share of ours.

The normal equations of one joint's test ("rotate, project, accumulate") are compared with three ways to write them:
  NumPy, by samples    readings turned to the joint's frame by every sample's own rotation and projected to the plane of
                       motion (einsum), a (2 n, 6) matrix of gravity, lever and bias, and its products: the paper's text
  NumPy, regressors    the same sums by five regressors that all channels share: the insight is the reader's own
  Numba                the latter in one loop
All are checked to determine the same lever before they are timed.
"""

import argparse
import pathlib
from collections.abc import Callable

import measuring
import numpy as np
import scipy.integrate
import scipy.optimize
import scipy.signal
from measuring import HEADING, Call, Row, available_bytes, compared, interleaved, machine, numba

import circlepoint as cp

RATE = 500.0
SOS = cp.butter(4, 20.0, RATE)
ONE_SECTION = cp.butter(2, 20.0, RATE)
POSES = 150
HOLDS_AT_ONCE = 12  # arrays of the size of the argument that SciPy's Simpson rule holds at once, with some to spare


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
    limits: dict[str, dict[str, Call | float]] = {
        "recursion": {"recursion": 2 * samples * latency, "fresh memory": lambda: np.full_like(x, 1.0)},
        "copy": {"copy": x.copy},
        "read": {"read": lambda: np.dot(x.ravel(), x.ravel())},
    }
    table: list[tuple[str, Call, Call, str]] = [
        ("sosfiltfilt order 4", lambda: cp.sosfiltfilt(SOS, c(a)),
         lambda: scipy.signal.sosfiltfilt(SOS, a, axis=0), "recursion"),
        ("cumulative_trapezoid", lambda: cp.cumulative_trapezoid(c(a), dx=0.002, initial=0),
         lambda: scipy.integrate.cumulative_trapezoid(a, dx=0.002, axis=0, initial=0), "copy"),
        ("cumulative_simpson", lambda: cp.cumulative_simpson(c(a), dx=0.002, initial=0),
         lambda: scipy.integrate.cumulative_simpson(a, dx=0.002, axis=0, initial=0), "copy"),
        ("savgol_filter 21, 3", lambda: cp.savgol_filter(c(a), 21, 3),
         lambda: scipy.signal.savgol_filter(a, 21, 3, axis=0), "copy"),
        ("welch 256", lambda: cp.welch(c(a), RATE), lambda: scipy.signal.welch(a, RATE, axis=0), "read"),
    ]  # fmt: skip
    return [
        compared(kernel, "SciPy", (samples, channels), order, ours, theirs, limits[limit], budget)
        for kernel, ours, theirs, limit in table
    ]


def regression_rows(samples: int, budget: float) -> list[Row]:
    random = np.random.default_rng(1)
    angle, rate, acceleration = random.uniform(-3, 3, samples), random.normal(size=samples), random.normal(size=samples)
    rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]  # sensor to the joint's frame, z its axis
    lever, gravity, bias = np.array([0.3, -0.2]), np.array([5.0, 7.0]), np.array([0.01, -0.02])
    regressors = np.column_stack([np.ones(samples), np.cos(angle), np.sin(angle), acceleration, rate**2])
    in_plane = regressors @ coefficients(gravity, lever, bias)
    planar = np.column_stack([in_plane, np.full(samples, 3.0)]) + 0.01 * random.normal(size=(samples, 3))
    readings = planar @ rotation
    everything = np.ones(6 * samples)  # written: fresh zeros would all be one page, in the cache
    del regressors, in_plane, planar

    def by_samples() -> tuple[np.ndarray, np.ndarray]:
        cosine, sine = np.cos(angle), np.sin(angle)
        turn = np.empty((samples, 2, 2))
        turn[:, 0, 0], turn[:, 0, 1], turn[:, 1, 0], turn[:, 1, 1] = cosine, -sine, sine, cosine
        y = np.einsum("nij,nj->ni", turn, readings @ rotation[:2].T)  # in the frame that stands still
        jacobian = np.zeros((samples, 2, 6))
        jacobian[:, 0, 0] = jacobian[:, 1, 1] = 1.0
        local = np.empty((samples, 2, 2))
        local[:, 0, 0] = local[:, 1, 1] = -(rate**2)
        local[:, 0, 1], local[:, 1, 0] = -acceleration, acceleration
        jacobian[:, :, 2:4] = np.einsum("nij,njk->nik", turn, local)
        jacobian[:, :, 4:6] = turn
        a = jacobian.reshape(-1, 6)
        return a.T @ a, a.T @ y.ravel()

    def by_regressors() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        x = np.column_stack([np.ones(samples), np.cos(angle), np.sin(angle), acceleration, rate**2])
        y = readings @ rotation.T
        return x.T @ x, x.T @ y, (y**2).sum(axis=0)

    def ours() -> cp.RegressionStatistics:
        return cp.joint_statistics(angle, rate, acceleration, readings, rotation)

    def reading() -> object:
        return np.dot(everything, everything)

    statistics = ours()
    expected = np.linalg.solve(*by_samples())[2:4]
    for information, score in [(statistics.information, statistics.score), by_regressors()[:2]]:
        np.testing.assert_allclose(lever_of(information, score), expected, rtol=1e-9)
    rows = {"NumPy, by samples": by_samples, "NumPy, regressors": by_regressors}
    if numba is not None:
        fused = numba_statistics()
        np.testing.assert_allclose(
            fused(angle, rate, acceleration, readings, rotation)[1], statistics.score, rtol=1e-6, atol=1e-6
        )
        rows["Numba"] = lambda: fused(angle, rate, acceleration, readings, rotation)
    return [
        compared("normal equations", name, (samples, 3), "C", ours, theirs, {"read": reading}, budget)
        for name, theirs in rows.items()
    ]


def coefficients(gravity: np.ndarray, lever: np.ndarray, bias: np.ndarray) -> np.ndarray:
    """Return the (5, 2) coefficients of 1, cos, sin, acceleration and rate^2 in the plane of motion."""
    return np.array([bias, gravity, [gravity[1], -gravity[0]], [-lever[1], lever[0]], -lever])


def lever_of(information: np.ndarray, score: np.ndarray) -> np.ndarray:
    """Solve the five regressors' sums for gravity, lever and bias: the coefficients are linear in them."""
    linear = np.array([coefficients(p[:2], p[2:4], p[4:]).T.ravel() for p in np.eye(6)]).T
    return np.linalg.solve(linear.T @ np.kron(np.eye(2), information) @ linear, linear.T @ score[:, :2].T.ravel())[2:4]


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

    return [
        compared("fit_axis_direction", against, (POSES, 3), "C", ours, theirs, {}, budget)
        for against, theirs in [("SciPy least_squares", with_least_squares), ("NumPy SVD", with_svd)]
    ]


def two_recordings(samples: int, latency: float, budget: float) -> Row:
    """Two recordings of three channels side by side in one array against SciPy on each."""
    x = np.random.default_rng(0).normal(size=(samples, 6))
    apart = [np.ascontiguousarray(x[:, :3]), np.ascontiguousarray(x[:, 3:])]

    def theirs() -> object:
        return [scipy.signal.sosfiltfilt(SOS, y, axis=0) for y in apart]

    limits: dict[str, Call | float] = {"recursion": 2 * samples * latency}
    return compared(
        "sosfiltfilt order 4",
        "SciPy, two at once",
        (samples, 6),
        "C",
        lambda: cp.sosfiltfilt(SOS, x),
        theirs,
        limits,
        budget,
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    sizes = [5_000, 1_000_000, 10_000_000]
    parser.add_argument("--samples", type=lambda text: int(float(text)), nargs="+", default=sizes)
    parser.add_argument("--channels", type=int, nargs="+", default=[3, 10])
    parser.add_argument("--orders", nargs="+", choices=["C", "F"], default=["C", "F"])
    parser.add_argument("--values", type=float, default=np.inf, help="samples x channels at most")
    parser.add_argument("--budget", type=float, default=4.0, help="seconds a comparison (at least 5 rounds)")
    parser.add_argument("--out", type=pathlib.Path, help="folder for kernels.json and kernels.svg")
    options = parser.parse_args()

    latency = recursion_latency()
    print("  ".join(f"{key}: {value}" for key, value in machine().items()))
    print(f"recursion {1e9 * latency:.2f} ns a sample and direction")
    print(HEADING)
    rows: list[Row] = []

    def report(new: list[Row]) -> None:
        for row in new:
            print(row.line(), flush=True)
        rows.extend(new)
        if options.out is not None:  # after each size: the long ones take minutes
            measuring.keep(options.out, "kernels", rows, recursion_ns=1e9 * latency)

    report(axis_rows(options.budget))
    report([two_recordings(5_000, latency, options.budget)])
    for samples in options.samples:
        report(regression_rows(samples, options.budget))
        for channels in options.channels:
            if samples * channels > options.values:
                print(f"{samples:.0e} x {channels} left out, as asked")
                continue
            needed = HOLDS_AT_ONCE * 8 * samples * channels
            if needed > available_bytes():
                print(f"{samples:.0e} x {channels} needs {needed / 1e9:.0f} GB with SciPy's temporaries, "
                      f"{available_bytes() / 1e9:.0f} GB are free: left out")  # fmt: skip
                continue
            for order in options.orders:
                report(signal_rows(samples, channels, order, latency, options.budget))


if __name__ == "__main__":
    main()
