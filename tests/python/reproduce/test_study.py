"""The study as the command writes it: every number, its page, its schema, its figures."""

import importlib
import json
import re
from importlib import resources
from pathlib import Path

import jsonschema
import pytest

from circlepoint.cli import main
from circlepoint.reproduce.presentation import FIGURES
from circlepoint.reproduce.registry import STATED

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("reproduction") / "out"
    assert main(["reproduce", "--out", str(out), "--trials", "10", "--jobs", "2"]) == 0
    return out


@pytest.fixture(scope="module")
def document(folder):
    return json.loads((folder / "reproduction.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def statements(document):
    return {statement["id"]: statement for statement in document["statements"]}


def test_the_document_is_what_its_schema_says(document):
    text = resources.files("circlepoint").joinpath("schema/reproduction-1.json").read_text(encoding="utf-8")
    schema = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(document, schema)
    assert document["trials"] == 10


def test_every_statement_of_the_paper_has_ours_and_every_difference_a_reason(statements):
    assert list(statements) == [stated.id for stated in STATED]
    for statement in statements.values():
        assert statement["paper_method"] is not None, statement["id"]
        if statement["agreement"] in {"smaller", "larger"}:
            assert len(statement["remark"]) > 60, statement["id"]


def test_the_papers_numbers_come_out_near_the_papers(statements):
    factors = {
        "fundamental": 1.02,
        "span": 1.001,
        "rate": 1.001,
        "bound_angle": 1.01,
        "bound_end_point": 1.01,
        "axis_max": 3.0,
        "axis_std": 2.0,
        "centre_position_max": 3.0,
        "centre_position_std": 3.0,
        "centre_velocity_max": 3.0,
        "centre_velocity_std": 3.0,
        "averaged_noise": 2.0,
        "repeat_std": 4.0,
        "end_point": 3.0,
    }
    for name, factor in factors.items():
        statement = statements[name]
        assert 1.0 / factor < statement["paper_method"]["median"] / statement["paper"] < factor, name


def test_the_best_method_is_better_than_the_papers_and_the_bound_holds(statements):
    for name in ("axis_std", "centre_position_std", "centre_velocity_std", "centre_measured", "end_point"):
        statement = statements[name]
        assert statement["best_method"]["high"] < statement["paper_method"]["median"], name
    bound = statements["bound_angle"]
    assert bound["best_method"]["median"] < bound["paper_method"]["median"]


def test_the_spectrum_suggests_a_bandwidth_above_the_fundamental_and_within_the_papers(statements):
    assert 1.0 < statements["bandwidth"]["paper_method"]["median"] <= 10.0


def test_every_figure_is_there_and_the_page_needs_nothing_from_outside(folder):
    names = {path.stem for path in (folder / "figures").glob("*.svg")}
    assert names == {path.stem for path in (folder / "figures").glob("*.png")} == set(FIGURES)
    assert {f"figure{i}" for i in (1, 2, 6, 7, 8, 9, 10)} <= names
    page = (folder / "reproduction.html").read_text(encoding="utf-8")
    assert re.findall(r"(?:src|href)=\"(?!#|data:)[^\"]*\"", page) == []
    assert "@import" not in page
    assert page.count("<svg") == len(FIGURES)


def test_markdown_and_page_state_every_number(folder):
    markdown = (folder / "reproduction.md").read_text(encoding="utf-8")
    page = (folder / "reproduction.html").read_text(encoding="utf-8")
    for stated in STATED:
        assert stated.quantity in markdown
        assert stated.printed in markdown
        assert stated.printed in page
    for name in FIGURES:
        assert f"(figures/{name}.svg)" in markdown
    for block in re.findall(r"(?:^\|.*\n)+", markdown, flags=re.MULTILINE):
        assert len({len(re.findall(r"(?<!\\)\|", line)) for line in block.splitlines()}) == 1, block


def test_bad_arguments_are_refused_before_anything_runs(tmp_path, capsys, monkeypatch):
    from circlepoint.reproduce import study

    monkeypatch.setattr(study, "reproduce", lambda *_: pytest.fail("a study ran on bad arguments"))
    assert main(["reproduce", "--out", str(tmp_path), "--trials", "9"]) == 2
    assert "9 is less than 10" in capsys.readouterr().err
    assert main(["reproduce", "--out", str(tmp_path), "--jobs", "none"]) == 2
    (tmp_path / "file").write_text("")
    assert main(["reproduce", "--out", str(tmp_path / "file" / "x")]) == 2
    assert "is a file" in capsys.readouterr().err


def test_every_function_the_method_page_names_for_the_paper_exists():
    text = (ROOT / "docs" / "method.md").read_text(encoding="utf-8")
    names = re.findall(r"`(circlepoint\.[a-z_.0-9]+)`", text)
    assert len(names) > 12
    for name in names:
        module, _, attribute = name.rpartition(".")
        assert callable(getattr(importlib.import_module(module), attribute)), name


def test_the_method_page_has_every_equation_table_and_figure_of_the_paper():
    text = (ROOT / "docs" / "method.md").read_text(encoding="utf-8")
    table = text[text.index("### The paper's equations") : text.index("### Errata")]
    cells = "\n".join(line.split("|")[1] for line in table.splitlines() if line.startswith("|"))
    for equation in range(1, 12):
        assert f"({equation})" in cells, equation
    for figure in range(1, 11):
        assert f"Figure {figure}" in cells, figure
    assert "Table 1" in cells
