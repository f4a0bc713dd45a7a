"""YAML files read strictly: every complaint names the file, the line, the field and its value."""

import math
import re
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import yaml

from circlepoint._core import InvalidInput

# YAML 1.1 reads 1e-3 (no point) and 1.0e3 (no sign) as text; people write them all the same.
_EXPONENTIAL = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+")

Choice = TypeVar("Choice")


@dataclass(frozen=True)
class YamlFile:
    """The content of a YAML file whose top level is a mapping, with the line of each field."""

    path: Path
    data: dict[Any, Any]
    lines: dict[tuple[Hashable, ...], int] = field(repr=False)

    def error(self, where: tuple[Hashable, ...], message: str) -> InvalidInput:
        """Return an InvalidInput about the field at `where` (keys and list indices from the top)."""
        known = where
        while known and known not in self.lines:
            known = known[:-1]
        line = f", line {self.lines[known]}" if known in self.lines else ""
        name = field_name(where)
        return InvalidInput(f"{self.path}{line}: {name + ': ' if name else ''}{message}")

    def only_keys(self, where: tuple[Hashable, ...], mapping: Any, allowed: Iterable[str]) -> dict[str, Any]:
        """Return `mapping` itself, when it is one and has no other key than the allowed ones."""
        allowed = list(allowed)
        if not isinstance(mapping, dict):
            raise self.error(where, f"is {describe(mapping)}, must be a mapping with the keys {', '.join(allowed)}")
        for key in mapping:
            if key not in allowed:
                raise self.error((*where, key), f"unknown key; the keys known here are {', '.join(allowed)}")
        return mapping

    def number(self, where: tuple[Hashable, ...], value: Any) -> float:
        """`value` as a finite float."""
        if isinstance(value, str) and _EXPONENTIAL.fullmatch(value.strip()):
            value = float(value)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self.error(where, f"is {describe(value)}, must be a number{_as_number(value)}")
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise self.error(where, f"is {describe(value)}, must be a finite number")
        return number

    def text(self, where: tuple[Hashable, ...], value: Any) -> str:
        """`value` as a non-empty string."""
        if not isinstance(value, str) or not value.strip():
            raise self.error(where, f"is {describe(value)}, must be a non-empty text")
        return value


@dataclass(frozen=True)
class Fields:
    """A mapping in a YAML file, read field by field; the fields it may have are known from the start."""

    file: YamlFile
    where: tuple[Hashable, ...]
    values: dict[str, Any] = field(repr=False)

    @classmethod
    def of(cls, file: YamlFile, where: tuple[Hashable, ...], mapping: Any, allowed: Iterable[str]) -> "Fields":
        """Return the fields of `mapping`, which stands at `where`; refuse any that is not allowed."""
        return cls(file, where, file.only_keys(where, mapping, allowed))

    def __contains__(self, key: str) -> bool:
        """Whether the field is there."""
        return key in self.values

    def fail(self, key: str, message: str) -> NoReturn:
        """Raise InvalidInput about a field."""
        raise self.file.error((*self.where, key), message)

    def value(self, key: str, need: str) -> Any:
        """Return the field's value as it is; when it is missing, the error says that `need` is needed."""
        if key not in self.values:
            self.fail(key, f"is missing; {need} is needed")
        return self.values[key]

    def given(self, key: str) -> bool:
        """Whether the field is there and not left empty."""
        return self.values.get(key) is not None

    def number(
        self,
        key: str,
        *,
        default: float | None = None,
        at_least: float = -math.inf,
        above: float = -math.inf,
        need: str | None = None,
    ) -> float:
        """Return a finite number within its bounds."""
        if default is not None and key not in self:
            return default
        value = self.value(key, need or _finite(at_least, above))
        return self.checked((key,), value, at_least=at_least, above=above)

    def checked(
        self, place: tuple[Hashable, ...], value: Any, *, at_least: float = -math.inf, above: float = -math.inf
    ) -> float:
        """Return a value of this mapping, at `place` within it, as a finite number within its bounds."""
        number = self.file.number((*self.where, *place), value)
        if number < at_least or number <= above:
            message = f"is {describe(value)}, must be {_finite(at_least, above)}"
            raise self.file.error((*self.where, *place), message)
        return number

    def choice(self, key: str, known: Mapping[str, Choice]) -> Choice:
        """Return what the field's value stands for."""
        need = " or ".join(known)
        value = self.value(key, need)
        if not isinstance(value, str) or value not in known:
            self.fail(key, f"is {describe(value)}, must be {need}")
        return known[value]

    def integer(self, key: str, *, default: int | None = None, at_least: int) -> int:
        """Return a whole number of at least a bound."""
        if default is not None and key not in self:
            return default
        need = f"a whole number of at least {at_least}"
        value = self.value(key, need)
        if isinstance(value, bool) or not isinstance(value, int) or value < at_least:
            self.fail(key, f"is {describe(value)}, must be {need}{_as_whole(value)}")
        return value

    def text(self, key: str, need: str, *, default: str | None = None) -> str:
        """Return a text that is not empty."""
        if default is not None and key not in self:
            return default
        return self.file.text((*self.where, key), self.value(key, need))

    def fields(self, key: str, allowed: Iterable[str]) -> "Fields":
        """Return a nested mapping."""
        allowed = list(allowed)
        value = self.value(key, f"a mapping with the keys {', '.join(allowed)}")
        return Fields.of(self.file, (*self.where, key), value, allowed)

    def each(self, key: str, need: str, allowed: Iterable[str]) -> Iterator["Fields"]:
        """Return the mappings of a list, one after the other."""
        allowed = list(allowed)
        value = self.value(key, need)
        if not isinstance(value, list) or not value:
            self.fail(key, f"is {describe(value)}, must be {need}")
        for index, item in enumerate(value):
            yield Fields.of(self.file, (*self.where, key, index), item, allowed)


def load_fields(path: str | Path, allowed: Iterable[str]) -> Fields:
    """Read the fields of a YAML file; raises as `load_yaml`, and for a field that is not allowed."""
    file = load_yaml(path)
    return Fields.of(file, (), file.data, allowed)


def load_yaml(path: str | Path) -> YamlFile:
    """Read a YAML file whose top level is a mapping.

    Parameters
    ----------
    path : str or Path
        The file.

    Returns
    -------
    YamlFile
        Content and line numbers.

    Raises
    ------
    InvalidInput
        When the file cannot be read, is not YAML, repeats a key, or is not a mapping.
    """
    path = Path(path)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise InvalidInput(
            f"{path}: cannot be read ({error.strerror or error}); check the path and its permissions"
        ) from error
    except UnicodeDecodeError as error:
        raise InvalidInput(
            f"{path}: is not a text file (byte {error.start} is not UTF-8); a YAML file is needed"
        ) from error
    lines: dict[tuple[Hashable, ...], int] = {}
    try:
        loader = yaml.SafeLoader(text)
        try:
            root = loader.get_single_node()
            if root is not None:
                _collect_lines(path, root, (), lines)
            data = None if root is None else loader.construct_document(root)
        finally:
            loader.dispose()
    except InvalidInput:
        raise
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f", line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        raise InvalidInput(f"{path}{where}: is not valid YAML: {error.problem or error}") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise InvalidInput(f"{path}: is not valid YAML: {error}") from error
    if data is None:
        raise InvalidInput(f"{path}: is empty; a YAML mapping is needed")
    if not isinstance(data, dict):
        raise InvalidInput(f"{path}: its top level is {describe(data)}, must be a mapping (key: value lines)")
    return YamlFile(path, data, lines)


def field_name(where: tuple[Hashable, ...]) -> str:
    """`("dh", "rows", 2, "alpha")` as ``dh.rows[2].alpha`` (list indices from 0)."""
    name = ""
    for key in where:
        name += f"[{key}]" if isinstance(key, int) and name else f"{'.' if name else ''}{key}"
    return name


def describe(value: Any) -> str:
    """Return a value as a message shows it: short, with its kind when that is not obvious."""
    if value is None:
        return "empty"
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    shown = repr(value)
    return shown if len(shown) <= 60 else shown[:57] + "..."


def _finite(at_least: float, above: float) -> str:
    if above > -math.inf:
        return f"a finite number above {above:g}"
    return f"a finite number of at least {at_least:g}" if at_least > -math.inf else "a finite number"


def _as_whole(value: Any) -> str:
    """Return how to write a number that is whole but not written so: 1e3, 10.0."""
    if isinstance(value, str) and _EXPONENTIAL.fullmatch(value.strip()):
        value = float(value)
    whole = isinstance(value, float) and value.is_integer() and value > 0.0
    return f": write {int(value)}" if whole else ""


def _as_number(value: Any) -> str:
    expression = (
        re.fullmatch(r"\s*([-+]?)\s*(\d*\.?\d*)\s*\*?\s*pi\s*(?:/\s*(\d+\.?\d*))?\s*", value)
        if isinstance(value, str)
        else None
    )
    if not expression:
        return ""
    sign, factor, divisor = expression.groups()
    number = float(factor or 1.0) * math.pi / float(divisor or 1.0)
    return f": write {'-' if sign == '-' else ''}{number!r}"


def _collect_lines(
    path: Path, node: yaml.Node, where: tuple[Hashable, ...], lines: dict[tuple[Hashable, ...], int]
) -> None:
    lines.setdefault(where, node.start_mark.line + 1)
    if isinstance(node, yaml.MappingNode):
        for key_node, value_node in node.value:
            key = key_node.value if isinstance(key_node, yaml.ScalarNode) else str(key_node.start_mark.line)
            child = (*where, key)
            if child in lines:
                line = key_node.start_mark.line + 1
                raise InvalidInput(
                    f"{path}, line {line}: {field_name(child)}: was given on line {lines[child]} already; keep one"
                )
            lines[child] = key_node.start_mark.line + 1
            _collect_lines(path, value_node, child, lines)
    elif isinstance(node, yaml.SequenceNode):
        for index, item in enumerate(node.value):
            _collect_lines(path, item, (*where, index), lines)
