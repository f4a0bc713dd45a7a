"""The calibrated arm in the forms controllers and programs take; one module a form.

Every form has the forward kinematics of the calibrated product of exponentials. What the calibration could not see
keeps its nominal value and is listed under ``kept_nominal``.
"""

from circlepoint.export.form import Export
from circlepoint.export.result import CalibratedArm, calibrated_arm, load_result
from circlepoint.export.urdf import write_calibrated_urdf
from circlepoint.export.write import FORMS, export_result, write_description, write_export

__all__ = [
    "FORMS",
    "CalibratedArm",
    "Export",
    "calibrated_arm",
    "export_result",
    "load_result",
    "write_calibrated_urdf",
    "write_description",
    "write_export",
]
