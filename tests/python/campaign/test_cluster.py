"""A campaign on a Dask cluster of this machine: the same bytes, a worker killed midway or not."""

import os
import signal

import pytest
from campaign_support import contents

import circlepoint as cp
from circlepoint.campaign.config import load_campaign
from circlepoint.campaign.run import batch_path, run_campaign
from circlepoint.cli import main

distributed = pytest.importorskip("distributed")


@pytest.fixture
def cluster(tmp_path):
    # Dask's own, on the way up and down: it uses what newer Pythons deprecate.
    with distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=True,
        dashboard_address=None,
        local_directory=str(tmp_path / "dask"),
    ) as running:
        yield running


def test_a_lost_worker_does_not_change_a_byte(change, config, tmp_path, cluster):
    change("trials: 6", "trials: 12")
    change("file: arm.yaml", f"file: {config.parent / 'arm.yaml'}")
    campaign = load_campaign(config)
    run_campaign(campaign, tmp_path / "here", workers=2)
    lost = []

    class Killer:
        def begin(self, _total, _finished):
            pass

        def advance(self, _trials):
            if not lost:
                with distributed.Client(cluster.scheduler_address, set_as_default=False) as client:
                    pids = client.run(os.getpid)
                lost.append(next(iter(pids.values())))
                os.kill(lost[0], signal.SIGKILL)

    run_campaign(campaign, tmp_path / "there", scheduler=cluster.scheduler_address, watcher=Killer())
    assert len(lost) == 1
    assert contents(tmp_path / "there") == contents(tmp_path / "here")

    # What is finished is not run again, on a cluster or not.
    batch = list(campaign.batches())[7]
    batch_path(tmp_path / "there", batch).unlink()
    out = ["--out", str(tmp_path / "there"), "--scheduler", cluster.scheduler_address]
    assert main(["campaign", str(config), *out]) == 0
    assert main(["campaign", str(config), "--out", str(tmp_path / "here")]) == 0
    assert contents(tmp_path / "there") == contents(tmp_path / "here")


def test_a_scheduler_that_is_not_there_is_named(config, tmp_path, monkeypatch):
    monkeypatch.setattr("circlepoint.campaign.cluster._connect_seconds", 0.3)
    with pytest.raises(cp.InvalidInput, match=r"--scheduler tcp://127.0.0.1:9: no Dask scheduler answers there"):
        run_campaign(load_campaign(config), tmp_path / "out", scheduler="tcp://127.0.0.1:9")
