"""The calibrated arm placed on the nominal one: frames on the calibrated axes, each nearest its nominal frame.

An accelerometer sees the axes relative to each other and to itself. Where the base stands under the first axis, where
the zero of the first and the last joint is, and how the tip sits on the last joint it does not see: there the nominal
arm is kept, and `kept_nominal` says so.

1. The nominal arm is laid on the calibrated axes at the reference configuration, least squares over a rigid transform
   and the joints' zero offsets (`circlepoint.align_chain`).
2. Each joint's frame is the nominal one turned by the smallest rotation that brings its axis along the calibrated one,
   its origin moved to the nearest point of the calibrated axis.
3. The frames relative to each other, joints turned back to zero, are the placements; the tip keeps its nominal place in
   the last frame; the sensor's place in the tip closes the chain.

Without a nominal arm the base is the sensor frame at the reference configuration.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import circlepoint
from circlepoint._core import InvalidInput
from circlepoint.transforms import inverse, joint_motion, nearest_frame, rigid

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from circlepoint.export.nominal_frames import NominalFrames
    from circlepoint.export.result import CalibratedArm

LARGEST_OFFSET = 0.5
"""rad, m: a joint offset beyond it means that the nominal arm is not this arm."""


@dataclass(frozen=True)
class PlacedArm:
    """The calibrated arm in its base frame.

    ``T_base_sensor(q) = P_1 M_1(q_1) ... P_n M_n(q_n) tip T_tip_sensor``, M_i the motion about or along axis i.

    Attributes
    ----------
    arm : CalibratedArm
    nominal : NominalFrames or None
    alignment : ChainAlignment or None
        Of the nominal arm (source) with the calibrated axes (target, sensor frame); None without a nominal arm.
    T_base_sensor : (4, 4) ndarray
        At the reference configuration.
    chain : ScrewChain
        The calibrated axes in the base frame; home is T_base_sensor.
    placements : tuple of (4, 4) ndarray
        P_i, at q = 0.
    axes : tuple of (3,) ndarray
        Unit, each in its own frame.
    tip_placement, T_tip_sensor : (4, 4) ndarray
        The tip in the last joint's frame (nominal; the identity without nominal), the sensor in the tip.
    """

    arm: CalibratedArm
    nominal: NominalFrames | None
    alignment: circlepoint.ChainAlignment | None
    T_base_sensor: NDArray[np.float64]
    chain: circlepoint.ScrewChain
    placements: tuple[NDArray[np.float64], ...]
    axes: tuple[NDArray[np.float64], ...]
    tip_placement: NDArray[np.float64]
    T_tip_sensor: NDArray[np.float64]

    @property
    def base_name(self) -> str:
        """Name of the base frame."""
        return "sensor_at_reference" if self.nominal is None else self.nominal.base

    @property
    def tip_name(self) -> str:
        """Name of the frame the nominal description ends with."""
        return f"{self.arm.joint_names[-1]}_frame" if self.nominal is None else self.nominal.tip

    @property
    def joint_offsets(self) -> NDArray[np.float64] | None:
        """(n,) rad or m: the nominal arm at q + offset is nearest the real one at q; None without a nominal arm."""
        return None if self.alignment is None else np.asarray(self.alignment.joint_offsets)


def place(arm: CalibratedArm, nominal: NominalFrames | None = None) -> PlacedArm:
    """Place a calibrated arm on its nominal description.

    Parameters
    ----------
    arm : CalibratedArm
    nominal : NominalFrames, optional
        Of the same joints.

    Raises
    ------
    InvalidInput
        The nominal arm has other joints, or is so far from the calibrated axes that it describes another arm.
    """
    if nominal is None:
        frames = [_frame_on(axis.line) for axis in arm.chain.axes]
        axes = tuple(np.array([0.0, 0.0, 1.0]) for _ in frames)
        return _assembled(
            arm, nominal=None, alignment=None, T_base_sensor=np.eye(4), frames=frames, axes=axes, tip=np.eye(4)
        )
    if list(nominal.types) != arm.joint_types:
        raise InvalidInput(
            f"{nominal.source}: has {len(nominal.types)} joints of types {_names(nominal.types)}, the calibrated arm "
            f"{arm.name!r} has {len(arm.joint_types)} of types {_names(arm.joint_types)}; give this arm's description"
        )
    alignment = circlepoint.align_chain(arm.chain, nominal.chain(arm.reference))
    offsets = np.asarray(alignment.joint_offsets)
    if not alignment.converged or np.max(np.abs(offsets)) > LARGEST_OFFSET:
        worst = int(np.argmax(np.abs(offsets)))
        raise InvalidInput(
            f"{nominal.source}: does not describe the calibrated arm {arm.name!r}: laid on the calibrated axes, joint "
            f"{arm.joint_names[worst]!r} would be {offsets[worst]:.3g} off its nominal zero (rad, m; "
            f"{'at most 0.5 is taken for an offset' if alignment.converged else 'no fit was found'}); give this arm's "
            "description, or export without one"
        )
    T_base_sensor = inverse(np.asarray(alignment.T_target_source))
    frames = [
        nearest_frame(
            frame,
            axis,
            circlepoint.transform(T_base_sensor, screw.line),
            keep_origin=screw.type == circlepoint.JointType.prismatic,
        )
        for frame, axis, screw in zip(
            nominal.frames(arm.reference + offsets), nominal.axes, arm.chain.axes, strict=True
        )
    ]
    return _assembled(
        arm,
        nominal=nominal,
        alignment=alignment,
        T_base_sensor=T_base_sensor,
        frames=frames,
        axes=nominal.axes,
        tip=nominal.tip_placement,
    )


def _assembled(
    arm: CalibratedArm,
    *,
    nominal: NominalFrames | None,
    alignment: circlepoint.ChainAlignment | None,
    T_base_sensor: NDArray[np.float64],
    frames: list[NDArray[np.float64]],
    axes: tuple[NDArray[np.float64], ...],
    tip: NDArray[np.float64],
) -> PlacedArm:
    placements = []
    before = np.eye(4)
    for frame, axis, kind, position in zip(frames, axes, arm.joint_types, arm.reference, strict=True):
        placements.append(inverse(before) @ frame @ joint_motion(kind, axis, -float(position)))
        before = frame
    lines = [circlepoint.transform(T_base_sensor, axis) for axis in arm.chain.axes]
    return PlacedArm(
        arm=arm,
        nominal=nominal,
        alignment=alignment,
        T_base_sensor=T_base_sensor,
        chain=circlepoint.ScrewChain(lines, arm.reference, T_base_sensor),
        placements=tuple(placements),
        axes=axes,
        tip_placement=tip,
        T_tip_sensor=inverse(before @ tip) @ T_base_sensor,
    )


def kept_nominal(placed: PlacedArm) -> list[dict[str, Any]]:
    """Return what the calibration cannot see and the export therefore keeps or chooses, one entry each."""
    arm, nominal = placed.arm, placed.nominal
    first, last = arm.joint_names[0], arm.joint_names[-1]
    if nominal is None:
        entries = [
            _kept("base frame", "no nominal arm was given: it is the sensor frame at the reference configuration"),
            _kept(f"zero of {first} and {last}", "the raw encoder value; no nominal arm was given"),
            _kept("tip", f"no nominal arm was given: it is the frame of {last}"),
        ]
    else:
        entries = [
            _kept(
                f"base frame ({nominal.base})",
                f"its place under {first} moves no axis relative to the others: the nominal arm was fitted to all "
                "calibrated axes",
            ),
            _kept(f"zero of {first}", "turning the whole arm about its first axis is a turn of the base"),
            _kept(f"zero of {last}", "no axis lies beyond the last joint"),
            _kept(f"{nominal.tip} relative to {last}", "no axis lies beyond the last joint"),
        ]
    entries += [
        _kept(f"place of the axis of {name}", "a prismatic axis has a direction only")
        for name, kind in zip(arm.joint_names, arm.joint_types, strict=True)
        if kind == circlepoint.JointType.prismatic
    ]
    return entries


def _kept(quantity: str, reason: str) -> dict[str, Any]:
    return {"quantity": quantity, "reason": reason}


def _frame_on(line: circlepoint.Line) -> NDArray[np.float64]:
    z = np.asarray(line.direction)
    return rigid(np.column_stack([circlepoint.tangent_basis(z), z]), np.asarray(line.point))


def _names(types: Iterable[circlepoint.JointType]) -> str:
    return ", ".join(kind.name for kind in types)
