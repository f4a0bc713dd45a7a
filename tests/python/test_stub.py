"""The type stub that is shipped is that of the compiled core."""

import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
SHIPPED = HERE.parents[1] / "python" / "circlepoint" / "_core.pyi"


def test_generating_the_type_stub_again_changes_nothing(tmp_path):
    pytest.importorskip("pybind11_stubgen")
    generated = tmp_path / "_core.pyi"
    subprocess.run([sys.executable, HERE / "core_stub.py", generated], check=True)
    assert generated.read_text(encoding="utf-8") == SHIPPED.read_text(encoding="utf-8"), "run `make stub`"
