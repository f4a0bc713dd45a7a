"""Writes the type stub of the compiled core to the file given; `make stub` writes the one that is shipped.

The generator neither marks the members of an enumeration nor knows that everything can be compared and that lists hold
something, on which type checkers insist; the few lines concerned are rewritten.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

_REWRITTEN = (
    (r"^__all__: list = ", "__all__: list[str] = "),
    (r"    @classmethod\n    def __new__\(cls, value\):\n        \.\.\.\n", ""),
    (r"def __eq__\(self, arg0: \w+\)", "def __eq__(self, arg0: object)"),
    (r"def __setstate__\(self, arg0: tuple\)", "def __setstate__(self, arg0: tuple[typing.Any, ...])"),
    (r"[ \t]+$", ""),
)


def generated_stub() -> str:
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "pybind11_stubgen", "circlepoint._core", "--exit-code", "-o", folder]
        subprocess.run(command, check=True, capture_output=True, text=True)
        text = (Path(folder) / "circlepoint" / "_core.pyi").read_text(encoding="utf-8")
    for name in re.findall(r"^class (\w+)\(enum\.Enum\):$", text, flags=re.MULTILINE):
        text = re.sub(rf"^    (\w+): typing\.ClassVar\[{name}\]$", r"    \1 = ...", text, flags=re.MULTILINE)
    for pattern, replacement in _REWRITTEN:
        text = re.sub(pattern, replacement, text, flags=re.MULTILINE)
    return text


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(generated_stub(), encoding="utf-8")
