"""YAML documents read strictly: every field is asked for by name and type, and what nobody asked for is an error."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NoReturn

import yaml

from circlepoint._core import InvalidInput

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class Fields:
    """A mapping of a document, read field by field.

    Parameters
    ----------
    document
        What the file holds; anything but a mapping is refused.
    source
        The file, for messages.
    where
        The path of this mapping inside the document, such as ``tests[2].static``; empty at the top.
    """

    def __init__(self, document: object, source: str, where: str = "") -> None:
        self.source = source
        self.where = where
        if not isinstance(document, dict):
            self.fail("", document, "give a mapping of field names to values")
        self._values: dict[object, object] = document
        self._asked: set[str] = set()

    def fail(self, key: str, value: object, remedy: str) -> NoReturn:
        """Raise InvalidInput that names file, field, value and remedy."""
        field = ".".join(part for part in (self.where, key) if part) or "the document"
        raise InvalidInput(f"{self.source}: {field} is {value!r}; {remedy}")

    def has(self, key: str) -> bool:
        """Whether the field is there."""
        return key in self._values

    def value(self, key: str, remedy: str) -> object:
        """Return the field's value as it is; a missing one is an error with the remedy."""
        self._asked.add(key)
        if key not in self._values:
            field = ".".join(part for part in (self.where, key) if part)
            raise InvalidInput(f"{self.source}: {field} is missing; {remedy}")
        return self._values[key]

    def number(
        self, key: str, *, default: float | None = None, at_least: float = -math.inf, above: float = -math.inf
    ) -> float:
        """Return a finite number within its bounds."""
        self._asked.add(key)
        if default is not None and not self.has(key):
            return default
        remedy = "give a finite number"
        if above > -math.inf:
            remedy += f" above {above:g}"
        elif at_least > -math.inf:
            remedy += f" of at least {at_least:g}"
        value = self.value(key, remedy)
        return self.checked_number(key, value, remedy, at_least=at_least, above=above)

    def checked_number(
        self, key: str, value: object, remedy: str, *, at_least: float = -math.inf, above: float = -math.inf
    ) -> float:
        """Return the value as a float when it is a finite number within its bounds."""
        if isinstance(value, str) and _reads_as_number(value):
            self.fail(key, value, f"{remedy} (YAML reads this as text: write 1.0e-3, not 1e-3, and no quotes)")
        if isinstance(value, bool) or not isinstance(value, int | float):
            self.fail(key, value, remedy)
        number = float(value)
        if not math.isfinite(number) or number < at_least or number <= above:
            self.fail(key, value, remedy)
        return number

    def integer(self, key: str, *, default: int | None = None, at_least: int) -> int:
        """Return a whole number of at least a bound."""
        self._asked.add(key)
        if default is not None and not self.has(key):
            return default
        remedy = f"give a whole number of at least {at_least}"
        value = self.value(key, remedy)
        if isinstance(value, bool) or not isinstance(value, int) or value < at_least:
            self.fail(key, value, remedy)
        return value

    def text(self, key: str, remedy: str, *, default: str | None = None) -> str:
        """Return a text that is not empty."""
        self._asked.add(key)
        if default is not None and not self.has(key):
            return default
        value = self.value(key, remedy)
        if not isinstance(value, str) or not value:
            self.fail(key, value, remedy)
        return value

    def mapping(self, key: str, remedy: str) -> Fields:
        """Return a nested mapping."""
        return Fields(self.value(key, remedy), self.source, ".".join(part for part in (self.where, key) if part))

    def mappings(self, key: str, remedy: str) -> Iterator[Fields]:
        """Return a list of mappings, one after the other."""
        value = self.value(key, remedy)
        if not isinstance(value, list) or not value:
            self.fail(key, value, remedy)
        for index, item in enumerate(value):
            yield Fields(item, self.source, f"{key}[{index}]")

    def done(self) -> None:
        """Refuse fields nobody asked for."""
        unknown = [key for key in self._values if key not in self._asked]
        if unknown:
            known = ", ".join(sorted(self._asked))
            self.fail(str(unknown[0]), self._values[unknown[0]], f"no such field here; the fields are {known}")


def read_document(path: Path) -> Fields:
    """Read the mapping a YAML file holds.

    Raises
    ------
    InvalidInput
        When the file cannot be read, is not YAML, or holds no mapping.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InvalidInput(f"{path}: cannot be read ({error}); give a YAML file in UTF-8") from error
    try:
        document = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise InvalidInput(f"{path}: not YAML ({' '.join(str(error).split())}); correct that line") from error
    return Fields(document, str(path))


def _reads_as_number(value: str) -> bool:
    try:
        float(value)
    except ValueError:
        return False
    return True
