"""What a calibration found, for people: tables for the terminal, figures, and one page that explains itself.

Nothing here computes an estimate; it shows the ones it is given.
"""

from circlepoint.report.text import format_dh_table, format_joint_table
from circlepoint.report.write import write_report

__all__ = ["format_dh_table", "format_joint_table", "write_report"]
