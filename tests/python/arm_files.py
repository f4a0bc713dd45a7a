"""Arms' descriptions that several tests write and read."""

from circlepoint.arm import load_arm

TWO_TURNS = """\
name: two
joints:
  - {name: pan, type: revolute}
  - {name: tilt, type: revolute}
dh:
  convention: standard
  rows:
    - {a: 0.0, alpha: 1.5707963267948966, d: 0.3, theta: 0.0}
    - {a: 0.25, alpha: 0.0, d: 0.0, theta: 0.0}
encoder: {counts_per_revolution: 400000}
"""


def arm_of(folder, **joints):
    """Read an arm of joints given as name=type, base to tip, without nominal parameters."""
    path = folder / "arm.yaml"
    rows = "".join(f"  - {{name: {name}, type: {kind}}}\n" for name, kind in joints.items())
    path.write_text(f"name: arm\njoints:\n{rows}")
    return load_arm(path)
