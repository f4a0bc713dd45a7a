"""Where the example campaign is, what a campaign's folder holds, and work that takes its process down."""

import os
import resource
import signal
from contextlib import contextmanager
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from circlepoint.campaign.fleet import calibrate_log
from circlepoint.campaign.run import run_bundled

EXAMPLE = Path(__file__).parents[2] / "examples" / "campaign"
CONFIG = """\
arm: {file: arm.yaml, up: [0.4, -0.3, 0.8]}
sensor: qa700
plan: plan.yaml
noise: {vibration: [0.0, 0.05]}
method: [joint, velocity]
trials: 6
seed: 3
batch: 4
"""
PLAN = """\
rate_hz: 125
rest_deg: -60
pause: 0.4
tests:
  - joint: all
    static: {steps: 4, span_deg: 100, dwell: 0.6, move: 0.4, return: 0.8}
    dynamic: {frequency_hz: 0.5, span_deg: 100, duration: 2}
"""


def write_campaign(folder):
    """Write a campaign's file and those it names; return it."""
    (folder / "arm.yaml").write_text((EXAMPLE / "arm.yaml").read_text())
    (folder / "plan.yaml").write_text(PLAN)
    path = folder / "campaign.yaml"
    path.write_text(CONFIG)
    return path


def contents(folder):
    """Bytes of every file that is a result."""
    kept = (".parquet", ".json", ".svg", ".png")
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.suffix in kept and not path.name.startswith(".")
    }


def table_of(folder, cell):
    """The table of a cell, all batches."""
    return pa.concat_tables(pq.read_table(path) for path in sorted(folder.glob(f"trials/cell-{cell:04d}/*.parquet")))


def calibrate_or_die(log, scratch=None):
    """Calibrate a log; the one named d takes its process down."""
    if log.name == "d":
        os.kill(os.getpid(), signal.SIGKILL)
    return calibrate_log(log, scratch)


def calibrate_on_worker_or_die(_, log):
    """The same on a worker of a cluster."""
    return calibrate_or_die(log)


def run_batch_or_die(bundle, batch):
    """Run a batch; the second one of the second cell takes its worker down."""
    if (batch.cell, batch.index) == (1, 1):
        os.kill(os.getpid(), signal.SIGKILL)
    return run_bundled(bundle, batch)


@contextmanager
def files_no_larger_than(size):
    """Have the system refuse to write more than so many bytes into a file, as it does on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
