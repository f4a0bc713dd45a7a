"""A campaign on a Dask cluster of this machine: the same bytes, workers killed midway or not."""

import os
import signal

import pytest
from campaign_support import contents, run_batch_or_die

import circlepoint as cp
from circlepoint.campaign.config import load_campaign
from circlepoint.campaign.run import batch_path, run_campaign
from circlepoint.cli import main

distributed = pytest.importorskip("distributed")


def test_a_lost_worker_does_not_change_a_byte(change, config, tmp_path, scheduler):
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
                with distributed.Client(scheduler, set_as_default=False) as client:
                    pids = client.run(os.getpid)
                lost.append(next(iter(pids.values())))
                os.kill(lost[0], signal.SIGKILL)

        def tell(self, message):
            raise AssertionError(message)

    run_campaign(campaign, tmp_path / "there", scheduler=scheduler, watcher=Killer())
    assert len(lost) == 1
    assert contents(tmp_path / "there") == contents(tmp_path / "here")

    # What is finished is not run again, on a cluster or not.
    batch = list(campaign.batches())[7]
    batch_path(tmp_path / "there", batch).unlink()
    out = ["--out", str(tmp_path / "there"), "--scheduler", scheduler]
    assert main(["campaign", str(config), *out]) == 0
    assert main(["campaign", str(config), "--out", str(tmp_path / "here")]) == 0
    assert contents(tmp_path / "there") == contents(tmp_path / "here")


def test_a_batch_that_kills_its_workers_is_named_and_costs_no_other(config, finished, tmp_path, scheduler, monkeypatch):
    out, campaign = tmp_path / "out", load_campaign(config)
    with monkeypatch.context() as patched:
        patched.setattr("circlepoint.campaign.run.run_bundled", run_batch_or_die)
        with pytest.raises(cp.InvalidInput) as caught:
            run_campaign(campaign, out, scheduler=scheduler)
    message = str(caught.value)
    named = "cell 1 (arm, qa700, plan, vibration 0, velocity), trials 4 to 5: every worker"
    assert [word for word in (str(config), named, "more memory", "run it again") if word not in message] == []
    missing = [batch for batch in campaign.batches() if not batch_path(out, batch).exists()]
    assert [(batch.cell, batch.index) for batch in missing] == [(1, 1)]
    assert main(["campaign", str(config), "--out", str(out), "--scheduler", scheduler]) == 0
    assert contents(out) == contents(finished)


def test_a_cluster_without_workers_is_told_of_and_waited_for(config, tmp_path, monkeypatch):
    monkeypatch.setattr("circlepoint.campaign.cluster._patience_seconds", 0.2)
    told = []

    class Waiter:
        def begin(self, _total, _finished):
            pass

        def advance(self, _trials):
            pass

        def tell(self, message):
            told.append(message)
            cluster.scale(1)

    with distributed.LocalCluster(
        n_workers=0, threads_per_worker=1, processes=False, dashboard_address=":0"
    ) as cluster:
        summary = run_campaign(
            load_campaign(config), tmp_path / "out", scheduler=cluster.scheduler_address, watcher=Waiter()
        )
    assert told == [f"--scheduler {cluster.scheduler_address}: it has no workers; waiting for some"]
    assert [cell["trials"] for cell in summary["cells"]] == [6] * 4


def test_a_scheduler_that_is_not_there_is_named(config, tmp_path, monkeypatch):
    monkeypatch.setattr("circlepoint.campaign.cluster._connect_seconds", 0.3)
    with pytest.raises(cp.InvalidInput, match=r"--scheduler tcp://127.0.0.1:9: no Dask scheduler answers there"):
        run_campaign(load_campaign(config), tmp_path / "out", scheduler="tcp://127.0.0.1:9")
