"""A campaign of a small arm, some milliseconds a trial."""

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
