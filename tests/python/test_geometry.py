"""Lines, screws and rigid transforms from Python."""

import pickle

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

import circlepoint as cp


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(1)


def random_pose(random: np.random.Generator) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, :3] = Rotation.random(rng=random).as_matrix()
    pose[:3, 3] = random.normal(size=3)
    return pose


def random_line(random: np.random.Generator) -> cp.Line:
    return cp.make_line(random.normal(size=3), random.normal(size=3))


def test_rotation_maps_are_those_of_scipy(random):
    for angle in (0.0, 1e-9, 1e-3, 1.0, 3.1):
        vector = random.normal(size=3)
        vector *= angle / np.linalg.norm(vector)
        matrix = Rotation.from_rotvec(vector).as_matrix()
        np.testing.assert_allclose(cp.rotation_exp(vector), matrix, atol=1e-15)
        np.testing.assert_allclose(cp.rotation_log(matrix), vector, atol=1e-14)


@pytest.mark.parametrize("joint_type", list(cp.JointType))
def test_screw_displacement_is_the_matrix_exponential_of_its_twist(random, joint_type):
    axis = cp.ScrewAxis(joint_type, random_line(random))
    twist = axis.twist()
    matrix = np.zeros((4, 4))
    matrix[:3, :3] = cp.skew(twist[:3])
    matrix[:3, 3] = twist[3:]
    np.testing.assert_allclose(cp.screw_exp(axis, 0.8), expm(0.8 * matrix), atol=1e-14)


def test_transform_takes_lines_screws_and_joint_axes(random):
    pose = random_pose(random)
    axis = cp.JointAxis(cp.ScrewAxis(cp.JointType.revolute, random_line(random)), np.diag([1e-6, 1e-6, 1e-8, 1e-8]))
    line = axis.screw.line
    expected = cp.make_line(pose[:3, :3] @ line.direction, pose[:3, :3] @ line.point + pose[:3, 3])
    for moved in (
        cp.transform(pose, line),
        cp.transform(pose, axis.screw).line,
        cp.transform(pose, axis).screw.line,
    ):
        np.testing.assert_allclose(moved.direction, expected.direction, atol=1e-14)
        np.testing.assert_allclose(moved.point, expected.point, atol=1e-14)
    assert cp.transform(pose, axis).direction_std() == pytest.approx(1e-3)


@pytest.mark.parametrize(
    ("row", "column", "value", "message"),
    [(0, 0, 1.5, "orthogonality"), (3, 0, 0.1, "last row"), (2, 3, np.nan, "not finite")],
)
def test_a_matrix_that_is_not_rigid_is_refused_wherever_one_is_taken(random, row, column, value, message):
    matrix = np.eye(4)
    matrix[row, column] = value
    with pytest.raises(cp.InvalidInput, match=message):
        cp.transform(matrix, random_line(random))
    with pytest.raises(cp.InvalidInput, match=message):
        cp.ScrewChain([], np.zeros(0), matrix)
    with pytest.raises(cp.InvalidInput, match=message):
        cp.make_rigid_transform(matrix)


def test_a_reflection_is_not_a_rigid_transform():
    with pytest.raises(ValueError, match="determinant -1"):
        cp.make_rigid_transform(np.diag([1.0, 1.0, -1.0, 1.0]))


def test_a_zero_direction_is_refused():
    with pytest.raises(cp.InvalidInput, match="non-zero"):
        cp.Line(np.zeros(3), np.zeros(3))


def test_results_are_read_only(random):
    line = random_line(random)
    with pytest.raises(AttributeError):
        line.direction = np.ones(3)
    with pytest.raises(ValueError, match="read-only"):
        line.direction[0] = 2.0


def test_common_normal_joins_the_two_lines(random):
    first, second = random_line(random), random_line(random)
    normal = cp.common_normal(first, second, np.zeros(3))
    np.testing.assert_allclose(normal.foot_first + normal.distance * normal.direction, normal.foot_second, atol=1e-12)
    assert normal.distance > 0.0
    assert not normal.parallel


def test_local_coordinates_invert_retract(random):
    line = random_line(random)
    local = 0.1 * random.normal(size=4)
    np.testing.assert_allclose(cp.local_coordinates(line, cp.retract(line, local)), local, atol=1e-14)


def test_values_survive_pickling(random):
    axis = cp.JointAxis(cp.ScrewAxis(cp.JointType.prismatic, random_line(random)), 1e-6 * np.eye(4))
    back = pickle.loads(pickle.dumps(axis))
    np.testing.assert_array_equal(back.screw.line.direction, axis.screw.line.direction)
    np.testing.assert_array_equal(back.covariance, axis.covariance)
    assert back.screw.type is cp.JointType.prismatic
    assert repr(back) == repr(axis)
