"""Fixtures shared by every test."""

import os
from pathlib import Path

import pytest

SHARED_DATA = Path(os.environ.get("CIRCLEPOINT_SHARED_DATA", Path(__file__).resolve().parents[3] / "shared" / "data"))


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Recordings nobody here made, where the machine has them."""
    if not SHARED_DATA.is_dir():
        pytest.skip("no shared recordings beside this checkout")
    return SHARED_DATA
