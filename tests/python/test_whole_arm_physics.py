"""The whole-arm estimate of an arm in a physics engine: heavy links on servos, which give way by up to 17 counts."""

import mujoco
import numpy as np
import pytest

import circlepoint as cp
from circlepoint.arm import load_arm
from circlepoint.demo import ARM_FILE, built_arm
from circlepoint.sensor_presets import load_sensor

START = np.full(7, -1.2)
UP = cp.STANDARD_GRAVITY * np.array([0.36, 0.48, 0.80])
COUNT = 2.0 * np.pi / 4096.0
PERCUSSION_DISTANCE = 0.0182
ENGINE_RATE, LOG_RATE = 1000, 250
MASS = np.array([4.0, 5.0, 3.5, 3.0, 2.0, 1.5, 0.8])  # kg
STIFFNESS = 6000.0 / np.array([1.0, 1.5, 2.0, 2.6, 0.7, 0.3, 1.0])  # N m/rad
TIME_CONSTANT = 0.03  # s, damping over stiffness


def numbers(values) -> str:
    return " ".join(repr(float(value)) for value in values)


def servo_arm(chain: cp.ScrewChain, random: np.random.Generator) -> mujoco.MjModel:
    """The chain with links and servos; positions are relative to its reference configuration."""
    points = [np.asarray(axis.line.point) for axis in chain.axes] + [np.zeros(3)]
    body, servos = "", ""
    for i in reversed(range(chain.size())):
        centre = 0.5 * (points[i] + points[i + 1]) + 0.03 * random.normal(size=3)
        inertia = MASS[i] * random.uniform(0.004, 0.006, 3)
        body = (
            f'<body><joint name="j{i}" type="hinge" axis="{numbers(chain.axes[i].line.direction)}" '
            f'pos="{numbers(points[i])}" armature="0.05"/>'
            f'<inertial pos="{numbers(centre)}" mass="{MASS[i]}" diaginertia="{numbers(inertia)}"/>{body}</body>'
        )
        servos = f'<position joint="j{i}" kp="{STIFFNESS[i]}" kv="{TIME_CONSTANT * STIFFNESS[i]}"/>{servos}'
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian"/><option gravity="{numbers(-UP)}" timestep="{1.0 / ENGINE_RATE}" '
        f'integrator="implicitfast"><flag contact="disable"/></option><worldbody>{body}</worldbody>'
        f"<actuator>{servos}</actuator></mujoco>"
    )


def recorded(chain: cp.ScrewChain, seed: int, exact: int | None = None) -> cp.Recording:
    """Ten rests and eq. (11) of each joint in turn, as the engine has the joints move; one encoder may be exact."""
    random = np.random.default_rng(seed)
    pieces = []
    for joint in range(7):
        pieces.append(cp.SteppedSweep(joint=joint, steps=10, span=np.radians(150.0), dwell=0.8, move=0.6))
        pieces.append(cp.RaisedCosine(joint=joint, span=np.radians(150.0), frequency=0.5, duration=4.0))
    start = START + random.uniform(-COUNT, COUNT, 7)  # each joint elsewhere within its count
    wanted = np.asarray(cp.joint_trajectory(start, pieces, float(ENGINE_RATE), 1.0).position) - START
    model = servo_arm(chain, random)
    data = mujoco.MjData(model)
    data.qpos[:] = wanted[0]
    data.ctrl[:] = wanted[0]
    for _ in range(2 * ENGINE_RATE):
        mujoco.mj_step(model, data)
    position = np.empty_like(wanted)
    for row, aim in zip(position, wanted, strict=True):
        row[:] = data.qpos
        data.ctrl[:] = aim
        mujoco.mj_step(model, data)
    position += START
    velocity = np.gradient(position, 1.0 / ENGINE_RATE, axis=0)
    acceleration = np.gradient(velocity, 1.0 / ENGINE_RATE, axis=0)
    shown = slice(0, None, ENGINE_RATE // LOG_RATE)
    readings = []
    for q, rate, change in zip(position[shown], velocity[shown], acceleration[shown], strict=True):
        motion = cp.frame_motion(chain, q, rate, change)
        squares = np.asarray(motion.angular_velocity_sensor) ** 2
        readings.append(cp.specific_force(motion, UP) - PERCUSSION_DISTANCE * (squares.sum() - squares))
    reading = np.asarray(readings) + 1e-3 * random.normal(size=(len(readings), 3))
    time = np.arange(len(reading)) / LOG_RATE
    counted = COUNT * np.round(position[shown] / COUNT)
    if exact is not None:
        counted[:, exact] = position[shown, exact]
    return cp.make_recording(time, counted, reading)


@pytest.mark.parametrize(("seed", "exact"), [(0, None), (1, 6)])
def test_coarse_encoders_on_joints_that_give_way_leave_half_a_millimetre(seed, exact):
    chain = built_arm(load_arm(ARM_FILE), START, 1)
    recording = recorded(chain, seed, exact)
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    options.encoder_resolution = np.where(np.arange(7) == exact, 0.0, COUNT)
    calibration = cp.calibrate_whole_arm(recording, cp.segment(recording), options)
    result = calibration.joints
    estimate = result.chain()
    truth = cp.rebase(chain, result.reference_configuration)
    errors = np.concatenate(
        [cp.local_coordinates(a.line, b.line) for a, b in zip(estimate.axes, truth.axes, strict=True)]
    )
    poses = START + np.random.default_rng(0).uniform(-np.pi, np.pi, (200, 7))
    predicted = np.sqrt(np.mean(np.square(cp.end_point_std(calibration, poses))))
    assert cp.end_point_error(estimate, truth, poses) < 6e-4
    assert predicted < 6e-4
    assert errors @ np.linalg.solve(result.covariance, errors) < 2.0 * len(errors)
