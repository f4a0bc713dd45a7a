"""What `import circlepoint` gives, and what it says when the compiled part is not there."""

import shutil
import subprocess
import sys
from pathlib import Path

import circlepoint
from circlepoint import _core


def test_every_public_name_of_the_core_is_the_packages_own():
    assert {name for name in dir(_core) if not name.startswith("_")} == set(_core.__all__)
    for name in _core.__all__:
        assert getattr(circlepoint, name) is getattr(_core, name), name


def test_the_main_job_is_at_hand_and_every_public_name_is_there_once():
    assert {"load_arm", "read_recording", "check_recording", "load_sensor", "calibrate"} <= set(circlepoint.__all__)
    assert len(circlepoint.__all__) == len(set(circlepoint.__all__))
    assert all(hasattr(circlepoint, name) for name in circlepoint.__all__)
    assert circlepoint.calibrate.__module__ == "circlepoint.calibration"


def test_a_package_without_its_compiled_part_says_what_to_do(tmp_path):
    package = tmp_path / "circlepoint"
    shutil.copytree(Path(circlepoint.__file__).parent, package, ignore=shutil.ignore_patterns("_core*", "__pycache__"))
    run = subprocess.run(
        [sys.executable, "-c", "import circlepoint"],
        env={"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode != 0
    last = run.stderr.splitlines()[-1]
    assert last.startswith("ModuleNotFoundError: circlepoint._core")
    assert str(package) in last
    assert "pip install ." in last
