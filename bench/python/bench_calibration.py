"""Times complete calibrations against careful NumPy + SciPy, and forward kinematics against Pinocchio and KDL.

  single joint   rests and eq. (11) of one joint, readings in memory to its axis with covariance
  whole arm      the demonstration's arm, seven joints, 1e5 samples at 500 Hz, to all lines and the sensor's errors;
                 ours finds the tests and its start values itself, estimates the noise's colour, holds every stretch
                 out once and names what the data do not show. SciPy's starts at the nominal arm and does none of it.
  forward kinematics of many configurations of the seven joints

The answers are compared before the times: both within 5 standard deviations of the truth, or this program fails.
"""

import argparse
import pathlib

import measuring
import numpy as np
import numpy_calibration
from measuring import HEADING, Row, compared, machine

import circlepoint as cp
from circlepoint.arm import load_arm
from circlepoint.demo import ARM_FILE, built_arm
from circlepoint.nominal import nominal_chain
from circlepoint.sensor_presets import load_sensor

try:
    import pinocchio
except ModuleNotFoundError:
    pinocchio = None
try:
    import PyKDL
except ModuleNotFoundError:
    PyKDL = None

JOINTS = 7
RATE = 500.0
START = np.full(JOINTS, -1.2)
UP = cp.STANDARD_GRAVITY * np.array([0.36, 0.48, 0.80])
COUNTS = 400_000.0
CUTOFF = 10.0
SPAN = np.radians(150.0)
MOST_STD = 5.0


def recording_of(joints: list[int], rounds: int, chain: cp.ScrewChain, sensor: cp.AccelerometerModel) -> cp.Recording:
    pieces = []
    for _ in range(rounds):
        for joint in joints:
            pieces.append(cp.SteppedSweep(joint=joint, steps=16, span=SPAN, dwell=0.8, move=0.6))
            pieces.append(cp.RaisedCosine(joint=joint, span=SPAN, frequency=0.5, duration=4.0))
    options = cp.SimulationOptions(noise_std=0.01, encoder_counts_per_revolution=np.full(JOINTS, COUNTS), seed=1)
    return cp.simulate(chain, UP, sensor, cp.joint_trajectory(START, pieces, RATE, 0.6), options)


def worst(estimated: list[cp.Line], true: list[cp.Line], std: np.ndarray) -> float:
    """Return the largest error of a line's coordinates in standard deviations."""
    errors = [cp.local_coordinates(mine, theirs) for mine, theirs in zip(estimated, true, strict=True)]
    return float(np.max(np.abs(np.array(errors)) / std.reshape(-1, 4)))


def agree(name: str, ours: float, theirs: float) -> None:
    print(f"{name}: largest error of a line {ours:.1f} standard deviations, NumPy + SciPy {theirs:.1f}")
    if max(ours, theirs) > MOST_STD:
        raise SystemExit(f"{name}: an answer is wrong; its time means nothing")


def single_joint(budget: float) -> Row:
    chain = built_arm(load_arm(ARM_FILE), START, 1)
    joint = JOINTS - 1
    recording = recording_of([joint], 1, chain, cp.AccelerometerModel())
    options = cp.JointCalibrationOptions()
    options.reference_configuration = START

    def ours() -> cp.JointCalibration:
        return cp.calibrate_joints(recording, cp.segment(recording), options)

    def theirs() -> cp.Line:
        return numpy_calibration.single_joint(recording, joint, CUTOFF)

    true = chain.axes[joint].line
    estimate = ours().joints[joint]
    std = np.sqrt(np.diag(estimate.axis.covariance))
    agree("single joint", worst([estimate.axis.screw.line], [true], std), worst([theirs()], [true], std))
    return compared("single joint", "NumPy + SciPy", (len(recording.time), 3), "C", ours, theirs, {}, budget)


def whole_arm(rounds: int, budget: float) -> Row:
    chain = built_arm(load_arm(ARM_FILE), START, 1)
    nominal = nominal_chain(load_arm(ARM_FILE), START)
    specification = load_sensor("qa700")
    recording = recording_of(list(range(JOINTS)), rounds, chain, cp.draw_accelerometer(specification, 1))
    options = cp.WholeArmOptions()
    options.sensor = specification
    options.threads = 1
    options.reference_configuration = START
    options.encoder_resolution = np.full(JOINTS, 2 * np.pi / COUNTS)

    def ours() -> cp.WholeArmCalibration:
        return cp.calibrate_whole_arm(recording, cp.segment(recording), options)

    def theirs() -> numpy_calibration.WholeArm:
        return numpy_calibration.whole_arm(recording, nominal, specification, CUTOFF)

    true = [axis.line for axis in chain.axes]
    mine, other = ours(), theirs()
    std = np.array([p.std for p in mine.parameters if p.name.startswith("joint")])
    agree(
        "whole arm", worst([axis.line for axis in mine.joints.chain().axes], true, std), worst(other.lines, true, std)
    )
    print(f"whole arm: {mine.rows} rows, {mine.iterations} iterations; NumPy + SciPy {3 * other.rows} rows, "
          f"{other.evaluations} evaluations and as many Jacobians at most")  # fmt: skip
    samples = len(recording.time)
    return compared("whole arm", "NumPy + SciPy", (samples, JOINTS + 3), "C", ours, theirs, {}, budget, fewest=3)


def forward_kinematics(poses: int, budget: float) -> list[Row]:
    chain = built_arm(load_arm(ARM_FILE), START, 1)
    configurations = np.random.default_rng(0).uniform(-3, 3, (poses, JOINTS))
    expected = cp.forward_kinematics(chain, configurations)
    rows = []

    def against(name: str, call: measuring.Call) -> None:
        np.testing.assert_allclose(call(), expected, rtol=0, atol=1e-9)
        rows.append(compared("forward kinematics", name, (poses, JOINTS), "C",
                             lambda: cp.forward_kinematics(chain, configurations), call, {}, budget))  # fmt: skip

    if pinocchio is not None:
        model, sensor = pinocchio_model(chain)
        data = model.createData()

        def with_pinocchio() -> np.ndarray:
            poses_of = np.empty((poses, 4, 4))
            for i, q in enumerate(configurations):
                pinocchio.framesForwardKinematics(model, data, q)
                poses_of[i] = data.oMf[sensor].homogeneous
            return poses_of

        against("Pinocchio in a loop", with_pinocchio)
    if PyKDL is not None:
        solver, joints = kdl_solver(chain)

        def with_kdl() -> np.ndarray:
            poses_of = np.empty((poses, 4, 4))
            frame = PyKDL.Frame()
            for i, q in enumerate(configurations):
                for k in range(JOINTS):
                    joints[k] = q[k]
                solver.JntToCart(joints, frame)
                poses_of[i] = [[frame[r, c] for c in range(4)] for r in range(3)] + [[0, 0, 0, 1]]
            return poses_of

        against("PyKDL in a loop", with_kdl)
    return rows


def link_frames(chain: cp.ScrewChain) -> list[np.ndarray]:
    """Return a frame on each joint's axis (z along it) and the sensor's, in the base frame, at configuration zero."""
    reference = np.asarray(chain.reference_configuration)
    frames = []
    for joint, axis in enumerate(chain.axes):
        z = np.asarray(axis.line.direction)
        x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
        x /= np.linalg.norm(x)
        frame = np.eye(4)
        frame[:3, 0], frame[:3, 1], frame[:3, 2], frame[:3, 3] = x, np.cross(z, x), z, np.asarray(axis.line.point)
        # Carried to zero by the joints before it: the pose of the tip with those at zero, the rest at the reference.
        mixed = reference.copy()
        mixed[:joint] = 0.0
        frames.append(
            cp.forward_kinematics(chain, mixed[None])[0]
            @ np.linalg.inv(cp.forward_kinematics(chain, reference[None])[0])
            @ frame
        )
    frames.append(cp.forward_kinematics(chain, np.zeros((1, JOINTS)))[0])
    return frames


def pinocchio_model(chain: cp.ScrewChain) -> tuple[object, int]:
    frames = link_frames(chain)
    model = pinocchio.Model()
    before, parent = np.eye(4), 0
    for joint, at_reference in enumerate(frames[:-1]):
        # About its own axis from the reference to zero.
        angle = -float(np.asarray(chain.reference_configuration)[joint])
        turned = at_reference @ rotation_z(angle)
        placement = pinocchio.SE3(np.linalg.inv(before) @ turned)
        parent = model.addJoint(parent, pinocchio.JointModelRZ(), placement, f"joint{joint + 1}")
        before = turned
    placement = pinocchio.SE3(np.linalg.inv(before) @ frames[-1])
    return model, model.addFrame(pinocchio.Frame("sensor", parent, placement, pinocchio.FrameType.OP_FRAME))


def kdl_solver(chain: cp.ScrewChain) -> tuple[object, object]:
    frames = link_frames(chain)
    arm = PyKDL.Chain()
    reference = np.asarray(chain.reference_configuration)
    turned = [frame @ rotation_z(-float(q)) for frame, q in zip(frames[:-1], reference, strict=True)]
    arm.addSegment(PyKDL.Segment(PyKDL.Joint(PyKDL.Joint.Fixed), kdl_frame(turned[0])))
    for frame, after in zip(turned, [*turned[1:], frames[-1]], strict=True):
        arm.addSegment(PyKDL.Segment(PyKDL.Joint(PyKDL.Joint.RotZ), kdl_frame(np.linalg.inv(frame) @ after)))
    return PyKDL.ChainFkSolverPos_recursive(arm), PyKDL.JntArray(JOINTS)


def kdl_frame(pose: np.ndarray) -> object:
    return PyKDL.Frame(PyKDL.Rotation(*pose[:3, :3].ravel()), PyKDL.Vector(*pose[:3, 3]))


def rotation_z(angle: float) -> np.ndarray:
    turn = np.eye(4)
    turn[0, 0] = turn[1, 1] = np.cos(angle)
    turn[1, 0], turn[0, 1] = np.sin(angle), -np.sin(angle)
    return turn


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=1, help="of the whole arm's tests, 1e5 samples each")
    parser.add_argument("--budget", type=float, default=10.0, help="seconds a comparison")
    parser.add_argument("--out", type=pathlib.Path, help="folder for calibration.json and calibration.svg")
    options = parser.parse_args()
    print("  ".join(f"{key}: {value}" for key, value in machine().items()))
    rows = [single_joint(options.budget), whole_arm(options.rounds, options.budget)]
    rows += forward_kinematics(1_000, options.budget)
    print(HEADING)
    for row in rows:
        print(row.line())
    if options.out is not None:
        measuring.keep(options.out, "calibration", rows)


if __name__ == "__main__":
    main()
