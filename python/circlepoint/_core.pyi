"""
The C++ core of circlepoint; its public names are re-exported by the package.
"""
from __future__ import annotations
import collections.abc
import enum
import numpy
import numpy.typing
import typing
__all__: list[str] = ['AccelerometerModel', 'AccelerometerSpecification', 'AcquisitionOptions', 'AxisChart', 'AxisDirectionFit', 'BaseFrame', 'CalibratedAccelerometer', 'CalibrationMethod', 'CenterOfRotation', 'CenterOptions', 'ChainAlignment', 'CircleFit', 'ClockAlignment', 'ClockAlignmentOptions', 'ClockModel', 'CommonNormal', 'DelayTest', 'DhRow', 'DidNotConverge', 'Dwell', 'Error', 'Experiment', 'FrameMotion', 'GravityModel', 'HayatiChain', 'HayatiConversion', 'HayatiRow', 'HeldJoints', 'IndexRange', 'InstructionSet', 'InvalidInput', 'JointAxis', 'JointCalibration', 'JointCalibrationOptions', 'JointEstimate', 'JointModel', 'JointModelFit', 'JointModelPrior', 'JointTest', 'JointTrajectory', 'JointType', 'Line', 'LineComparison', 'ModifiedDhChain', 'ModifiedDhConversion', 'MultiJointMotion', 'NamedParameter', 'NearParallel', 'NoiseBand', 'NotIdentifiable', 'ParameterTreatment', 'PointToPointMove', 'RaisedCosine', 'Recording', 'RegressionStatistics', 'ResponseBand', 'RowForm', 'STANDARD_GRAVITY', 'ScrewAxis', 'ScrewChain', 'SecondOrderResponse', 'Segmentation', 'SegmentationOptions', 'SensorComparison', 'SensorFromGravity', 'SimulatedExperiment', 'SimulationOptions', 'SingleJointMotion', 'StampOrder', 'StampRule', 'StandardDhChain', 'StandardDhConversion', 'StaticDwell', 'StaticIntervalOptions', 'SteppedSweep', 'StretchResidual', 'TemperatureModel', 'TemperatureProfile', 'TestFit', 'TimelineGap', 'TimelineOptions', 'TimelineReport', 'TrialConditions', 'TrialOutcome', 'TrialResults', 'UncorrectedErrors', 'VibrationOptions', 'WeakCombination', 'WholeArmCalibration', 'WholeArmOptions', 'align_chain', 'align_clocks', 'align_lines', 'analyse_timeline', 'available_instruction_sets', 'axis_in_sensor_frame', 'band_noise', 'butter', 'calibrate_joints', 'calibrate_whole_arm', 'center_by_position', 'center_by_velocity', 'common_normal', 'compare_lines', 'compare_sensor', 'concatenate', 'correct', 'cumulative_simpson', 'cumulative_trapezoid', 'derive_seed', 'dh_parameter_jacobian', 'draw_accelerometer', 'draw_calibrated_accelerometer', 'draw_response', 'encoder_step', 'end_point_error', 'end_point_std', 'fit_axis_direction', 'fit_axis_direction_robust', 'fit_circle', 'fit_gravity_model', 'fit_joint_model', 'fit_sensor_from_gravity', 'follow', 'forward_kinematics', 'frame_motion', 'gradient', 'hayati_parameter_jacobian', 'hayati_transform', 'instruction_set', 'interpolate_cubic', 'joint_compliance', 'joint_frame', 'joint_regressors', 'joint_rests', 'joint_statistics', 'joint_trajectory', 'line_from_pluecker', 'local_coordinates', 'local_coordinates_jacobian', 'make_line', 'make_recording', 'make_rigid_transform', 'make_static_recording', 'max_encoder_step', 'measure', 'modified_dh_transform', 'orient_axis', 'output_current', 'paper_acquisition', 'reading_from_current', 'rebase', 'response_section', 'rest_band', 'retract', 'rotation_exp', 'rotation_log', 'run_trials', 'savgol_filter', 'screw_exp', 'segment', 'sensor_figure_names', 'simulate', 'simulate_experiment', 'skew', 'sosfilt', 'sosfilt_zi', 'sosfiltfilt', 'specific_force', 'standard_dh_transform', 'static_intervals', 'static_poses', 'tangent_basis', 'to_hayati', 'to_modified_dh', 'to_screws', 'to_standard_dh', 'transform', 'use_instruction_set', 'used_tolerance', 'welch']
class Error(Exception):
    """
    Base of every error circlepoint raises on purpose.
    """
class InvalidInput(Error, ValueError):
    """
    Data or arguments cannot be used as they are.
    """
class NotIdentifiable(Error):
    """
    The data do not determine the parameter asked for.
    """
class DidNotConverge(Error):
    """
    An iteration ended without reaching its tolerance.
    """
class InstructionSet(enum.Enum):
    """
    Vector instructions of the kernels.
    """
    avx2 = ...
    avx512 = ...
    baseline = ...
class Line:
    """
    A directed line: unit direction and the point of it nearest the origin.
    """
    def __getstate__(self) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]]:
        ...
    def __init__(self, direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], point_on_line: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None:
        """
        Same as make_line.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    def moment(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Pluecker moment ``cross(point, direction)``, (3,), m.
        """
    @property
    def direction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), unit.
        """
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), m, the point nearest the origin.
        """
class CommonNormal:
    """
    The common normal of two lines.
    """
    @property
    def angle(self) -> float:
        """
        rad, from first to second direction about ``direction``.
        """
    @property
    def direction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), unit, from first to second; of intersecting lines ``cross(first, second)``.
        """
    @property
    def distance(self) -> float:
        """
        m, along direction.
        """
    @property
    def foot_first(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), m, its foot on the first line.
        """
    @property
    def foot_second(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), m, its foot on the second line.
        """
    @property
    def parallel(self) -> bool:
        """
        True when the feet are a choice: nearest ``foot_hint``.
        """
class JointType(enum.Enum):
    """
    Kind of a joint.
    """
    prismatic = ...
    revolute = ...
class ScrewAxis:
    """
    A joint as a screw axis: rotation about a line or translation along it.
    """
    def __getstate__(self) -> tuple[JointType, Line]:
        ...
    def __init__(self, type: JointType, line: Line) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    def twist(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[6, 1]"]:
        """
        Twist (angular, linear) of unit joint rate, (6,).
        """
    @property
    def line(self) -> Line:
        """
        Prismatic: only the direction acts.
        """
    @property
    def type(self) -> JointType:
        ...
class JointAxis:
    """
    An estimated axis and the covariance of its local coordinates.

    The coordinates are (d1, d2, p1, p2), rad and m: the direction turns by d towards, and the line shifts by p along, the
    columns of ``tangent_basis(direction)``.
    """
    def __getstate__(self) -> tuple[ScrewAxis, typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]]:
        ...
    def __init__(self, screw: ScrewAxis, covariance: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    def direction_std(self) -> float:
        """
        Larger principal standard deviation of the direction, rad.
        """
    def point_std(self) -> float:
        """
        Larger principal standard deviation of the nearest point, m.
        """
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4), rad^2, rad m, m^2.
        """
    @property
    def screw(self) -> ScrewAxis:
        ...
class TemperatureModel:
    """
    How bias and scale factor follow the temperature: third-order polynomials.

    Parameters
    ----------
    reference : float, degrees Celsius
        Where bias and scale are those of the accelerometer's model.
    bias : (3, 3) array_like
        Row k of channel k: m/s^2 per degC, degC^2, degC^3.
    scale : (3, 3) array_like
        Row k of channel k: relative, per degC, degC^2, degC^3.

    References
    ----------
    docs/method, (M14).
    """
    def __init__(self, *, reference: typing.SupportsFloat | typing.SupportsIndex = 25.0, bias: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"] = ..., scale: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"] = ...) -> None:
        ...
    def bias_change(self, temperature: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2 from the reference.
        """
    def scale_change(self, temperature: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) from the reference.
        """
    @property
    def bias(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3) m/s^2 per degC, degC^2, degC^3
        """
    @property
    def reference(self) -> float:
        """
        degrees Celsius
        """
    @property
    def scale(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3) per degC, degC^2, degC^3
        """
class NoiseBand:
    """
    Noise of `rms` m/s^2 between `low` and `high` Hz.
    """
    def __init__(self, low: typing.SupportsFloat | typing.SupportsIndex, high: typing.SupportsFloat | typing.SupportsIndex, rms: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def high(self) -> float:
        """
        Hz
        """
    @property
    def low(self) -> float:
        """
        Hz
        """
    @property
    def rms(self) -> float:
        """
        m/s^2
        """
class ResponseBand:
    """
    Gain within plus and minus `tolerance` (relative) from `low` to `high` Hz.
    """
    def __init__(self, low: typing.SupportsFloat | typing.SupportsIndex, high: typing.SupportsFloat | typing.SupportsIndex, tolerance: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def high(self) -> float:
        """
        Hz
        """
    @property
    def low(self) -> float:
        """
        Hz
        """
    @property
    def tolerance(self) -> float:
        """
        relative
        """
class SecondOrderResponse:
    """
    A mass on a damped spring: ``1 / (1 - x**2 + 2j damping x)``, x = f / natural_frequency.

    Parameters
    ----------
    natural_frequency : float, Hz
    damping : float
        Of critical.

    References
    ----------
    docs/method, (M16).
    """
    def __init__(self, *, natural_frequency: typing.SupportsFloat | typing.SupportsIndex, damping: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def at(self, frequency: typing.SupportsFloat | typing.SupportsIndex) -> complex:
        """
        Complex gain at `frequency` (Hz).
        """
    @property
    def damping(self) -> float:
        """
        of critical
        """
    @property
    def natural_frequency(self) -> float:
        """
        Hz
        """
class AccelerometerModel:
    """
    One individual triaxial accelerometer.

    Channel k reads ``(1 + scale[k]) u[k] + second_order[k] u[k]**2 + bias[k]`` with
    ``u = M (f - D (|w|**2 - w**2))``: f the specific force at the frame's origin, w the angular velocity, both in the
    sensor frame, M unit lower triangular, D the percussion distances.

    Parameters
    ----------
    bias : (3,) array_like, m/s^2
    scale : (3,) array_like
        Relative scale-factor error.
    misalignment : (3,) array_like, rad
        The entries (yx, zx, zy) of M.
    percussion_distance : (3,) array_like, m
        Where each channel measures along its own axis.
    second_order : (3,) array_like, s^2/m
    temperature : TemperatureModel
        How bias and scale follow the temperature.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
    """
    def __init__(self, *, bias: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., scale: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., misalignment: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., percussion_distance: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., second_order: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., temperature: TemperatureModel = ...) -> None:
        ...
    def at(self, degrees: typing.SupportsFloat | typing.SupportsIndex) -> AccelerometerModel:
        """
        The same sensor held at a temperature, degrees Celsius: bias and scale are those there.
        """
    def misalignment_matrix(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3) unit lower triangular matrix M.
        """
    @property
    def bias(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2
        """
    @property
    def misalignment(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) rad: (yx, zx, zy)
        """
    @property
    def percussion_distance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """
    @property
    def scale(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) relative scale-factor error
        """
    @property
    def second_order(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) s^2/m
        """
    @property
    def temperature(self) -> TemperatureModel:
        """
        of bias and scale
        """
class UncorrectedErrors:
    """
    Standard deviations of what a sensor's own calibration sheet corrects.
    """
    def __init__(self, *, bias_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, scale_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, bias_temperature_std: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., scale_temperature_std: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., reference_temperature: typing.SupportsFloat | typing.SupportsIndex = 25.0) -> None:
        ...
    @property
    def bias_std(self) -> float:
        """
        m/s^2
        """
    @property
    def bias_temperature_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2 per degC, degC^2, degC^3
        """
    @property
    def reference_temperature(self) -> float:
        """
        degrees Celsius
        """
    @property
    def scale_std(self) -> float:
        """
        1
        """
    @property
    def scale_temperature_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) per degC, degC^2, degC^3
        """
class AccelerometerSpecification:
    """
    What a data sheet says of a kind of accelerometer.

    Standard deviations of the individual errors around nominal values: the estimators' prior and the simulator's source of
    individual sensors.

    Parameters
    ----------
    bias_std : float, m/s^2
    scale_std : float
    misalignment_std : float, rad
    percussion_distance : float, m
        Nominal value, the same for the three channels.
    percussion_distance_std : float, m
    second_order_std : float, s^2/m
    noise_std : float, m/s^2
        White noise per sample.
    range : float, m/s^2
        Readings clip at plus and minus this; 0 for no clipping.
    resolution : float, m/s^2
        The smallest change that shows; 0 for any.
    current_scale_factor : float, A s^2/m
        Nominal; 0 for a sensor without current output.
    uncorrected : UncorrectedErrors
        What the sensor's own calibration sheet corrects; the errors above are what is left then.
    noise_bands : list of NoiseBand
    response_bands : list of ResponseBand
    """
    def __init__(self, *, bias_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, scale_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, misalignment_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, percussion_distance: typing.SupportsFloat | typing.SupportsIndex = 0.0, percussion_distance_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, second_order_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, noise_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, range: typing.SupportsFloat | typing.SupportsIndex = 0.0, resolution: typing.SupportsFloat | typing.SupportsIndex = 0.0, current_scale_factor: typing.SupportsFloat | typing.SupportsIndex = 0.0, uncorrected: UncorrectedErrors = ..., noise_bands: collections.abc.Sequence[NoiseBand] = [], response_bands: collections.abc.Sequence[ResponseBand] = []) -> None:
        ...
    @property
    def bias_std(self) -> float:
        """
        m/s^2
        """
    @property
    def current_scale_factor(self) -> float:
        """
        A s^2/m, nominal
        """
    @property
    def misalignment_std(self) -> float:
        """
        rad
        """
    @property
    def noise_bands(self) -> list[NoiseBand]:
        ...
    @property
    def noise_std(self) -> float:
        """
        m/s^2 per sample
        """
    @property
    def percussion_distance(self) -> float:
        """
        m, nominal
        """
    @property
    def percussion_distance_std(self) -> float:
        """
        m
        """
    @property
    def range(self) -> float:
        """
        m/s^2; 0: no clipping
        """
    @property
    def resolution(self) -> float:
        """
        m/s^2; 0: any change shows
        """
    @property
    def response_bands(self) -> list[ResponseBand]:
        ...
    @property
    def scale_std(self) -> float:
        """
        1
        """
    @property
    def second_order_std(self) -> float:
        """
        s^2/m
        """
    @property
    def uncorrected(self) -> UncorrectedErrors:
        """
        before correction by the calibration sheet
        """
class CalibratedAccelerometer:
    """
    An individual sensor, its calibration sheet, and what correcting by it leaves.
    """
    @property
    def actual(self) -> AccelerometerModel:
        """
        what the individual does
        """
    @property
    def residual(self) -> AccelerometerModel:
        """
        what is left after correction by the sheet
        """
    @property
    def sheet(self) -> AccelerometerModel:
        """
        bias, scale and temperature as delivered
        """
class FrameMotion:
    """
    Pose of the sensor frame and its time derivatives.
    """
    @property
    def T_base_sensor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4).
        """
    @property
    def acceleration_base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), m/s^2, of the sensor origin.
        """
    @property
    def angular_acceleration_sensor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), rad/s^2.
        """
    @property
    def angular_velocity_sensor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), rad/s.
        """
    @property
    def velocity_base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,), m/s, of the sensor origin.
        """
class ScrewChain:
    """
    A serial chain as a product of exponentials.

    ``T_base_sensor(q) = exp(xi_1 (q_1 - r_1)) ... exp(xi_n (q_n - r_n)) home``. In a calibration result the base frame is the
    sensor frame at the reference configuration r, so home is the identity.

    Parameters
    ----------
    axes : list of ScrewAxis
        Base to tip, in the base frame at the reference configuration.
    reference_configuration : (n,) array
        rad or m, raw encoder values.
    home : (4, 4) array
        T_base_sensor at the reference configuration.
    """
    def __getstate__(self) -> tuple[list[ScrewAxis], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]]:
        ...
    def __init__(self, axes: collections.abc.Sequence[ScrewAxis], reference_configuration: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"], home: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ...) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    def size(self) -> int:
        """
        Number of joints.
        """
    @property
    def axes(self) -> list[ScrewAxis]:
        ...
    @property
    def home(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4).
        """
    @property
    def reference_configuration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,), rad or m.
        """
class DhRow:
    """
    One row of DH parameters; theta (revolute) or d (prismatic) at q = 0.
    """
    def __eq__(self, arg0: object) -> bool:
        ...
    def __getstate__(self) -> tuple[float, float, float, float]:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, a: typing.SupportsFloat | typing.SupportsIndex = 0.0, alpha: typing.SupportsFloat | typing.SupportsIndex = 0.0, d: typing.SupportsFloat | typing.SupportsIndex = 0.0, theta: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    @property
    def a(self) -> float:
        """
        m.
        """
    @property
    def alpha(self) -> float:
        """
        rad.
        """
    @property
    def d(self) -> float:
        """
        m.
        """
    @property
    def theta(self) -> float:
        """
        rad.
        """
class BaseFrame(enum.Enum):
    """
    Which frame the lines of a screw chain are given in.
    """
    chain_base = ...
    sensor_at_reference = ...
class NearParallel:
    """
    Neighbouring axes whose directions are nearly parallel or anti-parallel.
    """
    def __repr__(self) -> str:
        ...
    @property
    def angle(self) -> float:
        """
        rad, 0 to pi/2.
        """
    @property
    def first(self) -> int:
        """
        Joint (from 0); the other is the next.
        """
    @property
    def parallel(self) -> bool:
        """
        Within parallel_tolerance.
        """
class StandardDhChain:
    """
    A serial chain in the standard DH convention.

    ``T_base_sensor(q) = base T_0_1(q_1) ... T_n-1_n(q_n) tool``; a revolute joint adds q to theta, a prismatic one to d.
    """
    def __getstate__(self) -> tuple[list[DhRow], list[JointType], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]]:
        ...
    def __init__(self, rows: collections.abc.Sequence[DhRow], types: collections.abc.Sequence[JointType], base: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ..., tool: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ...) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    def size(self) -> int:
        """
        Number of joints.
        """
    @property
    def base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        T_base_0, (4, 4).
        """
    @property
    def rows(self) -> list[DhRow]:
        """
        Base to tip.
        """
    @property
    def tool(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        T_n_sensor, (4, 4).
        """
    @property
    def types(self) -> list[JointType]:
        """
        One a row.
        """
class StandardDhConversion:
    """
    DH parameters read from joint axes, and which of them are a choice.
    """
    @property
    def base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4).
        """
    @property
    def chain(self) -> StandardDhChain:
        """
        With base and tool: moves as the screw chain does.
        """
    @property
    def free(self) -> typing.Annotated[numpy.typing.NDArray[numpy.bool], "[m, 4]"]:
        """
        (n, 4) bool, order a, alpha, d, theta: a choice, not determined by the axes.
        """
    @property
    def near_parallel(self) -> list[NearParallel]:
        """
        List of NearParallel, base to tip.
        """
    @property
    def rows(self) -> list[DhRow]:
        ...
    @property
    def tool(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4).
        """
class ModifiedDhChain:
    """
    A serial chain in the modified (Craig) DH convention.

    A row holds the a and alpha that come before its joint; ``T_base_sensor(q) = base T_0_1(q_1) ... T_n-1_n(q_n) tool``.
    """
    def __getstate__(self) -> tuple[list[DhRow], list[JointType], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]]:
        ...
    def __init__(self, rows: collections.abc.Sequence[DhRow], types: collections.abc.Sequence[JointType], base: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ..., tool: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ...) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    def size(self) -> int:
        """
        Number of joints.
        """
    @property
    def base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        T_base_0, (4, 4).
        """
    @property
    def rows(self) -> list[DhRow]:
        """
        Base to tip.
        """
    @property
    def tool(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        T_n_sensor, (4, 4).
        """
    @property
    def types(self) -> list[JointType]:
        """
        One a row.
        """
class ModifiedDhConversion:
    """
    DH parameters read from joint axes, and which of them are a choice.
    """
    @property
    def base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4).
        """
    @property
    def chain(self) -> ModifiedDhChain:
        """
        With base and tool: moves as the screw chain does.
        """
    @property
    def free(self) -> typing.Annotated[numpy.typing.NDArray[numpy.bool], "[m, 4]"]:
        """
        (n, 4) bool, order a, alpha, d, theta: a choice, not determined by the axes.
        """
    @property
    def near_parallel(self) -> list[NearParallel]:
        """
        List of NearParallel, base to tip.
        """
    @property
    def rows(self) -> list[DhRow]:
        ...
    @property
    def tool(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4).
        """
class RowForm(enum.Enum):
    """
    Which four of a row's five parameters it has.
    """
    dh = ...
    hayati = ...
class HayatiRow:
    """
    A Denavit-Hartenberg row (beta = 0) or a Hayati row (d = 0), at q = 0.
    """
    def __eq__(self, arg0: object) -> bool:
        ...
    def __getstate__(self) -> tuple[float, float, float, float, float, RowForm]:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, a: typing.SupportsFloat | typing.SupportsIndex = 0.0, alpha: typing.SupportsFloat | typing.SupportsIndex = 0.0, d: typing.SupportsFloat | typing.SupportsIndex = 0.0, theta: typing.SupportsFloat | typing.SupportsIndex = 0.0, beta: typing.SupportsFloat | typing.SupportsIndex = 0.0, form: RowForm = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    @property
    def a(self) -> float:
        """
        m.
        """
    @property
    def alpha(self) -> float:
        """
        rad.
        """
    @property
    def beta(self) -> float:
        """
        rad.
        """
    @property
    def d(self) -> float:
        """
        m.
        """
    @property
    def form(self) -> RowForm:
        ...
    @property
    def theta(self) -> float:
        """
        rad.
        """
class HayatiChain:
    """
    A serial chain of Denavit-Hartenberg and Hayati rows.

    ``T_base_sensor(q) = base T_0_1(q_1) ... T_n-1_n(q_n) tool``; a revolute joint adds q to theta, a prismatic one to d.
    """
    def __getstate__(self) -> tuple[list[HayatiRow], list[JointType], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]]:
        ...
    def __init__(self, rows: collections.abc.Sequence[HayatiRow], types: collections.abc.Sequence[JointType], base: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ..., tool: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"] = ...) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None:
        ...
    def size(self) -> int:
        """
        Number of joints.
        """
    @property
    def base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        T_base_0, (4, 4).
        """
    @property
    def rows(self) -> list[HayatiRow]:
        """
        Base to tip.
        """
    @property
    def tool(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        T_n_sensor, (4, 4).
        """
    @property
    def types(self) -> list[JointType]:
        """
        One a row.
        """
class HayatiConversion:
    """
    Rows read from joint axes, and which parameters are a choice.
    """
    @property
    def chain(self) -> HayatiChain:
        """
        With base and tool: moves as the screw chain does.
        """
    @property
    def free(self) -> typing.Annotated[numpy.typing.NDArray[numpy.bool], "[m, 5]"]:
        """
        (n, 5) bool, order a, alpha, d, theta, beta: a choice, not determined by the axes.
        """
class ChainAlignment:
    """
    Where one arm's chain lies on another's, and how far its encoders are off.
    """
    @property
    def T_target_source(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4).
        """
    @property
    def converged(self) -> bool:
        ...
    @property
    def direction_rms(self) -> float:
        """
        rad, left between the axes.
        """
    @property
    def distance_rms(self) -> float:
        """
        m, left between the revolute axes.
        """
    @property
    def joint_offsets(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,), rad or m; zero where no axis shows them.
        """
class IndexRange:
    """
    Half-open range of sample indices [begin, end).
    """
    def __eq__(self, arg0: object) -> bool:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, begin: typing.SupportsInt | typing.SupportsIndex, end: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def begin(self) -> int:
        ...
    @property
    def end(self) -> int:
        ...
    @property
    def size(self) -> int:
        ...
class StampRule(enum.Enum):
    """
    What became of the time stamps.
    """
    believed = ...
    regularised = ...
class TimelineGap:
    """
    Missing samples between two rows.
    """
    @property
    def filled(self) -> bool:
        """
        interpolated; otherwise a new span starts after it
        """
    @property
    def index(self) -> int:
        """
        0-based input row after the gap
        """
    @property
    def length(self) -> float:
        """
        s, between the rows on both sides
        """
    @property
    def missing(self) -> int:
        """
        samples
        """
    @property
    def start(self) -> float:
        """
        s, stamp of the row before it
        """
class StampOrder:
    """
    A stamp that does not come after the one before it.
    """
    @property
    def index(self) -> int:
        """
        0-based input row
        """
    @property
    def previous(self) -> float:
        """
        s, stamp of the row before
        """
    @property
    def value(self) -> float:
        """
        s
        """
class TimelineReport:
    """
    What was found in the time stamps of a log.
    """
    @property
    def backwards(self) -> list[StampOrder]:
        """
        stamps before the one before
        """
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def filled(self) -> int:
        """
        interpolated samples in gaps
        """
    @property
    def gaps(self) -> list[TimelineGap]:
        ...
    @property
    def jitter_max(self) -> float:
        """
        s, largest absolute value of the same
        """
    @property
    def jitter_std(self) -> float:
        """
        s, of the stamps against the uniform clock within spans
        """
    @property
    def late(self) -> int:
        """
        stamps more than half a period late, though no sample is missing
        """
    @property
    def notes(self) -> list[str]:
        """
        what was found and done, a sentence each
        """
    @property
    def repeated(self) -> list[StampOrder]:
        """
        stamps equal to the one before
        """
    @property
    def resolution(self) -> float:
        """
        s, every stamp is a multiple of it; 0 where none was found
        """
    @property
    def rule(self) -> StampRule:
        """
        what became of the stamps
        """
    @property
    def sample_rate(self) -> float:
        """
        Hz, fitted
        """
    @property
    def samples(self) -> int:
        """
        input rows
        """
    @property
    def surplus(self) -> list[StampOrder]:
        """
        rows in excess of the clock's ticks
        """
class TimelineOptions:
    """
    How gaps in a log are treated.
    """
    def __init__(self, *, max_filled: typing.SupportsInt | typing.SupportsIndex = 3, gap_threshold: typing.SupportsFloat | typing.SupportsIndex = 1.5) -> None:
        ...
    @property
    def gap_threshold(self) -> float:
        """
        periods, for stamps too jittered to count ticks
        """
    @gap_threshold.setter
    def gap_threshold(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def max_filled(self) -> int:
        """
        samples: longer gaps split
        """
    @max_filled.setter
    def max_filled(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
class Recording:
    """
    Joint positions and specific force on one uniform clock, in gap-free spans; see make_recording.
    """
    def __repr__(self) -> str:
        ...
    @property
    def angular_velocity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"] | None:
        """
        (N, 3) rad/s, or None
        """
    @property
    def is_static(self) -> bool:
        """
        whether every row is the mean of a rest, from make_static_recording()
        """
    @property
    def joint_positions(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, n) rad or m, read-only view
        """
    @property
    def joint_timeline(self) -> TimelineReport | None:
        """
        the joints' own stamps where they had a clock, or None
        """
    @property
    def joints(self) -> int:
        ...
    @property
    def sample_rate(self) -> float:
        """
        Hz
        """
    @property
    def samples(self) -> int:
        ...
    @property
    def spans(self) -> list[IndexRange]:
        """
        contiguous pieces, in order
        """
    @property
    def specific_force(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (N, 3) m/s^2, at rest +g upwards; read-only view
        """
    @property
    def temperature(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"] | None:
        """
        (N,) degrees Celsius, or None
        """
    @property
    def time(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (N,) s, read-only view
        """
    @property
    def timeline(self) -> TimelineReport:
        """
        what was found in the stamps (two clocks: the sensor's)
        """
class ClockModel:
    """
    sensor_time = offset + rate * joint_time.
    """
    def __init__(self, offset: typing.SupportsFloat | typing.SupportsIndex = 0.0, rate: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def offset(self) -> float:
        """
        s
        """
    @property
    def rate(self) -> float:
        """
        sensor seconds a joint second
        """
class DelayTest:
    """
    A stretch of motion whose delay was measured.
    """
    @property
    def joint(self) -> int:
        """
        0-based joint that moved alone; -1 where several moved
        """
    @property
    def joint_end(self) -> float:
        """
        s, joint clock
        """
    @property
    def joint_start(self) -> float:
        """
        s, joint clock
        """
    @property
    def joint_time(self) -> float:
        """
        s, joint clock: where the delay is measured
        """
    @property
    def model_residual(self) -> float:
        """
        m/s^2, rms of what the motion does not explain
        """
    @property
    def residual(self) -> float:
        """
        s, sensor_time minus the fitted clock
        """
    @property
    def sensor_time(self) -> float:
        """
        s, sensor clock: the same instant
        """
    @property
    def std(self) -> float:
        """
        s, of sensor_time, from this stretch alone
        """
    @property
    def weight(self) -> float:
        """
        in the fit, 0 (outlier) to 1
        """
class ClockAlignmentOptions:
    """
    How two clocks are brought together.
    """
    def __init__(self, *, max_rate_deviation: typing.SupportsFloat | typing.SupportsIndex = 0.01, cutoff: typing.SupportsFloat | typing.SupportsIndex = 5.0, min_velocity: typing.SupportsFloat | typing.SupportsIndex = 0.02, min_travel: typing.SupportsFloat | typing.SupportsIndex = 0.05, others_ratio: typing.SupportsFloat | typing.SupportsIndex = 0.1) -> None:
        ...
    @property
    def cutoff(self) -> float:
        """
        Hz, -3 dB of the low-pass both sides go through
        """
    @cutoff.setter
    def cutoff(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def max_rate_deviation(self) -> float:
        """
        searched: 1 +- this
        """
    @max_rate_deviation.setter
    def max_rate_deviation(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def min_travel(self) -> float:
        """
        rad or m: shorter motions are ignored
        """
    @min_travel.setter
    def min_travel(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def min_velocity(self) -> float:
        """
        rad/s or m/s: slower is at rest
        """
    @min_velocity.setter
    def min_velocity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def others_ratio(self) -> float:
        """
        others may move at this fraction of the moving joint
        """
    @others_ratio.setter
    def others_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
class ClockAlignment:
    """
    sensor_time = offset + rate * joint_time, with standard deviations.
    """
    def __repr__(self) -> str:
        ...
    @property
    def clock(self) -> ClockModel:
        """
        ClockModel
        """
    @property
    def converged(self) -> bool:
        ...
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 2]"]:
        """
        (2, 2) of offset and rate
        """
    @property
    def notes(self) -> list[str]:
        """
        what was used and what falls short, a sentence each
        """
    @property
    def offset(self) -> float:
        """
        s
        """
    @property
    def offset_std(self) -> float:
        """
        s
        """
    @property
    def rate(self) -> float:
        """
        sensor seconds a joint second
        """
    @property
    def rate_determined(self) -> bool:
        """
        by the data; otherwise 1 within the range searched
        """
    @property
    def rate_std(self) -> float:
        ...
    @property
    def reference_std(self) -> float:
        """
        s, of the sensor time there
        """
    @property
    def reference_time(self) -> float:
        """
        s, joint clock: where the alignment is best known
        """
    @property
    def residual(self) -> float:
        """
        s, weighted rms of the tests about the fitted clock
        """
    @property
    def single_joint(self) -> bool:
        """
        measured on single-joint motions; otherwise on general ones
        """
    @property
    def tests(self) -> list[DelayTest]:
        ...
class StaticIntervalOptions:
    """
    What counts as standing still.
    """
    def __init__(self, *, min_dwell: typing.SupportsFloat | typing.SupportsIndex = 0.25, settle: typing.SupportsFloat | typing.SupportsIndex = 0.1, min_velocity: typing.SupportsFloat | typing.SupportsIndex = 0.005, rest_window: typing.SupportsFloat | typing.SupportsIndex = 0.2, quiet_ratio: typing.SupportsFloat | typing.SupportsIndex = 5.0, quiet_std: typing.SupportsFloat | typing.SupportsIndex = 0.05, joint_types: collections.abc.Sequence[JointType] = [], metres_per_radian: typing.SupportsFloat | typing.SupportsIndex = 0.2) -> None:
        ...
    @property
    def joint_types(self) -> list[JointType]:
        """
        base to tip; empty: all revolute
        """
    @property
    def metres_per_radian(self) -> float:
        """
        m: a prismatic joint's travel that counts as a radian of every threshold
        """
    @property
    def min_dwell(self) -> float:
        """
        s, shortest static interval
        """
    @property
    def min_velocity(self) -> float:
        """
        rad/s: what is slower is at rest
        """
    @property
    def quiet_ratio(self) -> float:
        """
        quiet: the sensor's scatter is within this multiple of the quietest rests' scatter
        """
    @property
    def quiet_std(self) -> float:
        """
        or below this, m/s^2 rms over the channels
        """
    @property
    def rest_window(self) -> float:
        """
        s, shortest rest of a joint
        """
    @property
    def settle(self) -> float:
        """
        s, dropped after the joints came to rest
        """
class StaticDwell:
    """
    A stretch in which every joint and the sensor are at rest.
    """
    @property
    def joint_positions(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) mean, rad or m
        """
    @property
    def samples(self) -> IndexRange:
        """
        settled samples only
        """
    @property
    def specific_force(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) mean, m/s^2
        """
    @property
    def specific_force_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) of the samples, m/s^2
        """
class SingleJointMotion:
    """
    A stretch in which one joint moves and the others stay.
    """
    @property
    def from_rest(self) -> bool:
        """
        the joint rests at the beginning
        """
    @property
    def joint(self) -> int:
        """
        0-based
        """
    @property
    def joint_positions(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) mean over the motion, rad or m
        """
    @property
    def peak_velocity(self) -> float:
        """
        rad/s or m/s
        """
    @property
    def samples(self) -> IndexRange:
        """
        from rest to rest, a little of either rest included
        """
    @property
    def to_rest(self) -> bool:
        """
        the joint rests at the end
        """
    @property
    def travel(self) -> float:
        """
        rad or m, peak to peak of the moving joint
        """
class JointTest:
    """
    What was recorded of one joint at one configuration of the others.
    """
    @property
    def configuration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m: the other joints' rest; entry `joint` is the test's mean
        """
    @property
    def dwell_span(self) -> float:
        """
        rad or m, range of the joint over its dwells
        """
    @property
    def dwells(self) -> list[int]:
        """
        into Segmentation.dwells
        """
    @property
    def joint(self) -> int:
        """
        0-based
        """
    @property
    def motion_span(self) -> float:
        """
        rad or m, largest travel of its motions
        """
    @property
    def motions(self) -> list[int]:
        """
        into Segmentation.motions
        """
class Segmentation:
    """
    The dwells, single-joint motions and tests of a recording.
    """
    @property
    def dwells(self) -> list[StaticDwell]:
        """
        list of StaticDwell, in order of time
        """
    @property
    def motions(self) -> list[SingleJointMotion]:
        """
        list of SingleJointMotion, in order of time
        """
    @property
    def tests(self) -> list[JointTest]:
        """
        list of JointTest, base to tip, largest span first
        """
class SegmentationOptions(StaticIntervalOptions):
    """
    What counts as a dwell, a single-joint motion and a test.
    """
    def __init__(self, *, min_dwell: typing.SupportsFloat | typing.SupportsIndex = 0.25, settle: typing.SupportsFloat | typing.SupportsIndex = 0.1, min_velocity: typing.SupportsFloat | typing.SupportsIndex = 0.005, rest_window: typing.SupportsFloat | typing.SupportsIndex = 0.2, quiet_ratio: typing.SupportsFloat | typing.SupportsIndex = 5.0, quiet_std: typing.SupportsFloat | typing.SupportsIndex = 0.05, others_ratio: typing.SupportsFloat | typing.SupportsIndex = 0.1, others_travel: typing.SupportsFloat | typing.SupportsIndex = 0.06, min_travel: typing.SupportsFloat | typing.SupportsIndex = 0.03, min_partial: typing.SupportsFloat | typing.SupportsIndex = 0.5, configuration_tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.1, joint_types: collections.abc.Sequence[JointType] = [], metres_per_radian: typing.SupportsFloat | typing.SupportsIndex = 0.2) -> None:
        ...
    @property
    def configuration_tolerance(self) -> float:
        """
        rad: the same test, if every other joint is within this
        """
    @property
    def min_partial(self) -> float:
        """
        s: shortest motion that does not run from rest to rest
        """
    @property
    def min_travel(self) -> float:
        """
        rad: shorter motions are ignored
        """
    @property
    def others_ratio(self) -> float:
        """
        others may move at this fraction of the moving joint's speed and travel
        """
    @property
    def others_travel(self) -> float:
        """
        rad: others may not yield more than this over a motion
        """
class AxisDirectionFit:
    """
    Direction of a joint axis from a static test.
    """
    @property
    def converged(self) -> bool:
        ...
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 2]"]:
        """
        (2, 2) rad^2, in tangent_basis(direction)
        """
    @property
    def direction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) unit, in the sensor frame
        """
    @property
    def iterations(self) -> int:
        ...
    @property
    def offset(self) -> float:
        """
        specific force along the axis, m/s^2
        """
    @property
    def residual_std(self) -> float:
        """
        m/s^2
        """
    @property
    def spread(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2, rms along the scatter's axes, ascending
        """
    @property
    def weights(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (N,) final weights, 1 for inliers
        """
class AxisChart(enum.Enum):
    """
    Which parameters the iteration moves an axis in.
    """
    hemisphere = ...
    sphere = ...
class GravityModel:
    """
    Static reading against joint angle: A + B cos + C sin.
    """
    def evaluate(self, angle: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        Specific force (N, 3) m/s^2 at each angle (N,) rad.
        """
    @property
    def constant(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) A, m/s^2
        """
    @property
    def cosine(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) B, m/s^2
        """
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3) of (A, B, C) of one channel, (m/s^2)^2
        """
    @property
    def residual_std(self) -> float:
        """
        m/s^2
        """
    @property
    def sine(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) C, m/s^2
        """
class CircleFit:
    """
    Circle through points of a plane.
    """
    @property
    def center(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        (2,)
        """
    @property
    def converged(self) -> bool:
        ...
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 2]"]:
        """
        (2, 2) of the centre, for independent point errors
        """
    @property
    def iterations(self) -> int:
        ...
    @property
    def radius(self) -> float:
        ...
    @property
    def rms(self) -> float:
        """
        of the distances to the circle
        """
class CenterOptions:
    """
    Options of the paper's two methods.
    """
    def __init__(self) -> None:
        ...
    @property
    def cutoff(self) -> float:
        """
        Hz, zero-phase Butterworth low-pass
        """
    @cutoff.setter
    def cutoff(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def filter_order(self) -> int:
        ...
    @filter_order.setter
    def filter_order(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def least_squares(self) -> bool:
        """
        velocity method: least squares instead of means
        """
    @least_squares.setter
    def least_squares(self, arg0: bool) -> None:
        ...
    @property
    def max_iterations(self) -> int:
        ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def percussion_distance(self) -> float:
        """
        m
        """
    @percussion_distance.setter
    def percussion_distance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def position_window(self) -> float:
        """
        s of record the position method uses; 0 for all
        """
    @position_window.setter
    def position_window(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def significant_rate(self) -> float:
        """
        fraction of the peak rate below which samples are left out
        """
    @significant_rate.setter
    def significant_rate(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def tolerance(self) -> float:
        """
        m
        """
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
class CenterOfRotation:
    """
    Centre of rotation by one of the paper's methods.
    """
    @property
    def center_joint(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        (2,) m, the centre in O_w seen from the sensor at angle zero
        """
    @property
    def converged(self) -> bool:
        ...
    @property
    def iterations(self) -> int:
        """
        of the centre-of-percussion correction
        """
    @property
    def lever_sensor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m, from the axis to the sensor, sensor frame
        """
    @property
    def path(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (M, 3) position (m) or velocity (m/s) in O_w as integrated
        """
    @property
    def point_std(self) -> float:
        """
        m, the residual taken as fully correlated
        """
    @property
    def radius(self) -> float:
        """
        m
        """
    @property
    def residual_rms(self) -> float:
        """
        m (position) or m/s (velocity)
        """
class RegressionStatistics:
    """
    Sufficient statistics of a joint test; pieces add up.
    """
    def __add__(self, arg0: RegressionStatistics) -> RegressionStatistics:
        ...
    def __init__(self) -> None:
        ...
    def add(self, regressors: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 5]", "flags.c_contiguous"], readings: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], weight: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        """
        Add samples: regressors (N, 5), readings (N, 3) m/s^2, common weight.
        """
    def scaled(self, weight: typing.SupportsFloat | typing.SupportsIndex) -> RegressionStatistics:
        """
        The statistics times a weight.
        """
    @property
    def count(self) -> float:
        ...
    @property
    def information(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[5, 5]"]:
        """
        (5, 5) sum x x^T
        """
    @property
    def score(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[5, 3]"]:
        """
        (5, 3) sum x y^T
        """
    @property
    def squares(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) sum y^2
        """
class JointModel:
    """
    What one joint's tests determine, in the sensor frame.
    """
    def coefficients(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[5, 3]"]:
        """
        (5, 3) rows A, B, C, E, F of the regression.
        """
    def line(self) -> Line:
        """
        The axis as a Line in the sensor frame.
        """
    @property
    def axis(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) unit
        """
    @property
    def constant(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2, up-gravity along the axis plus bias
        """
    @property
    def gravity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2, up-gravity orthogonal to the axis at angle zero
        """
    @property
    def lever(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m, from the axis to the sensor
        """
    @property
    def percussion_distance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m, of each channel
        """
class JointModelPrior:
    """
    What is known of a joint's readings beforehand.
    """
    def __init__(self) -> None:
        ...
    @property
    def bias_std(self) -> float:
        """
        m/s^2
        """
    @bias_std.setter
    def bias_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def gravity(self) -> float:
        """
        m/s^2
        """
    @gravity.setter
    def gravity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def gravity_std(self) -> float:
        """
        m/s^2
        """
    @gravity_std.setter
    def gravity_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def percussion_distance(self) -> float:
        """
        m
        """
    @percussion_distance.setter
    def percussion_distance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def percussion_distance_std(self) -> float:
        """
        m; 0 fixes it
        """
    @percussion_distance_std.setter
    def percussion_distance_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
class JointModelFit:
    """
    A joint model and its information.
    """
    @property
    def converged(self) -> bool:
        ...
    @property
    def data_information(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[12, 12]"]:
        """
        (12, 12) data alone
        """
    @property
    def information(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[12, 12]"]:
        """
        (12, 12) data and prior
        """
    @property
    def iterations(self) -> int:
        ...
    @property
    def model(self) -> JointModel:
        ...
class SensorFromGravity:
    """
    Static sensor errors from the magnitude of gravity.
    """
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[12, 12]"]:
        """
        (12, 12) of bias, scale, misalignment, second order
        """
    @property
    def noise_std(self) -> float:
        """
        m/s^2
        """
    @property
    def prior_factor(self) -> float:
        ...
    @property
    def residual_rms(self) -> float:
        """
        m/s^2
        """
    @property
    def sensor(self) -> AccelerometerModel:
        ...
class CalibrationMethod(enum.Enum):
    """
    How joints are estimated.
    """
    joint = ...
    position = ...
    velocity = ...
class JointCalibrationOptions:
    """
    Options of calibrate_joints.
    """
    adapt_sensor_prior: bool
    method: CalibrationMethod
    use_resting_encoders: bool
    def __init__(self) -> None:
        ...
    @property
    def cutoff(self) -> float:
        """
        Hz; 0: chosen per test
        """
    @cutoff.setter
    def cutoff(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def encoder_resolution(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m a count; empty: from the data
        """
    @encoder_resolution.setter
    def encoder_resolution(self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]) -> None:
        ...
    @property
    def filter_order(self) -> int:
        ...
    @filter_order.setter
    def filter_order(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def gravity(self) -> float:
        """
        m/s^2
        """
    @gravity.setter
    def gravity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def joint_types(self) -> list[JointType]:
        ...
    @joint_types.setter
    def joint_types(self, arg0: collections.abc.Sequence[JointType]) -> None:
        ...
    @property
    def max_passes(self) -> int:
        ...
    @max_passes.setter
    def max_passes(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def reference_configuration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"] | None:
        """
        (n,) rad or m, or None
        """
    @reference_configuration.setter
    def reference_configuration(self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] | None) -> None:
        ...
    @property
    def sensor(self) -> AccelerometerSpecification:
        """
        prior on the individual sensor
        """
    @sensor.setter
    def sensor(self, arg0: AccelerometerSpecification) -> None:
        ...
class TestFit:
    """
    One joint test's fit, with the signals to look at it.
    """
    @property
    def acceleration_rms(self) -> float:
        """
        m/s^2, prismatic: of the joint, filtered
        """
    @property
    def acceleration_scale(self) -> float:
        """
        prismatic: acceleration read by that of the encoder; 1 where both are right
        """
    @property
    def acceleration_scale_std(self) -> float:
        """
        noise and the sensor's scale
        """
    @property
    def condition_number(self) -> float:
        ...
    @property
    def configuration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m
        """
    @property
    def converged(self) -> bool:
        ...
    @property
    def correlation_factor(self) -> float:
        ...
    @property
    def cutoff(self) -> float:
        """
        Hz
        """
    @property
    def dwell_measured(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (K, 3) m/s^2
        """
    @property
    def dwell_modelled(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (K, 3) m/s^2
        """
    @property
    def dwell_noise_std(self) -> float:
        """
        m/s^2, of a dwell's mean by its own samples
        """
    @property
    def dwell_positions(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (K,) rad or m
        """
    @property
    def dynamic_noise_std(self) -> float:
        """
        m/s^2
        """
    @property
    def gravity_share(self) -> float:
        ...
    @property
    def iterations(self) -> int:
        ...
    @property
    def joint(self) -> int:
        """
        0-based
        """
    @property
    def knocks(self) -> int:
        """
        dynamic samples left out around residuals beyond six robust deviations
        """
    @property
    def measured(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (M, 3) m/s^2, filtered and corrected
        """
    @property
    def model(self) -> JointModel:
        ...
    @property
    def modelled(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (M, 3) m/s^2, through the same filter
        """
    @property
    def noise_covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4) of the line's local coordinates
        """
    @property
    def parameters(self) -> int:
        ...
    @property
    def percussion_distance_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """
    @property
    def position(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (M,) rad or m
        """
    @property
    def rank(self) -> int:
        """
        parameter combinations the data alone determine
        """
    @property
    def samples(self) -> int:
        ...
    @property
    def static_noise_std(self) -> float:
        """
        m/s^2
        """
    @property
    def test(self) -> int:
        """
        index into Segmentation.tests
        """
    @property
    def time(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (M,) s
        """
    @property
    def type(self) -> JointType:
        ...
class JointEstimate:
    """
    One joint's axis, or why there is none.
    """
    @property
    def axis(self) -> JointAxis | None:
        """
        JointAxis at the reference configuration, or None
        """
    @property
    def fit(self) -> int:
        """
        index into JointCalibration.fits, -1 without one
        """
    @property
    def joint(self) -> int:
        """
        0-based
        """
    @property
    def reason(self) -> str:
        ...
    @property
    def vague(self) -> JointAxis | None:
        """
        JointAxis too vague to be given, its direction known to 50 mrad at least (whole-arm), or None
        """
class JointCalibration:
    """
    Every joint's axis at one reference configuration.
    """
    def chain(self) -> ScrewChain:
        """
        The calibrated ScrewChain; raises NotIdentifiable naming missing joints.
        """
    def complete(self) -> bool:
        ...
    @property
    def converged(self) -> bool:
        ...
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (4n, 4n) of the lines' local coordinates
        """
    @property
    def fits(self) -> list[TestFit]:
        ...
    @property
    def joints(self) -> list[JointEstimate]:
        ...
    @property
    def passes(self) -> int:
        ...
    @property
    def percussion_distance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m, of each channel
        """
    @property
    def percussion_distance_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m
        """
    @property
    def reference_configuration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m
        """
    @property
    def sensor(self) -> SensorFromGravity:
        ...
    @property
    def unseen(self) -> list[str]:
        ...
    @property
    def up_gravity_sensor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2
        """
class ParameterTreatment:
    """
    How one group of parameters is treated: fixed, free, or with a prior.
    """
    def __init__(self, estimated: bool = True, std: typing.SupportsFloat | typing.SupportsIndex = ..., where_evident: bool = False) -> None:
        ...
    @property
    def estimated(self) -> bool:
        """
        False: fixed at its nominal value
        """
    @estimated.setter
    def estimated(self, arg0: bool) -> None:
        ...
    @property
    def std(self) -> float:
        """
        of the Gaussian prior about the nominal value; infinite: free
        """
    @std.setter
    def std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def where_evident(self) -> bool:
        """
        encoders' errors: only those that the data show by six standard deviations
        """
    @where_evident.setter
    def where_evident(self, arg0: bool) -> None:
        ...
class WholeArmOptions:
    """
    Options of calibrate_whole_arm.
    """
    use_gyroscope: bool
    def __init__(self) -> None:
        ...
    @property
    def bias(self) -> ParameterTreatment:
        """
        m/s^2; std 0: the sensor's specification
        """
    @bias.setter
    def bias(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def clock_offset(self) -> ParameterTreatment:
        """
        s, sensor behind the encoders
        """
    @clock_offset.setter
    def clock_offset(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def clock_rate(self) -> ParameterTreatment:
        """
        1
        """
    @clock_rate.setter
    def clock_rate(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def cutoff(self) -> float:
        """
        Hz; 0: chosen from rate and encoders
        """
    @cutoff.setter
    def cutoff(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def eccentricity(self) -> ParameterTreatment:
        """
        rad
        """
    @eccentricity.setter
    def eccentricity(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def encoder_gain(self) -> ParameterTreatment:
        """
        1
        """
    @encoder_gain.setter
    def encoder_gain(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def encoder_resolution(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m a count; empty: from the data
        """
    @encoder_resolution.setter
    def encoder_resolution(self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]) -> None:
        ...
    @property
    def gravity(self) -> ParameterTreatment:
        """
        m/s^2, the local magnitude; its direction is always free
        """
    @gravity.setter
    def gravity(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def gravity_magnitude(self) -> float:
        """
        m/s^2
        """
    @gravity_magnitude.setter
    def gravity_magnitude(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def gyroscope_bias(self) -> ParameterTreatment:
        """
        rad/s
        """
    @gyroscope_bias.setter
    def gyroscope_bias(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def gyroscope_delay(self) -> ParameterTreatment:
        """
        s, gyroscope behind the accelerometer
        """
    @gyroscope_delay.setter
    def gyroscope_delay(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def gyroscope_matrix(self) -> ParameterTreatment:
        """
        1
        """
    @gyroscope_matrix.setter
    def gyroscope_matrix(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def joint_types(self) -> list[JointType]:
        """
        empty: all revolute
        """
    @joint_types.setter
    def joint_types(self, arg0: collections.abc.Sequence[JointType]) -> None:
        ...
    @property
    def max_passes(self) -> int:
        """
        of estimating parameters and noise in turn
        """
    @max_passes.setter
    def max_passes(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def min_travel(self) -> float:
        """
        rad or m: joints that travel less have no line
        """
    @min_travel.setter
    def min_travel(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def misalignment(self) -> ParameterTreatment:
        """
        rad; std 0: the sensor's specification
        """
    @misalignment.setter
    def misalignment(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def percussion_distance(self) -> ParameterTreatment:
        """
        m; std 0: the sensor's specification
        """
    @percussion_distance.setter
    def percussion_distance(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def random_starts(self) -> int:
        """
        where tests give no start values
        """
    @random_starts.setter
    def random_starts(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def reference_configuration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"] | None:
        """
        (n,) rad or m, or None
        """
    @reference_configuration.setter
    def reference_configuration(self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] | None) -> None:
        ...
    @property
    def scale(self) -> ParameterTreatment:
        """
        1; std 0: the sensor's specification
        """
    @scale.setter
    def scale(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def second_order(self) -> ParameterTreatment:
        """
        s^2/m; std 0: the sensor's specification
        """
    @second_order.setter
    def second_order(self, arg0: ParameterTreatment) -> None:
        ...
    @property
    def seed(self) -> int:
        """
        of the random starts
        """
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def sensor(self) -> AccelerometerSpecification:
        """
        prior on the individual sensor
        """
    @sensor.setter
    def sensor(self, arg0: AccelerometerSpecification) -> None:
        ...
    @property
    def sensor_is_known(self) -> bool:
        """
        False: the specification is a guess, and nothing that rests on it alone is given
        """
    @sensor_is_known.setter
    def sensor_is_known(self, arg0: bool) -> None:
        ...
    @property
    def threads(self) -> int:
        """
        0: as many as the machine has; the result does not depend on it
        """
    @threads.setter
    def threads(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
class NamedParameter:
    """
    One estimated number.
    """
    @property
    def data_std(self) -> float:
        """
        without priors; infinite where the data alone do not show it
        """
    @property
    def name(self) -> str:
        ...
    @property
    def std(self) -> float:
        ...
    @property
    def value(self) -> float:
        """
        lines: 0, their coordinates are taken at the estimate
        """
class WeakCombination:
    """
    Parameters the data hardly tell apart.
    """
    @property
    def description(self) -> str:
        """
        parameters, numbers and what to record
        """
    @property
    def information_ratio(self) -> float:
        """
        eigenvalue over the largest
        """
class StretchResidual:
    """
    Residuals of one kind of motion, or of the dwells.
    """
    @property
    def begin(self) -> float:
        """
        s
        """
    @property
    def end(self) -> float:
        """
        s
        """
    @property
    def held_out_normalized_rms(self) -> float:
        ...
    @property
    def held_out_rms(self) -> float:
        """
        m/s^2, by estimates that did not see the stretch
        """
    @property
    def held_out_samples(self) -> int:
        ...
    @property
    def indispensable(self) -> int:
        """
        stretches the rest cannot predict
        """
    @property
    def name(self) -> str:
        ...
    @property
    def normalized_rms(self) -> float:
        """
        whitened: 1 where model and noise hold
        """
    @property
    def residual_rms(self) -> float:
        """
        m/s^2
        """
    @property
    def samples(self) -> int:
        ...
class WholeArmCalibration:
    """
    The whole-arm estimate and what it says of itself.
    """
    @property
    def clock_offset(self) -> float:
        """
        s, sensor behind the encoders
        """
    @property
    def clock_rate(self) -> float:
        ...
    @property
    def condition_number(self) -> float:
        ...
    @property
    def converged(self) -> bool:
        ...
    @property
    def covariance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        of `parameters`, in their order
        """
    @property
    def cutoff(self) -> float:
        """
        Hz
        """
    @property
    def eccentricity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
        """
        (n, 2) rad
        """
    @property
    def encoder_gain(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,)
        """
    @property
    def gyroscope_bias(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) rad/s
        """
    @property
    def gyroscope_delay(self) -> float:
        """
        s, behind the accelerometer
        """
    @property
    def gyroscope_matrix(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        (3, 3)
        """
    @property
    def gyroscope_used(self) -> bool:
        ...
    @property
    def iterations(self) -> int:
        ...
    @property
    def joints(self) -> JointCalibration:
        """
        JointCalibration: lines, covariance, gravity, sensor, signals
        """
    @property
    def noise_inflation(self) -> float:
        """
        of the motions' noise variance, so that it covers what stretches disagree by (docs/method, eq. (M31))
        """
    @property
    def normalized_rms(self) -> float:
        """
        of all whitened residuals, before the inflation
        """
    @property
    def outliers(self) -> int:
        ...
    @property
    def parameters(self) -> list[NamedParameter]:
        ...
    @property
    def rank(self) -> int:
        """
        parameter combinations the data alone determine
        """
    @property
    def rows(self) -> int:
        ...
    @property
    def samples(self) -> int:
        ...
    @property
    def starts_tried(self) -> int:
        ...
    @property
    def stretches(self) -> list[StretchResidual]:
        ...
    @property
    def unsettled(self) -> float:
        """
        standard deviations: a parameter's step in the last pass or what is left to the minimum, the larger
        """
    @property
    def weak(self) -> list[WeakCombination]:
        ...
class TemperatureProfile:
    """
    Of the sensor while it records: ``start + rise (1 - exp(-t / time_constant))``.

    Parameters
    ----------
    start, rise : float, degrees Celsius
    time_constant : float, s
    sensor_offset, sensor_noise_std : float, degrees Celsius
        Of the internal thermometer; the noise is white per sample.
    """
    def __init__(self, *, start: typing.SupportsFloat | typing.SupportsIndex = 25.0, rise: typing.SupportsFloat | typing.SupportsIndex = 0.0, time_constant: typing.SupportsFloat | typing.SupportsIndex = 600.0, sensor_offset: typing.SupportsFloat | typing.SupportsIndex = 0.0, sensor_noise_std: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> None:
        ...
    def at(self, time: typing.SupportsFloat | typing.SupportsIndex) -> float:
        """
        True temperature after `time` seconds, degrees Celsius.
        """
    @property
    def rise(self) -> float:
        """
        degrees Celsius
        """
    @property
    def sensor_noise_std(self) -> float:
        """
        degrees Celsius
        """
    @property
    def sensor_offset(self) -> float:
        """
        degrees Celsius
        """
    @property
    def start(self) -> float:
        """
        degrees Celsius
        """
    @property
    def time_constant(self) -> float:
        """
        s
        """
class HeldJoints:
    """
    Joints held by a proportional-derivative loop.

    Parameters
    ----------
    natural_frequency : (n,) array_like, Hz
        0 for a joint that follows exactly; empty for all.
    settling_time : float, s
        Until oscillations have decayed to 2 %.
    """
    def __init__(self, *, natural_frequency: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ..., settling_time: typing.SupportsFloat | typing.SupportsIndex = 3.0) -> None:
        ...
    @property
    def natural_frequency(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) Hz
        """
    @property
    def settling_time(self) -> float:
        """
        s
        """
class AcquisitionOptions:
    """
    What lies between the sensor and the log; everything is off by default.

    The trajectory is given at the analogue rate, `oversampling` times the recording's rate.

    Parameters
    ----------
    oversampling : int
        Analogue instants a sample.
    noise_bands : list of NoiseBand
        Of the sensor.
    response_bands : list of ResponseBand
        Each channel's frequency response is drawn within them.
    resolution : float, m/s^2
        Of the sensor; 0: any change shows.
    signal_cutoff, temperature_cutoff : float, Hz
        -3 dB of the conditioning unit's causal Butterworth filters; 0: none.
    filter_order : int
        Of both.
    cable_noise_std : float, m/s^2
        White, per sample.
    pickup_amplitude : float, m/s^2
    pickup_frequency : float, Hz
    channel_skew : float, s
        Between channels x, y, z, temperature of the multiplexed converter.
    converter_bits : int
        0: no quantisation.
    converter_range : float, m/s^2
        Full scale is plus and minus this at gain 1.
    converter_gain : float
    encoder_rate : float, Hz
        At which encoders are read; each sample holds the last reading. 0: at every sample.
    sheet : AccelerometerModel, optional
        What readings are corrected by, at the recorded temperature; None: they stay raw.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, sec. 3.
    """
    def __init__(self, *, oversampling: typing.SupportsInt | typing.SupportsIndex = 1, noise_bands: collections.abc.Sequence[NoiseBand] = [], response_bands: collections.abc.Sequence[ResponseBand] = [], resolution: typing.SupportsFloat | typing.SupportsIndex = 0.0, signal_cutoff: typing.SupportsFloat | typing.SupportsIndex = 0.0, temperature_cutoff: typing.SupportsFloat | typing.SupportsIndex = 0.0, filter_order: typing.SupportsInt | typing.SupportsIndex = 2, cable_noise_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, pickup_amplitude: typing.SupportsFloat | typing.SupportsIndex = 0.0, pickup_frequency: typing.SupportsFloat | typing.SupportsIndex = 60.0, channel_skew: typing.SupportsFloat | typing.SupportsIndex = 0.0, converter_bits: typing.SupportsInt | typing.SupportsIndex = 0, converter_range: typing.SupportsFloat | typing.SupportsIndex = 300.0, converter_gain: typing.SupportsFloat | typing.SupportsIndex = 1.0, encoder_rate: typing.SupportsFloat | typing.SupportsIndex = 0.0, sheet: AccelerometerModel | None = None) -> None:
        ...
    @property
    def cable_noise_std(self) -> float:
        """
        m/s^2 per sample
        """
    @cable_noise_std.setter
    def cable_noise_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def channel_skew(self) -> float:
        """
        s
        """
    @channel_skew.setter
    def channel_skew(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def converter_bits(self) -> int:
        """
        0: no quantisation
        """
    @converter_bits.setter
    def converter_bits(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def converter_gain(self) -> float:
        ...
    @converter_gain.setter
    def converter_gain(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def converter_range(self) -> float:
        """
        m/s^2 at gain 1
        """
    @converter_range.setter
    def converter_range(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def encoder_rate(self) -> float:
        """
        Hz; 0: at every sample
        """
    @encoder_rate.setter
    def encoder_rate(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def filter_order(self) -> int:
        ...
    @filter_order.setter
    def filter_order(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def noise_bands(self) -> list[NoiseBand]:
        """
        of the sensor
        """
    @noise_bands.setter
    def noise_bands(self, arg0: collections.abc.Sequence[NoiseBand]) -> None:
        ...
    @property
    def oversampling(self) -> int:
        """
        analogue instants a sample
        """
    @oversampling.setter
    def oversampling(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def pickup_amplitude(self) -> float:
        """
        m/s^2
        """
    @pickup_amplitude.setter
    def pickup_amplitude(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def pickup_frequency(self) -> float:
        """
        Hz
        """
    @pickup_frequency.setter
    def pickup_frequency(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def resolution(self) -> float:
        """
        m/s^2; 0: any change shows
        """
    @resolution.setter
    def resolution(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def response_bands(self) -> list[ResponseBand]:
        """
        of the sensor
        """
    @response_bands.setter
    def response_bands(self, arg0: collections.abc.Sequence[ResponseBand]) -> None:
        ...
    @property
    def sheet(self) -> AccelerometerModel | None:
        """
        what readings are corrected by, or None
        """
    @sheet.setter
    def sheet(self, arg0: AccelerometerModel | None) -> None:
        ...
    @property
    def signal_cutoff(self) -> float:
        """
        Hz; 0: none
        """
    @signal_cutoff.setter
    def signal_cutoff(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def temperature_cutoff(self) -> float:
        """
        Hz; 0: none
        """
    @temperature_cutoff.setter
    def temperature_cutoff(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
class JointTrajectory:
    """
    Joint positions with exact derivatives on a uniform clock.

    Made by `joint_trajectory` or `static_poses`, or from arrays of your own.

    Parameters
    ----------
    time : (N,) ndarray, s
    position, velocity, acceleration : (N, n) ndarray of float64, rad or m and their time derivatives
    sample_rate : float, Hz
    """
    def __init__(self, time: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"], position: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"], velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"], acceleration: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"], sample_rate: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def acceleration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, n) rad/s^2 or m/s^2
        """
    @property
    def joints(self) -> int:
        """
        Number of joints n.
        """
    @property
    def position(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, n) rad or m
        """
    @property
    def sample_rate(self) -> float:
        """
        Hz
        """
    @property
    def samples(self) -> int:
        """
        Number of samples N.
        """
    @property
    def time(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (N,) s
        """
    @property
    def velocity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, n) rad/s or m/s
        """
class Dwell:
    """
    All joints rest for `duration` seconds.
    """
    def __init__(self, duration: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        ...
    @property
    def duration(self) -> float:
        """
        s
        """
class PointToPointMove:
    """
    All joints move to `target` (n,) together in `duration` seconds by the minimum-jerk quintic, rest to rest.
    """
    def __init__(self, target: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"], duration: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        ...
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def target(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m
        """
class SteppedSweep:
    """
    One joint rests `dwell` seconds at each of `steps` equally spaced positions over the signed `span` (rad or m), moving `move` seconds between two, and returns in `return_duration` seconds (0: stays).
    """
    def __init__(self, joint: typing.SupportsInt | typing.SupportsIndex, span: typing.SupportsFloat | typing.SupportsIndex, steps: typing.SupportsInt | typing.SupportsIndex = 16, dwell: typing.SupportsFloat | typing.SupportsIndex = 0.8, move: typing.SupportsFloat | typing.SupportsIndex = 0.6, return_duration: typing.SupportsFloat | typing.SupportsIndex = 2.0) -> None:
        ...
    @property
    def dwell(self) -> float:
        """
        s
        """
    @property
    def joint(self) -> int:
        """
        index, base to tip
        """
    @property
    def move(self) -> float:
        """
        s
        """
    @property
    def return_duration(self) -> float:
        """
        s
        """
    @property
    def span(self) -> float:
        """
        rad or m
        """
    @property
    def steps(self) -> int:
        """
        positions, both ends included
        """
class RaisedCosine:
    """
    theta_0 + span (1 - cos(2 pi frequency t)) / 2 of one joint for a whole number of cycles: eq. (11) of Canepa, Hollerbach, Boelen 1994.
    """
    def __init__(self, joint: typing.SupportsInt | typing.SupportsIndex, span: typing.SupportsFloat | typing.SupportsIndex, frequency: typing.SupportsFloat | typing.SupportsIndex = 0.5, duration: typing.SupportsFloat | typing.SupportsIndex = 6.0) -> None:
        ...
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def frequency(self) -> float:
        """
        Hz
        """
    @property
    def joint(self) -> int:
        """
        index, base to tip
        """
    @property
    def span(self) -> float:
        """
        rad or m
        """
class MultiJointMotion:
    """
    All joints at once: per joint the mean of `harmonics` sinusoids of random frequency and phase within plus and minus `amplitude` (n,), faded in and out over `ramp` seconds.
    """
    def __init__(self, duration: typing.SupportsFloat | typing.SupportsIndex, amplitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"], frequency_min: typing.SupportsFloat | typing.SupportsIndex = 0.1, frequency_max: typing.SupportsFloat | typing.SupportsIndex = 0.5, harmonics: typing.SupportsInt | typing.SupportsIndex = 3, ramp: typing.SupportsFloat | typing.SupportsIndex = 2.0, seed: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    @property
    def amplitude(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m
        """
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def frequency_max(self) -> float:
        """
        Hz
        """
    @property
    def frequency_min(self) -> float:
        """
        Hz
        """
    @property
    def harmonics(self) -> int:
        """
        sinusoids a joint
        """
    @property
    def ramp(self) -> float:
        """
        s
        """
    @property
    def seed(self) -> int:
        ...
class VibrationOptions:
    """
    Structural vibration while the arm moves: sinusoids of random phase.

    Parameters
    ----------
    tangential_amplitude : float, m/s^2
        Root sum of squares of the components' amplitudes along the sensor's direction of motion.
    orthogonal_amplitude : float, m/s^2
        The same for each of the two directions orthogonal to it.
    frequency_min, frequency_max : float, Hz
        Below half the sample rate.
    components : int
        Sinusoids a direction.
    ramp : float, s
        Fading in after the start and out before the end of every stretch of motion.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, sec. 4.
    """
    def __init__(self, *, tangential_amplitude: typing.SupportsFloat | typing.SupportsIndex = 0.0, orthogonal_amplitude: typing.SupportsFloat | typing.SupportsIndex = 0.0, frequency_min: typing.SupportsFloat | typing.SupportsIndex = 10.0, frequency_max: typing.SupportsFloat | typing.SupportsIndex = 60.0, components: typing.SupportsInt | typing.SupportsIndex = 5, ramp: typing.SupportsFloat | typing.SupportsIndex = 0.1) -> None:
        ...
    @property
    def components(self) -> int:
        """
        sinusoids a direction
        """
    @property
    def frequency_max(self) -> float:
        """
        Hz
        """
    @property
    def frequency_min(self) -> float:
        """
        Hz
        """
    @property
    def orthogonal_amplitude(self) -> float:
        """
        m/s^2
        """
    @property
    def ramp(self) -> float:
        """
        s
        """
    @property
    def tangential_amplitude(self) -> float:
        """
        m/s^2
        """
class SimulationOptions:
    """
    What the simulated arm and its instruments add to the ideal recording.

    Parameters
    ----------
    noise_std : float, m/s^2
        White noise per sample.
    range : float, m/s^2
        Readings clip at plus and minus this; 0 for no clipping.
    encoder_counts_per_revolution : (n,) array_like
        Per metre for a prismatic joint; 0 for an exact encoder; empty for all exact.
    bias_drift : (3,) array_like, m/s^2
        Reached linearly from zero over the recording.
    compliance : (n,) array_like, rad per m^2/s^2 (prismatic: m per m/s^2)
        How far each joint gives way to the weight of a unit mass at the sensor; empty for a rigid arm.
    vibration : VibrationOptions
    seed : int
    held_joints : HeldJoints
        Joints that follow their command late and ring.
    temperature : TemperatureProfile, optional
        Of the sensor while it records; the recording then has a temperature. None: the sensor is at its reference.
    angular_velocity_noise_std : float, rad/s, optional
        White noise per sample of a gyroscope at the sensor; None: there is no gyroscope.
    acquisition : AcquisitionOptions, optional
        What lies between sensor and log; the trajectory is then given at the analogue rate.
    """
    def __init__(self, *, noise_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, range: typing.SupportsFloat | typing.SupportsIndex = 0.0, encoder_counts_per_revolution: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ..., bias_drift: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ..., compliance: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ..., vibration: VibrationOptions = ..., seed: typing.SupportsInt | typing.SupportsIndex = 0, held_joints: HeldJoints = ..., temperature: TemperatureProfile | None = None, angular_velocity_noise_std: typing.SupportsFloat | typing.SupportsIndex | None = None, acquisition: AcquisitionOptions | None = None) -> None:
        ...
    @property
    def acquisition(self) -> AcquisitionOptions | None:
        """
        or None
        """
    @property
    def angular_velocity_noise_std(self) -> float | None:
        """
        rad/s, or None
        """
    @property
    def bias_drift(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2 over the recording
        """
    @property
    def compliance(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad per m^2/s^2
        """
    @property
    def encoder_counts_per_revolution(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,)
        """
    @property
    def held_joints(self) -> HeldJoints:
        ...
    @property
    def noise_std(self) -> float:
        """
        m/s^2 per sample
        """
    @property
    def range(self) -> float:
        """
        m/s^2; 0: no clipping
        """
    @property
    def seed(self) -> int:
        ...
    @property
    def temperature(self) -> TemperatureProfile | None:
        """
        of the sensor, or None
        """
    @property
    def vibration(self) -> VibrationOptions:
        ...
class Experiment:
    """
    What is common to the repetitions of a simulated experiment.

    Parameters
    ----------
    chain : ScrewChain
        The arm as drawn; base frame = sensor frame at the reference configuration.
    up_gravity_sensor : (3,) array_like, m/s^2
        What an ideal sensor reads at rest there.
    sensor : AccelerometerSpecification
        The kind of sensor individuals are drawn from.
    trajectory : JointTrajectory
    simulation : SimulationOptions
        Its seed, and its acquisition's calibration sheet, are drawn anew every time.
    corrected : bool
        With an acquisition: readings are corrected by the individual's sheet.
    direction_std : float, rad
    point_std : float, m
        Of a built arm's lines about the drawn ones, in each of their local coordinates.
    start_spread : (n,) array_like, rad or m
        Joints start up to this beyond the trajectory, so that encoders round differently every time.
    """
    def __init__(self, *, chain: ScrewChain, up_gravity_sensor: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], sensor: AccelerometerSpecification, trajectory: JointTrajectory, simulation: SimulationOptions = ..., corrected: bool = True, direction_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, point_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, start_spread: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ...) -> None:
        ...
    @property
    def chain(self) -> ScrewChain:
        ...
    @property
    def corrected(self) -> bool:
        ...
    @property
    def direction_std(self) -> float:
        """
        rad
        """
    @property
    def point_std(self) -> float:
        """
        m
        """
    @property
    def sensor(self) -> AccelerometerSpecification:
        ...
    @property
    def simulation(self) -> SimulationOptions:
        ...
    @property
    def start_spread(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) rad or m
        """
    @property
    def trajectory(self) -> JointTrajectory:
        ...
    @property
    def up_gravity_sensor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2
        """
class SimulatedExperiment:
    """
    One repetition: what was recorded, and what is true of it.
    """
    @property
    def chain(self) -> ScrewChain:
        """
        of the arm as built
        """
    @property
    def recording(self) -> Recording:
        ...
    @property
    def sensor(self) -> AccelerometerModel:
        """
        as its readings are recorded
        """
    @property
    def sheet(self) -> AccelerometerModel | None:
        """
        its calibration sheet, with an acquisition; else None
        """
    @property
    def up_gravity_sensor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) m/s^2, at rest at the chain's reference configuration
        """
class LineComparison:
    """
    One line against the truth; NaN where there is no estimate.
    """
    @property
    def error(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        (4,) d1, d2, p1, p2: estimate minus truth, rad and m
        """
    @property
    def nees(self) -> float:
        """
        normalised error squared per degree of freedom: 1 is honest
        """
    @property
    def std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        (4,) predicted
        """
class SensorComparison:
    """
    A sensor's figures against the truth, SI units.
    """
    @property
    def error(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[15, 1]"]:
        """
        (15,) in the order of sensor_figure_names(): estimate minus truth
        """
    @property
    def std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[15, 1]"]:
        """
        (15,) predicted; 0 where a figure was taken as known
        """
class TrialOutcome(enum.Enum):
    """
    How a trial ended.
    """
    complete = ...
    failed = ...
    incomplete = ...
class TrialConditions:
    """
    What is common to the trials of one cell of a campaign.

    Parameters
    ----------
    experiment : Experiment
        What is simulated.
    method : JointCalibrationOptions or WholeArmOptions
        How it is calibrated; each trial in one thread.
    configurations : (P, n) ndarray of float64, rad or m
        The workspace over which the end-point is compared.
    """
    def __init__(self, experiment: Experiment, method: JointCalibrationOptions | WholeArmOptions, configurations: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> None:
        ...
    @property
    def configurations(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (P, n) rad or m
        """
    @property
    def experiment(self) -> Experiment:
        ...
    @property
    def method(self) -> JointCalibrationOptions | WholeArmOptions:
        ...
class TrialResults:
    """
    Many trials, a row each; NaN where there is no figure.
    """
    @property
    def converged(self) -> list[bool]:
        ...
    @property
    def end_point_error(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (N,) m, rms over the configurations
        """
    @property
    def end_point_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (N,) m, predicted
        """
    @property
    def iterations(self) -> list[int]:
        ...
    @property
    def line_error(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, 4 n) d1, d2, p1, p2 of each joint: estimate minus truth
        """
    @property
    def line_nees(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, n) per degree of freedom
        """
    @property
    def line_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, 4 n) predicted
        """
    @property
    def outcome(self) -> list[TrialOutcome]:
        ...
    @property
    def reason(self) -> list[str]:
        """
        why it failed, or the first joint without a line and why
        """
    @property
    def sensor_error(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, 15) in the order of sensor_figure_names()
        """
    @property
    def sensor_std(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (N, 15) predicted
        """
def align_chain(target: ScrewChain, source: ScrewChain, length: typing.SupportsFloat | typing.SupportsIndex = 0.5) -> ChainAlignment:
    """
    Place a chain on another by a rigid transform and offsets of its joints, least squares over the axes.

    Parameters
    ----------
    target, source : ScrewChain
        The same joints at the same reference configuration, such as the calibrated and the nominal arm.
    length : float
        m; weighs a radian of direction against a metre.

    Returns
    -------
    ChainAlignment

    Raises
    ------
    InvalidInput
        Different joints or reference configurations, no joints, or a length that is not positive.
    """
def align_clocks(joint_time: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], joint_positions: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], sensor_time: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], options: ClockAlignmentOptions = ...) -> ClockAlignment:
    """
    Offset and rate between joint and sensor clock.

    No kinematic model is needed: while one joint moves alone, the specific force is linear in cos, sin, acceleration and
    squared
    speed of its angle, so that the delay is the only non-linear unknown of each such motion.

    Parameters
    ----------
    joint_time : (N,) float64 array
        Seconds of the joint clock.
    joint_positions : (N, n) float64 array, C order
        rad, or m for prismatic joints.
    sensor_time : (M,) float64 array
        Seconds of the sensor clock; another epoch is fine.
    specific_force : (M, 3) float64 array, C order
        m/s^2.
    options : ClockAlignmentOptions

    Returns
    -------
    ClockAlignment

    Raises
    ------
    InvalidInput
        Sizes differ, values are not finite, or time does not advance.
    NotIdentifiable
        No motion from which a delay could be measured; the message says what to record.
    """
def align_lines(target: collections.abc.Sequence[Line], source: collections.abc.Sequence[Line], length: typing.SupportsFloat | typing.SupportsIndex = 0.5, types: collections.abc.Sequence[JointType] = []) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    The rigid transform that brings lines closest to their counterparts, such as nominal axes to calibrated ones.

    Parameters
    ----------
    target, source : list of Line
        In correspondence, m.
    length : float
        m; weighs a radian of direction against a metre of position.
    types : list of JointType
        One a line, or none: all revolute. Of a prismatic joint's line only the direction counts.

    Returns
    -------
    (4, 4) float64
        T_target_source; the smallest displacement where the lines leave freedom.

    Raises
    ------
    InvalidInput
        Different numbers of lines or types, or no lines.
    """
def analyse_timeline(time: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], options: TimelineOptions = ...) -> TimelineReport:
    """
    Sample rate, jitter, resolution and gaps of time stamps.

    Parameters
    ----------
    time : (N,) float64 array
        Stamps in seconds, at least 8.
    options : TimelineOptions

    Returns
    -------
    TimelineReport
        Time that runs backwards and rows written twice are listed, not raised.

    Raises
    ------
    InvalidInput
        Fewer than 8 stamps, or one that is not finite.
    """
def available_instruction_sets() -> list[InstructionSet]:
    """
    The vector instructions this processor can run, narrowest first.

    Returns
    -------
    list of InstructionSet
    """
def axis_in_sensor_frame(chain: ScrewChain, joint: typing.SupportsInt | typing.SupportsIndex, q: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> ScrewAxis:
    """
    The axis of one joint (from 0) in the sensor frame at configuration q (n,); it depends on the joints beyond only.

    Raises
    ------
    InvalidInput
        The joint does not exist, or q does not have one entry per joint.
    """
def band_noise(bands: collections.abc.Sequence[NoiseBand], samples: typing.SupportsInt | typing.SupportsIndex, sample_rate: typing.SupportsFloat | typing.SupportsIndex, seed: typing.SupportsInt | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    Three independent channels of Gaussian noise stated by band, flat within each.

    Parameters
    ----------
    bands : list of NoiseBand
    samples : int
    sample_rate : float, Hz
        What lies above half of it folds back.
    seed : int

    Returns
    -------
    (samples, 3) ndarray, m/s^2

    Raises
    ------
    InvalidInput
        For an empty band, an rms below zero, no samples or a rate that is not positive.

    References
    ----------
    docs/method, (M17).
    """
@typing.overload
def butter(order: typing.SupportsInt | typing.SupportsIndex, cutoff: typing.SupportsFloat | typing.SupportsIndex, sample_rate: typing.SupportsFloat | typing.SupportsIndex, btype: typing.Literal['lowpass', 'highpass', 'bandpass', 'bandstop'] = 'lowpass') -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]"]:
    """
    Butterworth filter as second-order sections, as ``scipy.signal.butter(..., output='sos')``.

    Parameters
    ----------
    order : int
        Order of the prototype; a band filter has twice as many poles.
    cutoff : float or (float, float)
        Half-power frequency, or the lower and the upper one of a band, Hz.
    sample_rate : float
        Hz.
    btype : {'lowpass', 'highpass', 'bandpass', 'bandstop'}

    Returns
    -------
    numpy.ndarray, shape (sections, 6)
        Rows b0, b1, b2, 1, a1, a2.

    Raises
    ------
    InvalidInput
        If the order is below 1, a cut-off is not between 0 and half the sample rate, the number of cut-offs does not fit
        `btype`, or `btype` is unknown.

    References
    ----------
    S. Butterworth, On the theory of filter amplifiers, Experimental Wireless 7 (1930).
    """
@typing.overload
def butter(order: typing.SupportsInt | typing.SupportsIndex, cutoff: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"], sample_rate: typing.SupportsFloat | typing.SupportsIndex, btype: typing.Literal['lowpass', 'highpass', 'bandpass', 'bandstop']) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]"]:
    """
    The same with the two cut-off frequencies of a band.
    """
def calibrate_joints(recording: Recording, segmentation: Segmentation, options: JointCalibrationOptions = ...) -> JointCalibration:
    """
    Every joint's axis, one joint at a time, from a segmented recording.

    Parameters
    ----------
    recording : Recording
    segmentation : Segmentation
    options : JointCalibrationOptions

    Returns
    -------
    JointCalibration
        Joints that could not be estimated carry the reason instead of an axis.

    Raises
    ------
    InvalidInput
        Options that do not fit the recording.

    References
    ----------
    docs/method, sections 2 and 3.
    """
def calibrate_whole_arm(recording: Recording, segmentation: Segmentation, options: WholeArmOptions = ...) -> WholeArmCalibration:
    """
    One maximum-likelihood estimate of all joint lines, gravity, the sensor's errors and the delay, from any motion.

    Parameters
    ----------
    recording : Recording
    segmentation : Segmentation
        Its dwells and single-joint tests help to start; motions of several joints count as well.
    options : WholeArmOptions

    Returns
    -------
    WholeArmCalibration
        Joints that never move carry the reason instead of an axis.

    Raises
    ------
    InvalidInput
        Options that do not fit the recording.
    NotIdentifiable
        Nothing moves, or no start leads to a model of the motion.

    References
    ----------
    docs/method, section 8.
    """
def center_by_position(angle: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], sample_rate: typing.SupportsFloat | typing.SupportsIndex, axis_direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], gravity: GravityModel, options: CenterOptions = ...) -> CenterOfRotation:
    """
    Centre of rotation by double integration and a circle (the paper's first method).

    Parameters
    ----------
    angle : (N,) float64
        Joint angle, uniformly sampled from rest, rad.
    specific_force : (N, 3) float64, C order
        Sensor frame, m/s^2.
    sample_rate : float
        Hz.
    axis_direction : (3,) float64
        Unit axis in the sensor frame.
    gravity : GravityModel
        Static model of the same joint, angles from the same zero.
    options : CenterOptions

    Returns
    -------
    CenterOfRotation

    Raises
    ------
    NotIdentifiable
        The joint does not move enough.

    References
    ----------
    Canepa, Hollerbach and Boelen (1994), eq. (4)-(8), (9)-(10); docs/method, section 2.
    """
def center_by_velocity(angle: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], sample_rate: typing.SupportsFloat | typing.SupportsIndex, axis_direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], gravity: GravityModel, options: CenterOptions = ...) -> CenterOfRotation:
    """
    Centre of rotation by single integration and the encoder's rate (the paper's second method).

    Parameters and errors as `center_by_position`.

    Returns
    -------
    CenterOfRotation

    References
    ----------
    Canepa, Hollerbach and Boelen (1994), section 2.2; docs/method, section 2.
    """
def common_normal(first: Line, second: Line, foot_hint: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], parallel_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-09) -> CommonNormal:
    """
    Common normal of two lines.

    Parameters
    ----------
    first, second : Line
    foot_hint : (3,) array
        m, where the feet are taken when the lines are parallel.
    parallel_tolerance : float
        rad; lines that enclose less (or as much less than pi) count as parallel, their angle is 0 or pi exactly.

    Returns
    -------
    CommonNormal
    """
def compare_lines(calibration: JointCalibration, truth: ScrewChain) -> list[LineComparison]:
    """
    Errors of the estimated lines, base to tip.

    Parameters
    ----------
    calibration : JointCalibration
    truth : ScrewChain
        At any reference configuration; it is carried to the estimate's.

    Returns
    -------
    list of LineComparison
        In the true line's tangent basis.

    Raises
    ------
    InvalidInput
        For another number of joints.
    """
def compare_sensor(calibration: JointCalibration, truth: AccelerometerModel) -> SensorComparison:
    """
    Errors of the estimated sensor figures.

    Parameters
    ----------
    calibration : JointCalibration
    truth : AccelerometerModel

    Returns
    -------
    SensorComparison
    """
def concatenate(recordings: collections.abc.Sequence[Recording]) -> Recording:
    """
    Several recordings of one arm as one.

    Each starts a new span; one that does not start after the one before it is moved to one second after its end, which
    ``timeline.notes`` says.

    Parameters
    ----------
    recordings : list of Recording
        Sample rates within 1 % of the first one's.

    Returns
    -------
    Recording

    Raises
    ------
    InvalidInput
        None given, other joints, or sample rates that differ by more than 1 %.
    """
@typing.overload
def correct(model: AccelerometerModel, reading: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], angular_velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    The specific force behind every reading: the exact inverse of `measure`.

    Parameters
    ----------
    model : AccelerometerModel
    reading : (N, 3) ndarray of float64, m/s^2
    angular_velocity : (N, 3) ndarray of float64, rad/s
        In the sensor frame.
    temperature : (N,) ndarray of float64, degrees Celsius, optional
        Of the sensor; without it the sensor is at its model's reference.

    Returns
    -------
    (N, 3) ndarray, m/s^2
        Specific force at the sensor frame's origin.

    Raises
    ------
    InvalidInput
        When the arrays differ in their number of samples, or for a reading the model cannot produce.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
    """
@typing.overload
def correct(model: AccelerometerModel, reading: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], angular_velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], temperature: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    The specific force behind every reading: the exact inverse of `measure`.

    Parameters
    ----------
    model : AccelerometerModel
    reading : (N, 3) ndarray of float64, m/s^2
    angular_velocity : (N, 3) ndarray of float64, rad/s
        In the sensor frame.
    temperature : (N,) ndarray of float64, degrees Celsius, optional
        Of the sensor; without it the sensor is at its model's reference.

    Returns
    -------
    (N, 3) ndarray, m/s^2
        Specific force at the sensor frame's origin.

    Raises
    ------
    InvalidInput
        When the arrays differ in their number of samples, or for a reading the model cannot produce.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
    """
@typing.overload
def cumulative_simpson(y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], *, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], initial: typing.SupportsFloat | typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Cumulative integral along axis 0 by Simpson's rule, as ``scipy.integrate.cumulative_simpson``.

    Parameters
    ----------
    y : numpy.ndarray, shape (n,) or (n, k)
        Integrand; C-contiguous float64, never copied.
    x : numpy.ndarray, shape (n,)
        Abscissae, strictly increasing; in the other form spacing `dx`.
    dx : float
        Spacing of equally spaced samples.
    initial : float, optional
        Put first and added to every value, so that the result has as many rows as `y`.

    Returns
    -------
    numpy.ndarray, shape (n - 1,) or (n - 1, k), or with `initial` that of `y`
        In the unit of `y` times that of `x`.

    Raises
    ------
    TypeError
        If `y` or `x` is not a C-contiguous float64 array.
    InvalidInput
        If there are no samples, or `x` has another length or is not strictly increasing.

    References
    ----------
    K. V. Cartwright, Simpson's rule cumulative integration with MS Excel and irregularly-spaced data, J. of Mathematical
    Sciences and Mathematics Education 12 (2017), equations 8 and 10.
    """
@typing.overload
def cumulative_simpson(y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], *, dx: typing.SupportsFloat | typing.SupportsIndex = 1.0, initial: typing.SupportsFloat | typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    The same for equally spaced samples.
    """
@typing.overload
def cumulative_trapezoid(y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], *, initial: typing.SupportsFloat | typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Cumulative integral along axis 0 by the trapezoid rule, as ``scipy.integrate.cumulative_trapezoid``.

    Parameters
    ----------
    y : numpy.ndarray, shape (n,) or (n, k)
        Integrand; C-contiguous float64, never copied.
    x : numpy.ndarray, shape (n,)
        Abscissae, in the other form spacing `dx`.
    dx : float
        Spacing of equally spaced samples.
    initial : {None, 0}
        0 puts a zero first, so that the result has as many rows as `y`.

    Returns
    -------
    numpy.ndarray, shape (n - 1,) or (n - 1, k), or with `initial` that of `y`
        In the unit of `y` times that of `x`.

    Raises
    ------
    TypeError
        If `y` or `x` is not a C-contiguous float64 array.
    InvalidInput
        If there are no samples, `x` has another length, or `initial` is another number.

    References
    ----------
    Newton-Cotes formula of degree 1.
    """
@typing.overload
def cumulative_trapezoid(y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], *, dx: typing.SupportsFloat | typing.SupportsIndex = 1.0, initial: typing.SupportsFloat | typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    The same for equally spaced samples.
    """
def derive_seed(seed: typing.SupportsInt | typing.SupportsIndex, index: typing.SupportsInt | typing.SupportsIndex) -> int:
    """
    Seed of stream `index` of a parent seed: trial i of a campaign, say, on whatever machine it runs.
    """
@typing.overload
def dh_parameter_jacobian(chain: ScrewChain, at: StandardDhConversion, step: typing.SupportsFloat | typing.SupportsIndex = 1e-06) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
    """
    Derivative of the DH parameters by the axes' local coordinates.

    Parameters
    ----------
    chain : ScrewChain
    at : StandardDhConversion or ModifiedDhConversion
        The conversion of this chain.
    step : float
        Of the central differences, rad and m; less is used where neighbours are near-parallel.

    Returns
    -------
    (4 n, 4 n) array
        Rows a, alpha, d, theta of each DH row; columns d1, d2, p1, p2 of each axis (see JointAxis). The covariance of the
        parameters is J C J^T. Rows of free parameters are zero; rows of parameters without a derivative, because their
        neighbours are exactly parallel, are NaN.

    Raises
    ------
    InvalidInput
        The conversion is of another number of joints, or the step is not a small positive number.
    """
@typing.overload
def dh_parameter_jacobian(chain: ScrewChain, at: ModifiedDhConversion, step: typing.SupportsFloat | typing.SupportsIndex = 1e-06) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
    """
    Derivative of the DH parameters by the axes' local coordinates.

    Parameters
    ----------
    chain : ScrewChain
    at : StandardDhConversion or ModifiedDhConversion
        The conversion of this chain.
    step : float
        Of the central differences, rad and m; less is used where neighbours are near-parallel.

    Returns
    -------
    (4 n, 4 n) array
        Rows a, alpha, d, theta of each DH row; columns d1, d2, p1, p2 of each axis (see JointAxis). The covariance of the
        parameters is J C J^T. Rows of free parameters are zero; rows of parameters without a derivative, because their
        neighbours are exactly parallel, are NaN.

    Raises
    ------
    InvalidInput
        The conversion is of another number of joints, or the step is not a small positive number.
    """
def draw_accelerometer(specification: AccelerometerSpecification, seed: typing.SupportsInt | typing.SupportsIndex) -> AccelerometerModel:
    """
    One individual sensor of a kind.

    Parameters
    ----------
    specification : AccelerometerSpecification
    seed : int
        The same seed draws the same sensor.

    Returns
    -------
    AccelerometerModel

    Raises
    ------
    InvalidInput
        For a standard deviation that is negative or not finite.
    """
def draw_calibrated_accelerometer(specification: AccelerometerSpecification, seed: typing.SupportsInt | typing.SupportsIndex) -> CalibratedAccelerometer:
    """
    One individual sensor of a kind with the calibration sheet that came with it.

    Correcting the actual sensor's readings by the sheet leaves what a sensor with the residual errors alone reads.

    Parameters
    ----------
    specification : AccelerometerSpecification
    seed : int
        `residual` is what `draw_accelerometer` draws with it.

    Returns
    -------
    CalibratedAccelerometer

    Raises
    ------
    InvalidInput
        For a standard deviation that is negative or not finite.

    References
    ----------
    docs/method, (M15).
    """
def draw_response(bands: collections.abc.Sequence[ResponseBand], seed: typing.SupportsInt | typing.SupportsIndex) -> SecondOrderResponse:
    """
    One individual's frequency response, within all bands; InvalidInput where there is none.
    """
def encoder_step(positions: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> float:
    """
    The step of an encoder, as its readings show it.

    Parameters
    ----------
    positions : (N,) ndarray, rad or m
        One joint's raw readings.

    Returns
    -------
    float
        The least difference of two values each held for two samples in succession, rad or m; 0 where that exceeds
        1/512 of a revolution or the joint never moves.
    """
def end_point_error(estimate: ScrewChain, truth: ScrewChain, configurations: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> float:
    """
    Root mean square distance between estimated and true sensor position over configurations.

    Parameters
    ----------
    estimate, truth : ScrewChain
        Both are seen from the sensor's frame at the estimate's reference configuration.
    configurations : (P, n) ndarray of float64, rad or m

    Returns
    -------
    float
        m.

    Raises
    ------
    InvalidInput
        For numbers of joints that differ, and for no configuration.
    """
@typing.overload
def end_point_std(chain: ScrewChain, line_covariance: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.f_contiguous"], configurations: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
    """
    Predicted standard deviation of the sensor's position.

    Parameters
    ----------
    chain : ScrewChain
    line_covariance : (4n, 4n) float64
        Of the lines' local coordinates.
    configurations : (P, n) float64
        rad or m.

    Returns
    -------
    (P,) float64
        Root of the position covariance's trace, m.
    """
@typing.overload
def end_point_std(calibration: WholeArmCalibration, configurations: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
    """
    Predicted standard deviation of the sensor's position, from the lines' errors and those of the encoders' corrections.

    Parameters
    ----------
    calibration : WholeArmCalibration
    configurations : (P, n) float64
        rad or m, as the joints stand when corrected for what their encoders were found to be off.

    Returns
    -------
    (P,) float64
        Root of the position covariance's trace, m.

    Raises
    ------
    NotIdentifiable
        A joint has no axis.

    References
    ----------
    docs/method, sections 3.7 and 8.5.
    """
def fit_axis_direction(specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"]) -> AxisDirectionFit:
    """
    Axis direction from static poses, closed form: the smallest eigenvector of the scatter.

    Parameters
    ----------
    specific_force : (N, 3) float64, C order
        Mean reading of each static pose, m/s^2.

    Returns
    -------
    AxisDirectionFit
        The sign of the direction is arbitrary; see `orient_axis`.

    Raises
    ------
    InvalidInput
        Fewer than 3 poses, or a value that is not finite.
    NotIdentifiable
        The poses do not spread over a plane: axis parallel to gravity, or hardly any turning.

    References
    ----------
    Canepa, Hollerbach and Boelen (1994), section 2.1, eq. (3); docs/method, section 2.
    """
def fit_axis_direction_robust(specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], loss_scale: typing.SupportsFloat | typing.SupportsIndex = 3.0, max_iterations: typing.SupportsInt | typing.SupportsIndex = 50, chart: AxisChart = ...) -> AxisDirectionFit:
    """
    Axis direction by iteration, with a Cauchy loss: poses disturbed by a knock are down-weighted.

    Parameters
    ----------
    specific_force : (N, 3) float64, C order
        Mean reading of each static pose, m/s^2.
    loss_scale : float
        Residuals beyond this many robust standard deviations lose weight; infinity: plain least squares.
    max_iterations : int
        Of the reweighting.
    chart : AxisChart
        ``sphere``: the tangent plane. ``hemisphere``: the paper's l, m with n = sqrt(1 - l^2 - m^2), started at l = m = 0;
        an axis nearly in the sensor's x-y plane is reached slowly or not at all.

    Returns
    -------
    AxisDirectionFit

    Raises
    ------
    InvalidInput, NotIdentifiable
        As `fit_axis_direction`; InvalidInput also when `loss_scale` is not positive.

    References
    ----------
    Canepa, Hollerbach and Boelen (1994), section 4, with its constraint corrected; docs/method, errata.
    """
def fit_circle(points: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]", "flags.c_contiguous"]) -> CircleFit:
    """
    Geometric least-squares circle.

    Parameters
    ----------
    points : (N, 2) float64, C order
        Any unit.

    Returns
    -------
    CircleFit

    Raises
    ------
    InvalidInput
        Fewer than 3 points, or a value that is not finite.
    NotIdentifiable
        The points lie on a line.
    """
def fit_gravity_model(angle: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"]) -> GravityModel:
    """
    Least-squares gravity model of one joint's static sweep.

    Parameters
    ----------
    angle : (N,) float64
        rad.
    specific_force : (N, 3) float64, C order
        m/s^2.

    Returns
    -------
    GravityModel

    Raises
    ------
    NotIdentifiable
        Fewer than three distinct angles.
    """
def fit_joint_model(weighted: RegressionStatistics, prior: JointModelPrior = ...) -> JointModelFit:
    """
    Maximum-likelihood joint model from sufficient statistics.

    Parameters
    ----------
    weighted : RegressionStatistics
        Divided by the noise variance: weights 1/sigma^2.
    prior : JointModelPrior

    Returns
    -------
    JointModelFit
        Parameters of the information: direction (2), gravity (2), lever (2) in tangent_basis(axis), constant (3),
        percussion distances (3).

    Raises
    ------
    NotIdentifiable
        The joint never accelerated, or its readings do not change.

    References
    ----------
    docs/method, section 3.
    """
def fit_sensor_from_gravity(dwell_specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], specification: AccelerometerSpecification, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665, adapt_prior: bool = False, dwell_noise_std: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> SensorFromGravity:
    """
    Bias, scale, misalignment and second-order error from |f| = g at rest, with a prior.

    Parameters
    ----------
    dwell_specific_force : (K, 3) float64, C order
        Mean reading of each dwell, m/s^2.
    specification : AccelerometerSpecification
        Prior standard deviations.
    gravity : float
        Local magnitude, m/s^2.
    adapt_prior : bool
        Let the dwells set the prior's common width.
    dwell_noise_std : float
        Noise of a dwell's mean by the scatter of its own samples, m/s^2: the least that is assumed.

    Returns
    -------
    SensorFromGravity

    Raises
    ------
    InvalidInput
        Gravity not positive, or a dwell without a finite reading.
    """
def follow(commanded: JointTrajectory, joints: HeldJoints) -> JointTrajectory:
    """
    The motion that held joints make of a commanded one.

    Parameters
    ----------
    commanded : JointTrajectory
    joints : HeldJoints

    Returns
    -------
    JointTrajectory

    Raises
    ------
    InvalidInput
        For another number of joints, or a frequency that is negative or too low to ring.

    References
    ----------
    docs/method, (M22).
    """
@typing.overload
def forward_kinematics(chain: ScrewChain, q: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
@typing.overload
def forward_kinematics(chain: ScrewChain, q: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
@typing.overload
def forward_kinematics(chain: StandardDhChain, q: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
@typing.overload
def forward_kinematics(chain: StandardDhChain, q: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
@typing.overload
def forward_kinematics(chain: ModifiedDhChain, q: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
@typing.overload
def forward_kinematics(chain: ModifiedDhChain, q: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
@typing.overload
def forward_kinematics(chain: HayatiChain, q: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
@typing.overload
def forward_kinematics(chain: HayatiChain, q: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Pose of the sensor frame in the base frame.

    Parameters
    ----------
    chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
    q : (n,) or (N, n) array
        Joint positions, rad or m; (N, n) must be C-contiguous float64.

    Returns
    -------
    (4, 4) or (N, 4, 4) array
        T_base_sensor.

    Raises
    ------
    InvalidInput
        q does not have one entry per joint.
    """
def frame_motion(chain: ScrewChain, q: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], q_dot: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], q_ddot: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> FrameMotion:
    """
    Pose, velocity and acceleration of the sensor frame.

    Parameters
    ----------
    chain : ScrewChain
    q, q_dot, q_ddot : (n,) array
        Joint positions (rad or m), rates and accelerations.

    Returns
    -------
    FrameMotion

    Raises
    ------
    InvalidInput
        An array does not have one entry per joint.
    """
def gradient(y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], dx: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, edge_order: typing.SupportsInt | typing.SupportsIndex = 1) -> numpy.typing.NDArray[numpy.float64]:
    """
    First derivative along axis 0 by central differences, as ``numpy.gradient``.

    Parameters
    ----------
    y : numpy.ndarray, shape (n,) or (n, k)
        Equally spaced samples; C-contiguous float64, never copied.
    dx : float
        Spacing.
    edge_order : {1, 2}
        Order of the one-sided differences at the ends.

    Returns
    -------
    numpy.ndarray, shape of `y`
        In the unit of `y` over that of `dx`.

    Raises
    ------
    TypeError
        If `y` is not a C-contiguous float64 array with one or two axes.
    InvalidInput
        If there are fewer than edge_order + 1 samples, `edge_order` is neither 1 nor 2, or `dx` is zero or not finite.

    References
    ----------
    B. Fornberg, Generation of finite difference formulas on arbitrarily spaced grids, Math. Comp. 51 (1988).
    """
def hayati_parameter_jacobian(chain: ScrewChain, at: HayatiConversion, step: typing.SupportsFloat | typing.SupportsIndex = 1e-06) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
    """
    Derivative of the rows' parameters by the axes' local coordinates.

    Parameters
    ----------
    chain : ScrewChain
    at : HayatiConversion
        The conversion of this chain.
    step : float
        Of the central differences, rad and m.

    Returns
    -------
    (5 n, 4 n) array
        Rows a, alpha, d, theta, beta of each row; columns d1, d2, p1, p2 of each axis. Rows of free parameters, and of the d
        or beta a row does not have, are zero.

    Raises
    ------
    InvalidInput
        The conversion is of another number of joints, or the step is not a small positive number.
    """
def hayati_transform(row: HayatiRow, type: JointType, q: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    T_i-1_i (4, 4) of one row at joint value q: Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha) Rot_y(beta).
    """
def instruction_set() -> InstructionSet:
    """
    The vector instructions in use: the widest, or what CIRCLEPOINT_INSTRUCTION_SET named when the first kernel ran.

    Returns
    -------
    InstructionSet
    """
def interpolate_cubic(knots: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], values: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], at: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
    """
    Cubic not-a-knot spline through samples.

    Parameters
    ----------
    knots : (N,) float64 array
        Strictly increasing.
    values : (N, channels) float64 array, C order
    at : (M,) float64 array
        Where to evaluate; outside the knots the end pieces are continued.

    Returns
    -------
    (M, channels) float64 array

    Raises
    ------
    InvalidInput
        Sizes differ or the knots do not increase.
    """
def joint_compliance(stiffness: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], mass: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
    """
    How far joints of a stiffness give way: `SimulationOptions.compliance`.

    Parameters
    ----------
    stiffness : (n,) array_like, N m/rad (prismatic: N/m)
    mass : float, kg
        The load at the sensor.

    Returns
    -------
    (n,) ndarray

    Raises
    ------
    InvalidInput
        For a stiffness that is not positive or a negative mass.
    """
def joint_frame(axis_direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
    """
    The frame O_w of a joint: columns x_w, y_w, z_w in the sensor frame.

    Parameters
    ----------
    axis_direction : (3,) float64
        Any length but zero.

    Returns
    -------
    (3, 3) float64
        R_sensor_joint, eq. (1) of Canepa, Hollerbach and Boelen (1994).
    """
def joint_regressors(angle: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], rate: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], acceleration: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 5]"]:
    """
    Regressors 1, cos(angle), sin(angle), acceleration, rate^2 of one joint's motion.

    Parameters
    ----------
    angle, rate, acceleration : (N,) float64
        rad, rad/s, rad/s^2.

    Returns
    -------
    (N, 5) float64

    References
    ----------
    docs/method, section 3.
    """
def joint_rests(recording: Recording, options: StaticIntervalOptions = ...) -> list[list[IndexRange]]:
    """
    For each joint, the intervals in which it rests.

    Parameters
    ----------
    recording : Recording
    options : StaticIntervalOptions

    Returns
    -------
    list of list of IndexRange
        One list a joint, in order of time. No interval crosses a gap; momentary turning points and slow creeping are not
        rests.

    Raises
    ------
    InvalidInput
        Where the recording's parts do not match, values are not finite or an option is out of its range.
    """
def joint_statistics(angle: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], rate: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], acceleration: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], readings: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], rotation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"] = ...) -> RegressionStatistics:
    """
    Statistics of one motion: its regressors by the readings, in one pass and without the regressors in memory.

    Parameters
    ----------
    angle, rate, acceleration : (N,) float64
        rad, rad/s, rad/s^2.
    readings : (N, 3) float64
        m/s^2.
    rotation : (3, 3) float64
        Turns the readings from the sensor frame to that of the result.

    Returns
    -------
    RegressionStatistics
        As `add` with `joint_regressors` and the turned readings.

    Raises
    ------
    InvalidInput
        On unequal lengths.

    References
    ----------
    docs/method, section 3.
    """
def joint_trajectory(start: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], pieces: collections.abc.Sequence[Dwell | PointToPointMove | SteppedSweep | RaisedCosine | MultiJointMotion], sample_rate: typing.SupportsFloat | typing.SupportsIndex, rest: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> JointTrajectory:
    """
    Pieces of motion in order, sampled on a uniform clock.

    Derivatives are those of the formulas, never differences.

    Parameters
    ----------
    start : (n,) array_like, rad or m
        Where the joints are before the first piece.
    pieces : sequence of Dwell, PointToPointMove, SteppedSweep, RaisedCosine or MultiJointMotion
        Each begins where the one before ended.
    sample_rate : float, Hz
    rest : float, s
        The joints rest this long before the first piece, between any two and after the last.

    Returns
    -------
    JointTrajectory

    Raises
    ------
    InvalidInput
        For durations or rates that are not positive, joints that do not exist, values that are not finite, and a raised
        cosine of a fractional number of cycles.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, eq. (11); Flash and Hogan 1985 (minimum jerk).
    """
def line_from_pluecker(direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], moment: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> Line:
    """
    Line from Pluecker coordinates, direction (3,) and moment (3,), m.

    The part of the moment along the direction is dropped.

    Raises
    ------
    InvalidInput
        The direction is zero, or something is not finite.
    """
def local_coordinates(line: Line, other: Line) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
    """
    Local coordinates (4,) of a line at another: ``retract(line, local_coordinates(line, other)) == other``.

    Raises
    ------
    InvalidInput
        The lines are at right angles.
    """
def local_coordinates_jacobian(T_a_b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"], axis_b: ScrewAxis) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Derivative (4, 4) of the local coordinates in a by those in b; rows and columns p of a prismatic axis are zero.
    """
def make_line(direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], point_on_line: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> Line:
    """
    Line through a point along a direction.

    Parameters
    ----------
    direction : (3,) array
        Any length but zero.
    point_on_line : (3,) array
        m, any point of the line.

    Raises
    ------
    InvalidInput
        The direction is zero, or something is not finite.
    """
@typing.overload
def make_recording(time: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], joint_positions: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], *, angular_velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"] | None = None, temperature: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"] | None = None, options: TimelineOptions = ...) -> Recording:
    """
    A recording from one log.

    Rounded stamps are replaced by the uniform clock they fit; stamps with true jitter are believed and the samples
    interpolated;
    short gaps are filled and reported, longer ones split the recording into spans.

    Parameters
    ----------
    time : (N,) float64 array
        Seconds, N >= 8.
    joint_positions : (N, n) float64 array, C order
        rad, or m for prismatic joints; raw encoder values.
    specific_force : (N, 3) float64 array, C order
        m/s^2; at rest it reads +g upwards.
    angular_velocity : (N, 3) float64 array, optional
        rad/s.
    temperature : (N,) float64 array, optional
        Degrees Celsius.
    options : TimelineOptions

    Returns
    -------
    Recording

    Raises
    ------
    InvalidInput
        Sizes differ, a value is not finite (row, column), or time does not advance (row, both values).
    """
@typing.overload
def make_recording(joint_time: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], joint_positions: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], sensor_time: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], clock: ClockModel, *, angular_velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"] | None = None, temperature: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"] | None = None, options: TimelineOptions = ...) -> Recording:
    """
    A recording from two logs with two clocks.

    The sensor's samples are kept, the joints interpolated at them; time is the joint clock's.

    Parameters
    ----------
    joint_time : (N,) float64 array
        Seconds of the joint clock.
    joint_positions : (N, n) float64 array, C order
        rad, or m for prismatic joints.
    sensor_time : (M,) float64 array
        Seconds of the sensor clock.
    specific_force : (M, 3) float64 array, C order
        m/s^2; at rest it reads +g upwards.
    clock : ClockModel
        sensor_time = offset + rate * joint_time; see align_clocks.
    angular_velocity : (M, 3) float64 array, optional
        rad/s.
    temperature : (M,) float64 array, optional
        Degrees Celsius.
    options : TimelineOptions

    Returns
    -------
    Recording

    Raises
    ------
    InvalidInput
        As with one log, and where the logs do not overlap under the clock model.
    """
def make_rigid_transform(matrix: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"], tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-09) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    A homogeneous matrix, checked to be a rigid transform.

    Parameters
    ----------
    matrix : (4, 4) array
        ``[[R, p], [0, 1]]``, p in m.
    tolerance : float
        Largest entry of ``R R^T - I`` and of the last row's error.

    Returns
    -------
    (4, 4) array

    Raises
    ------
    InvalidInput
        An entry is not finite, the last row is not (0, 0, 0, 1), or R is not a proper rotation.
    """
def make_static_recording(joint_positions: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], *, angular_velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"] | None = None, temperature: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"] | None = None) -> Recording:
    """
    A table of still poses, each row the mean of one rest, as a recording.

    It shows the directions of revolute axes, not where they are. Every row is a span of its own; ``time`` counts the rows.

    Parameters
    ----------
    joint_positions : (P, n) float64 array, C order
        rad, or m for prismatic joints; P >= 3.
    specific_force : (P, 3) float64 array, C order
        m/s^2, what the sensor read at rest, on average; +g upwards.
    angular_velocity : (P, 3) float64 array, optional
        rad/s.
    temperature : (P,) float64 array, optional
        Degrees Celsius.

    Returns
    -------
    Recording

    Raises
    ------
    InvalidInput
        Sizes differ, there are fewer than 3 poses, or a value is not finite (row, column).
    """
@typing.overload
def measure(model: AccelerometerModel, specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], angular_velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    What the sensor reads at every sample, without noise.

    Parameters
    ----------
    model : AccelerometerModel
    specific_force : (N, 3) ndarray of float64, m/s^2
        At the sensor frame's origin, in the sensor frame; at rest +g upwards.
    angular_velocity : (N, 3) ndarray of float64, rad/s
        In the sensor frame.
    temperature : (N,) ndarray of float64, degrees Celsius, optional
        Of the sensor; without it the sensor is at its model's reference.

    Returns
    -------
    (N, 3) ndarray, m/s^2

    Raises
    ------
    InvalidInput
        When the arrays differ in their number of samples, or a temperature is not finite.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
    """
@typing.overload
def measure(model: AccelerometerModel, specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], angular_velocity: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], temperature: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    What the sensor reads at every sample, without noise.

    Parameters
    ----------
    model : AccelerometerModel
    specific_force : (N, 3) ndarray of float64, m/s^2
        At the sensor frame's origin, in the sensor frame; at rest +g upwards.
    angular_velocity : (N, 3) ndarray of float64, rad/s
        In the sensor frame.
    temperature : (N,) ndarray of float64, degrees Celsius, optional
        Of the sensor; without it the sensor is at its model's reference.

    Returns
    -------
    (N, 3) ndarray, m/s^2

    Raises
    ------
    InvalidInput
        When the arrays differ in their number of samples, or a temperature is not finite.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
    """
def modified_dh_transform(row: DhRow, type: JointType, q: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    T_i-1_i (4, 4) of one row at joint value q: Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d).
    """
def orient_axis(direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], angle: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], specific_force: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
    """
    The direction or its opposite, whichever turns the samples the way the joint turned.

    Parameters
    ----------
    direction : (3,) float64
        Unit axis, sensor frame.
    angle : (N,) float64
        Joint angle of each pose, rad.
    specific_force : (N, 3) float64, C order
        m/s^2.

    Returns
    -------
    (3,) float64
    """
def output_current(reading: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], current_scale_factor: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    (N, 3) A: what a servo accelerometer of that scale factor (A s^2/m) gives out for readings (N, 3) m/s^2.
    """
def paper_acquisition() -> AcquisitionOptions:
    """
    The acquisition chain of Canepa, Hollerbach, Boelen 1994, sec. 3: 250 Hz and 1 Hz filters, channels 25 us apart, encoders at 1 kHz; assumed: 16 bits over +-300 m/s^2 at gain 8, filters of second order, 8 analogue instants a sample. Sensor noise and response are not in it.
    """
def reading_from_current(current: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]", "flags.c_contiguous"], current_scale_factor: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    (N, 3) m/s^2: the readings behind currents (N, 3) A.
    """
def rebase(chain: ScrewChain, reference_configuration: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> ScrewChain:
    """
    The same chain at another reference configuration (n,), in the sensor frame there; home is the identity.

    Raises
    ------
    InvalidInput
        reference_configuration does not have one entry per joint.
    """
def response_section(response: SecondOrderResponse, sample_rate: typing.SupportsFloat | typing.SupportsIndex, exact_at: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[1, 6]"]:
    """
    (1, 6) second-order section of a sampled response, exact at 0 and at `exact_at` Hz.
    """
def rest_band(encoder_step: typing.SupportsFloat | typing.SupportsIndex, options: StaticIntervalOptions = ...) -> float:
    """
    The band a revolute joint at rest stays in for `rest_window` seconds.

    Parameters
    ----------
    encoder_step : float, rad
    options : StaticIntervalOptions

    Returns
    -------
    float
        The larger of 1.5 encoder steps and `min_velocity * rest_window`, rad.
    """
def retract(line: Line, local: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 1]"]) -> Line:
    """
    The line displaced by local coordinates (d1, d2, p1, p2), (4,), rad and m.
    """
def rotation_exp(rotation_vector: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
    """
    Rotation matrix (3, 3) of a rotation vector (3,), rad.
    """
def rotation_log(rotation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
    """
    Rotation vector (3,), rad, of norm at most pi, of a proper rotation matrix (3, 3).
    """
def run_trials(conditions: TrialConditions, seeds: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], threads: typing.SupportsInt | typing.SupportsIndex = 1, progress: collections.abc.Callable[[int], None] | None = None) -> TrialResults:
    """
    Simulate, calibrate, compare with the truth: one trial a seed, in threads of the core.

    Parameters
    ----------
    conditions : TrialConditions
    seeds : sequence of int
        A trial is its conditions and its seed and nothing else.
    threads : int
        They change the time, never a bit of the result.
    progress : callable, optional
        Called on the calling thread with the number of trials done; what it raises stops the trials not yet begun.

    Returns
    -------
    TrialResults

    Raises
    ------
    InvalidInput
        For conditions that cannot be simulated. Estimates that fail are results with their reason.
    """
def savgol_filter(x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], window_length: typing.SupportsInt | typing.SupportsIndex, polyorder: typing.SupportsInt | typing.SupportsIndex, deriv: typing.SupportsInt | typing.SupportsIndex = 0, delta: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> numpy.typing.NDArray[numpy.float64]:
    """
    Savitzky-Golay smoothing or derivative along axis 0, as ``scipy.signal.savgol_filter(mode='interp')``.

    Parameters
    ----------
    x : numpy.ndarray, shape (n,) or (n, k)
        Equally spaced samples; C-contiguous float64, never copied.
    window_length : int
        Samples a window; odd, at most n.
    polyorder : int
        Order of the polynomial fitted to each window, less than `window_length`.
    deriv : int
        Order of the derivative; 0 smooths.
    delta : float
        Spacing.

    Returns
    -------
    numpy.ndarray, shape of `x`
        In the unit of `x` over that of `delta` to the power `deriv`.

    Raises
    ------
    TypeError
        If `x` is not a C-contiguous float64 array with one or two axes.
    InvalidInput
        If `window_length` is even or exceeds n, `polyorder` is not less than it, `deriv` is negative, or `delta` is zero or
        not finite.

    References
    ----------
    A. Savitzky, M. J. E. Golay, Smoothing and differentiation of data by simplified least squares procedures, Analytical
    Chemistry 36 (1964).
    """
def screw_exp(axis: ScrewAxis, q: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Displacement (4, 4) of everything beyond the joint when it moves by q (rad or m).
    """
def segment(recording: Recording, options: SegmentationOptions = ...) -> Segmentation:
    """
    Finds the dwells, single-joint motions and tests in one continuous log.

    Parameters
    ----------
    recording : Recording
    options : SegmentationOptions

    Returns
    -------
    Segmentation
        Dwells and motions in order of time, tests base to tip with the largest span first. A log without any gives empty
        lists.

    Raises
    ------
    InvalidInput
        Where the recording's parts do not match, values are not finite or an option is out of its range.
    """
def sensor_figure_names() -> list[str]:
    """
    Names of a sensor's figures in the order of SensorComparison: bias_x to second_order_z.
    """
def simulate(chain: ScrewChain, up_gravity_sensor: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], sensor: AccelerometerModel, trajectory: JointTrajectory, options: SimulationOptions = ...) -> Recording:
    """
    The recording a real arm and a real sensor would have made of a motion.

    Parameters
    ----------
    chain : ScrewChain
        Lines in the sensor frame at the reference configuration.
    up_gravity_sensor : (3,) array_like, m/s^2
        What an ideal sensor reads at rest at the reference configuration.
    sensor : AccelerometerModel
    trajectory : JointTrajectory
        Commanded motion.
    options : SimulationOptions

    Returns
    -------
    Recording
        The same seed gives the same bytes.

    Raises
    ------
    InvalidInput
        Where sizes do not match the chain or an option is out of its range.

    References
    ----------
    Canepa, Hollerbach, Boelen 1994, sec. 4.
    """
def simulate_experiment(experiment: Experiment, seed: typing.SupportsInt | typing.SupportsIndex) -> SimulatedExperiment:
    """
    The repetition a seed stands for: an individual sensor on an individual arm, and what it recorded.

    Parameters
    ----------
    experiment : Experiment
    seed : int
        The same seed gives the same bytes.

    Returns
    -------
    SimulatedExperiment

    Raises
    ------
    InvalidInput
        As `simulate`; for standard deviations below zero, and a start_spread that is not one a joint.
    """
def skew(v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
    """
    Skew-symmetric (3, 3) matrix of a (3,) vector: ``skew(v) @ u == cross(v, u)``.
    """
def sosfilt(sos: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]", "flags.c_contiguous"], x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Filter along axis 0 by a cascade of second-order sections, from rest, as ``scipy.signal.sosfilt``.

    Parameters
    ----------
    sos : array_like, shape (sections, 6)
        Rows b0, b1, b2, 1, a1, a2.
    x : numpy.ndarray, shape (n,) or (n, k)
        Signal in any unit; C-contiguous float64, never copied.

    Returns
    -------
    numpy.ndarray, shape of `x`
        In the unit of `x`; equal to SciPy's to the last bit.

    Raises
    ------
    TypeError
        If `x` is not a C-contiguous float64 array with one or two axes.
    InvalidInput
        If `sos` is empty or a row has a0 other than 1.

    References
    ----------
    A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing, section 6.3 (transposed direct form II).
    """
def sosfilt_zi(sos: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
    """
    States in which a cascade answers a unit step with its final value at once.

    Parameters
    ----------
    sos : array_like, shape (sections, 6)
        Rows b0, b1, b2, 1, a1, a2.

    Returns
    -------
    numpy.ndarray, shape (sections, 2)

    Raises
    ------
    InvalidInput
        If `sos` is empty, a row has a0 other than 1, or a section has a pole at z = 1.

    References
    ----------
    ``scipy.signal.sosfilt_zi``.
    """
def sosfiltfilt(sos: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]", "flags.c_contiguous"], x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], padtype: typing.Literal['odd', 'even', 'constant', 'none'] | None = 'odd', padlen: typing.SupportsInt | typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Zero-phase filter along axis 0: forwards and backwards, as ``scipy.signal.sosfiltfilt``.

    Parameters
    ----------
    sos : array_like, shape (sections, 6)
        Rows b0, b1, b2, 1, a1, a2.
    x : numpy.ndarray, shape (n,) or (n, k)
        Signal in any unit; C-contiguous float64, never copied.
    padtype : {'odd', 'even', 'constant', 'none'} or None
        How the signal is continued beyond its ends: by its point reflection, its mirror image, its end value, or not.
    padlen : int, optional
        Samples added at each end, fewer than n; by default three times the number of taps.

    Returns
    -------
    numpy.ndarray, shape of `x`
        In the unit of `x`.

    Raises
    ------
    TypeError
        If `x` is not a C-contiguous float64 array with one or two axes.
    InvalidInput
        If `x` has `padlen` samples or fewer, `padlen` is negative, `padtype` is unknown, or `sos` is as in `sosfilt_zi`.

    References
    ----------
    F. Gustafsson, Determining the initial states in forward-backward filtering, IEEE Trans. Signal Processing 44 (1996).
    """
def specific_force(motion: FrameMotion, up_gravity_base: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
    """
    Specific force at the sensor origin, in the sensor frame, (3,), m/s^2.

    Parameters
    ----------
    motion : FrameMotion
    up_gravity_base : (3,) array
        -g in base coordinates, m/s^2: what an ideal sensor at rest reads there.
    """
def standard_dh_transform(row: DhRow, type: JointType, q: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    T_i-1_i (4, 4) of one row at joint value q: Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha).
    """
def static_intervals(recording: Recording, options: StaticIntervalOptions = ...) -> list[IndexRange]:
    """
    The intervals in which every joint rests and the sensor is quiet.

    The settling tail is dropped where the standard error of the interval's mean is smallest.

    Parameters
    ----------
    recording : Recording
    options : StaticIntervalOptions

    Returns
    -------
    list of IndexRange
        In order of time, none shorter than `min_dwell`. No interval crosses a gap.

    Raises
    ------
    InvalidInput
        Where the recording's parts do not match, values are not finite or an option is out of its range.

    References
    ----------
    White, K. P., "An effective truncation heuristic for bias reduction in simulation output", Simulation 69(6), 1997.
    """
def static_poses(poses: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], sample_rate: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> JointTrajectory:
    """
    One sample a pose, at rest: the means of a static test's dwells.

    Parameters
    ----------
    poses : (N, n) ndarray of float64, rad or m
    sample_rate : float, Hz

    Returns
    -------
    JointTrajectory

    Raises
    ------
    InvalidInput
        For no poses, or values that are not finite.
    """
def tangent_basis(z: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 2]"]:
    """
    Two unit vectors (columns of a (3, 2) array) that complete the unit vector z (3,) to a right-handed frame [u v z].

    u is the part of e_x orthogonal to z (of e_y where ``abs(z[0]) > 0.9``), ``v = cross(z, u)``. Every tangent-plane
    coordinate and covariance of an axis is in this basis.
    """
def to_hayati(chain: ScrewChain, nominal: StandardDhChain | None = None, near_parallel_threshold: typing.SupportsFloat | typing.SupportsIndex = 0.05, forms: collections.abc.Sequence[RowForm] = []) -> HayatiConversion:
    """
    Denavit-Hartenberg rows, with a Hayati row before nearly parallel axes.

    Parameters
    ----------
    chain : ScrewChain
    nominal : StandardDhChain, optional
        Chooses the branch, the values of free parameters and where the base is.
    near_parallel_threshold : float
        rad; neighbours within it get a Hayati row.
    forms : list of RowForm
        One a row (the last is ignored) instead of the choice by the threshold.

    Returns
    -------
    HayatiConversion

    Raises
    ------
    InvalidInput
        The chain has no joints; the nominal chain or forms have another size, or joints of other types; a form asked for
        breaks down at its axes.

    References
    ----------
    Hayati and Mirmirani, "Improving the absolute positioning accuracy of robot manipulators", J. Robotic Systems 2, 1985.
    """
def to_modified_dh(chain: ScrewChain, nominal: ModifiedDhChain | None = None, parallel_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-08, near_parallel_threshold: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> ModifiedDhConversion:
    """
    Denavit-Hartenberg parameters of a screw chain, by common normals.

    Parameters
    ----------
    chain : ScrewChain
    nominal : StandardDhChain or ModifiedDhChain, optional
        Of the convention asked for. Chooses the branch (nearest) and the values of free parameters; without it free
        parameters are zero, alpha is in [0, pi] and theta in (-pi, pi].
    parallel_tolerance : float
        rad, neighbours within it count as exactly parallel.
    near_parallel_threshold : float
        rad, neighbours within it are reported.

    Returns
    -------
    StandardDhConversion or ModifiedDhConversion

    Raises
    ------
    InvalidInput
        The chain has no joints, or the nominal chain has another number or other types of joints.

    References
    ----------
    Denavit and Hartenberg, "A kinematic notation for lower-pair mechanisms based on matrices", J. Appl. Mech. 22, 1955.
    Craig, "Introduction to Robotics: Mechanics and Control", 1986.
    """
@typing.overload
def to_screws(chain: StandardDhChain, reference_configuration: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], base_frame: BaseFrame) -> ScrewChain:
    """
    The screw chain of a DH chain.

    Parameters
    ----------
    chain : StandardDhChain or ModifiedDhChain
    reference_configuration : (n,) array
        rad or m, raw encoder values.
    base_frame : BaseFrame
        ``chain_base``: lines in the DH chain's base frame; ``sensor_at_reference``: in the sensor frame at the reference
        configuration, home identity.

    Raises
    ------
    InvalidInput
        reference_configuration or types do not have one entry per row.
    """
@typing.overload
def to_screws(chain: ModifiedDhChain, reference_configuration: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], base_frame: BaseFrame) -> ScrewChain:
    """
    The screw chain of a DH chain.

    Parameters
    ----------
    chain : StandardDhChain or ModifiedDhChain
    reference_configuration : (n,) array
        rad or m, raw encoder values.
    base_frame : BaseFrame
        ``chain_base``: lines in the DH chain's base frame; ``sensor_at_reference``: in the sensor frame at the reference
        configuration, home identity.

    Raises
    ------
    InvalidInput
        reference_configuration or types do not have one entry per row.
    """
def to_standard_dh(chain: ScrewChain, nominal: StandardDhChain | None = None, parallel_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-08, near_parallel_threshold: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> StandardDhConversion:
    """
    Denavit-Hartenberg parameters of a screw chain, by common normals.

    Parameters
    ----------
    chain : ScrewChain
    nominal : StandardDhChain or ModifiedDhChain, optional
        Of the convention asked for. Chooses the branch (nearest) and the values of free parameters; without it free
        parameters are zero, alpha is in [0, pi] and theta in (-pi, pi].
    parallel_tolerance : float
        rad, neighbours within it count as exactly parallel.
    near_parallel_threshold : float
        rad, neighbours within it are reported.

    Returns
    -------
    StandardDhConversion or ModifiedDhConversion

    Raises
    ------
    InvalidInput
        The chain has no joints, or the nominal chain has another number or other types of joints.

    References
    ----------
    Denavit and Hartenberg, "A kinematic notation for lower-pair mechanisms based on matrices", J. Appl. Mech. 22, 1955.
    Craig, "Introduction to Robotics: Mechanics and Control", 1986.
    """
@typing.overload
def transform(T_a_b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"], line_b: Line) -> Line:
    """
    A line or axis given in b-coordinates, in a-coordinates.

    Parameters
    ----------
    T_a_b : (4, 4) array
        Maps b-coordinates to a.

    Raises
    ------
    InvalidInput
        T_a_b is not a rigid transform.
    """
@typing.overload
def transform(T_a_b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"], axis_b: ScrewAxis) -> ScrewAxis:
    """
    A line or axis given in b-coordinates, in a-coordinates.

    Parameters
    ----------
    T_a_b : (4, 4) array
        Maps b-coordinates to a.

    Raises
    ------
    InvalidInput
        T_a_b is not a rigid transform.
    """
@typing.overload
def transform(T_a_b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 4]"], axis_b: JointAxis) -> JointAxis:
    """
    A line or axis given in b-coordinates, in a-coordinates.

    Parameters
    ----------
    T_a_b : (4, 4) array
        Maps b-coordinates to a.

    Raises
    ------
    InvalidInput
        T_a_b is not a rigid transform.
    """
def use_instruction_set(path: InstructionSet) -> None:
    """
    Choose the vector instructions for the whole process; results stay the same to the last bit.

    Parameters
    ----------
    path : InstructionSet

    Raises
    ------
    InvalidInput
        If the processor does not have them.
    """
def used_tolerance(response: SecondOrderResponse, bands: collections.abc.Sequence[ResponseBand]) -> float:
    """
    The largest part of a band's tolerance that a response uses: at most 1 when it keeps within all.
    """
def welch(x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[n] or [n, k]", "flags.c_contiguous"], sample_rate: typing.SupportsFloat | typing.SupportsIndex, window: typing.Literal['hann', 'boxcar'] = 'hann', nperseg: typing.SupportsInt | typing.SupportsIndex | None = None, noverlap: typing.SupportsInt | typing.SupportsIndex | None = None, detrend: typing.Literal['constant', 'none'] | None = 'constant', scaling: typing.Literal['density', 'spectrum'] = 'density') -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], numpy.typing.NDArray[numpy.float64]]:
    """
    Power spectral density along axis 0 by Welch's method, as ``scipy.signal.welch``.

    Parameters
    ----------
    x : numpy.ndarray, shape (n,) or (n, k)
        Equally spaced samples; C-contiguous float64, never copied.
    sample_rate : float
        Hz.
    window : {'hann', 'boxcar'}
    nperseg : int, optional
        Samples a segment, at most n; by default 256, or n when that is less.
    noverlap : int, optional
        Samples shared by neighbouring segments; by default half a segment.
    detrend : {'constant', 'none'} or None
        Whether each segment's mean is taken off.
    scaling : {'density', 'spectrum'}
        Unit of `x` squared per Hz, or unit of `x` squared.

    Returns
    -------
    frequencies : numpy.ndarray, shape (f,)
        Hz, from 0 to half the sample rate.
    power : numpy.ndarray, shape (f,) or (f, k)

    Raises
    ------
    TypeError
        If `x` is not a C-contiguous float64 array with one or two axes.
    InvalidInput
        If `x` is empty, a segment is longer than `x`, the overlap is not less than a segment, the sample rate is not
        positive, or the name of an option is unknown.

    References
    ----------
    P. D. Welch, The use of the fast Fourier transform for the estimation of power spectra, IEEE Trans. Audio and
    Electroacoustics 15 (1967).
    """
STANDARD_GRAVITY: float = 9.80665
__version__: str = '0.1.0'
max_encoder_step: float = 0.01227184630308513
