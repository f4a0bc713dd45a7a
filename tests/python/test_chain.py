"""Screw and DH chains from Python."""

import pickle
import sys
import threading

import numpy as np
import pytest

import circlepoint as cp

REVOLUTE, PRISMATIC = cp.JointType.revolute, cp.JointType.prismatic


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(2)


def random_chain(random: np.random.Generator, joints: int = 6) -> cp.ScrewChain:
    axes = [
        cp.ScrewAxis(PRISMATIC if i == 3 else REVOLUTE, cp.make_line(random.normal(size=3), random.normal(size=3)))
        for i in range(joints)
    ]
    return cp.ScrewChain(axes, random.normal(size=joints))


def puma() -> cp.StandardDhChain:
    """Rows of the PUMA 560 in the standard convention."""
    quarter = np.pi / 2
    rows = [
        cp.DhRow(0.0, quarter, 0.0, 0.0),
        cp.DhRow(0.4318, 0.0, 0.0, 0.0),
        cp.DhRow(0.0203, -quarter, 0.15005, 0.0),
        cp.DhRow(0.0, quarter, 0.4318, 0.0),
        cp.DhRow(0.0, -quarter, 0.0, 0.0),
        cp.DhRow(0.0, 0.0, 0.0, 0.0),
    ]
    return cp.StandardDhChain(rows, [REVOLUTE] * 6)


def table(rows: list) -> np.ndarray:
    return np.array([[row.a, row.alpha, row.d, row.theta] for row in rows])


def test_many_configurations_give_the_poses_of_each(random):
    chain = random_chain(random)
    for each in (chain, cp.to_standard_dh(chain).chain, cp.to_modified_dh(chain).chain):
        q = random.normal(size=(50, 6))
        poses = cp.forward_kinematics(each, q)
        assert poses.shape == (50, 4, 4)
        for pose, configuration in zip(poses, q, strict=True):
            np.testing.assert_array_equal(pose, cp.forward_kinematics(each, configuration))
        np.testing.assert_allclose(poses, cp.forward_kinematics(chain, q), atol=1e-11)


def test_one_joint_keeps_configurations_and_joints_apart(random):
    chain = random_chain(random, joints=1)
    assert cp.forward_kinematics(chain, np.zeros((5, 1))).shape == (5, 4, 4)
    assert cp.forward_kinematics(chain, np.zeros(1)).shape == (4, 4)
    assert cp.forward_kinematics(chain, [0]).shape == (4, 4)


def test_arrays_of_another_layout_or_size_are_refused(random):
    chain = random_chain(random)
    with pytest.raises(TypeError):
        cp.forward_kinematics(chain, np.zeros((5, 6), dtype=np.float32))
    with pytest.raises(TypeError):
        cp.forward_kinematics(chain, np.zeros((6, 5)).T)
    with pytest.raises(cp.InvalidInput, match="7 entries for a chain of 6 joints"):
        cp.forward_kinematics(chain, np.zeros((5, 7)))
    with pytest.raises(cp.InvalidInput, match="3 dimensions"):
        cp.forward_kinematics(chain, np.zeros((5, 6, 1)))
    with pytest.raises(cp.InvalidInput, match="q_dot has 5 entries"):
        cp.frame_motion(chain, np.zeros(6), np.zeros(5), np.zeros(6))


def test_a_nominal_arm_comes_back_from_its_screws():
    arm = puma()
    reference = np.linspace(-0.5, 0.5, 6)
    screws = cp.to_screws(arm, reference, cp.BaseFrame.sensor_at_reference)
    np.testing.assert_array_equal(screws.home, np.eye(4))
    back = cp.to_standard_dh(screws, nominal=arm)
    np.testing.assert_allclose(table(back.rows), table(arm.rows), atol=1e-12)
    assert back.free.sum() == 7
    assert back.free[2, 2]
    assert [(pair.first, pair.parallel) for pair in back.near_parallel] == [(1, True)]
    assert repr(back.near_parallel[0]).startswith("NearParallel(first=1")


def test_conversion_closes_the_loop_with_its_base_and_tool(random):
    chain = random_chain(random)
    result = cp.to_modified_dh(chain)
    q = random.normal(size=6)
    pose = result.base
    for row, joint_type, value in zip(result.rows, result.chain.types, q, strict=True):
        pose = pose @ cp.modified_dh_transform(row, joint_type, value)
    np.testing.assert_allclose(pose @ result.tool, cp.forward_kinematics(chain, q), atol=1e-12)


def test_covariance_of_dh_parameters_agrees_with_a_monte_carlo_trial(random):
    chain = random_chain(random)
    at = cp.to_standard_dh(chain)
    jacobian = cp.dh_parameter_jacobian(chain, at)
    sigma = 1e-5
    samples = []
    for _ in range(1000):
        axes = [cp.ScrewAxis(axis.type, cp.retract(axis.line, sigma * random.normal(size=4))) for axis in chain.axes]
        moved = cp.ScrewChain(axes, chain.reference_configuration)
        samples.append(table(cp.to_standard_dh(moved, nominal=at.chain).rows).ravel())
    predicted = sigma * np.linalg.norm(jacobian, axis=1)
    determined = ~at.free.ravel()
    observed = np.std(samples, axis=0)
    np.testing.assert_allclose(observed[determined], predicted[determined], rtol=0.12)
    np.testing.assert_array_equal(observed[~determined], 0.0)
    np.testing.assert_array_equal(predicted[~determined], 0.0)


def test_a_nominal_chain_of_the_other_convention_is_refused(random):
    chain = random_chain(random)
    with pytest.raises(TypeError):
        cp.to_modified_dh(chain, nominal=cp.to_standard_dh(chain).chain)
    with pytest.raises(cp.InvalidInput, match="joint 3"):
        cp.to_standard_dh(chain, nominal=puma())


def test_results_are_read_only(random):
    result = cp.to_standard_dh(random_chain(random))
    with pytest.raises(AttributeError):
        result.rows[0].a = 1.0
    with pytest.raises(AttributeError):
        result.chain = puma()
    with pytest.raises(ValueError, match="read-only"):
        result.free[0, 0] = True


def test_chains_survive_pickling_and_show_what_they_are(random):
    chain = random_chain(random)
    q = random.normal(size=6)
    for each in (chain, cp.to_standard_dh(chain).chain, cp.to_modified_dh(chain).chain):
        back = pickle.loads(pickle.dumps(each))
        np.testing.assert_array_equal(cp.forward_kinematics(back, q), cp.forward_kinematics(each, q))
        assert len(back) == 6
    assert repr(chain) == "<ScrewChain of 6 joints>"
    assert repr(puma()).startswith("StandardDhChain(rows=[DhRow(a=0, alpha=1.5708")


def test_other_threads_run_while_poses_are_computed(random):
    chain = random_chain(random)
    q = random.normal(size=(200_000, 6))
    started, finished = threading.Event(), threading.Event()

    def work() -> None:
        started.set()
        cp.forward_kinematics(chain, q)
        finished.set()

    # With so long an interval a thread runs until it gives the interpreter away by itself.
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)
    try:
        worker = threading.Thread(target=work)
        worker.start()
        started.wait()
        ran_meanwhile = not finished.is_set()
        worker.join()
    finally:
        sys.setswitchinterval(interval)
    assert ran_meanwhile
