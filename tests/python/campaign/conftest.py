"""A campaign of a small arm, some milliseconds a trial, and a cluster of this machine."""

import pytest
from campaign_support import write_campaign

from circlepoint.cli import main


@pytest.fixture
def config(tmp_path):
    return write_campaign(tmp_path)


@pytest.fixture
def change(config):
    """Rewrite the campaign's file with one text in place of another."""

    def replace(old, new):
        text = config.read_text()
        assert old in text
        config.write_text(text.replace(old, new, 1))
        return config

    return replace


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """The campaign, run in one go by one thread; not to be changed."""
    root = tmp_path_factory.mktemp("finished")
    out = root / "out"
    assert main(["campaign", str(write_campaign(root)), "--out", str(out), "--workers", "1"]) == 0
    return out


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory):
    """Address of a cluster of two workers; it gives a task up that has cost two, and soon sees that one is gone."""
    pytest.importorskip("distributed")
    import dask
    import distributed

    soon = {"distributed.scheduler.allowed-failures": 1, "distributed.comm.timeouts.connect": "2s"}
    with (
        dask.config.set(soon),
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            dashboard_address=":0",
            local_directory=str(tmp_path_factory.mktemp("dask")),
        ) as running,
    ):
        yield running.scheduler_address
