"""The kinematics of a chain against a physics engine: pose and accelerometer of an arm with hinges and a slide."""

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import circlepoint as cp

GRAVITY = np.array([0.4, -0.7, -9.7])  # any direction: nothing may rely on z


def numbers(values: np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)


def random_arm(random: np.random.Generator, joints: int) -> mujoco.MjModel:
    slide = random.integers(joints)
    body = f'<site name="sensor" pos="{numbers(random.normal(size=3))}" quat="{numbers(random.normal(size=4))}"/>'
    for i in reversed(range(joints)):
        kind = "slide" if i == slide else "hinge"
        axis, anchor = numbers(random.normal(size=3)), numbers(0.3 * random.normal(size=3))
        position, attitude = numbers(0.5 * random.normal(size=3)), numbers(random.normal(size=4))
        body = (
            f'<body pos="{position}" quat="{attitude}"><joint type="{kind}" axis="{axis}" pos="{anchor}"/>'
            f'<inertial pos="0.1 0 0.05" mass="1.5" diaginertia="0.02 0.03 0.04"/>{body}</body>'
        )
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="{numbers(GRAVITY)}"/><worldbody>{body}</worldbody>'
        '<sensor><accelerometer site="sensor"/></sensor></mujoco>'
    )


def pose_of_site(data: mujoco.MjData) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, :3] = data.site("sensor").xmat.reshape(3, 3)
    pose[:3, 3] = data.site("sensor").xpos
    # The engine's poses come from single quaternions; project their rounding away.
    pose[:3, :3] = Rotation.from_matrix(pose[:3, :3]).as_matrix()
    return pose


def chain_at(model: mujoco.MjModel, data: mujoco.MjData) -> cp.ScrewChain:
    """The screws the engine reports at the configuration of `data`."""
    slides = model.jnt_type == mujoco.mjtJoint.mjJNT_SLIDE
    axes = [
        cp.ScrewAxis(cp.JointType.prismatic if slide else cp.JointType.revolute, cp.make_line(axis, anchor))
        for slide, axis, anchor in zip(slides, data.xaxis, data.xanchor, strict=True)
    ]
    return cp.ScrewChain(axes, data.qpos.copy(), pose_of_site(data))


@pytest.mark.parametrize("seed", range(20))
def test_pose_and_accelerometer_are_those_of_a_physics_engine(seed):
    random = np.random.default_rng(seed)
    model = random_arm(random, joints=6 + seed % 2)
    data = mujoco.MjData(model)
    data.qpos[:] = random.uniform(-1.0, 1.0, model.nq)
    mujoco.mj_forward(model, data)
    chain = chain_at(model, data)

    for _ in range(5):
        data.qpos[:] = random.uniform(-2.0, 2.0, model.nq)
        data.qvel[:] = random.uniform(-2.0, 2.0, model.nv)
        data.qfrc_applied[:] = random.uniform(-5.0, 5.0, model.nv)
        mujoco.mj_forward(model, data)
        motion = cp.frame_motion(chain, data.qpos, data.qvel, data.qacc)
        np.testing.assert_allclose(motion.T_base_sensor, pose_of_site(data), atol=1e-9)
        scale = max(1.0, float(np.abs(data.sensordata).max()))
        np.testing.assert_allclose(cp.specific_force(motion, -GRAVITY), data.sensordata, atol=1e-9 * scale, rtol=0.0)


def test_specific_force_does_not_depend_on_the_reference_configuration():
    random = np.random.default_rng(100)
    model = random_arm(random, joints=6)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    chain = chain_at(model, data)
    moved = cp.rebase(chain, random.uniform(-1.0, 1.0, model.nq))
    up_gravity_moved = cp.forward_kinematics(chain, moved.reference_configuration)[:3, :3].T @ -GRAVITY
    state = random.uniform(-1.0, 1.0, (3, model.nq))
    np.testing.assert_allclose(
        cp.specific_force(cp.frame_motion(moved, *state), up_gravity_moved),
        cp.specific_force(cp.frame_motion(chain, *state), -GRAVITY),
        atol=1e-11,
    )
