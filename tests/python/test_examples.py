"""The examples run, print what stands beside them, and the README and the how-to pages show the same."""

import re
import runpy
from pathlib import Path

import pytest

from circlepoint.arm import load_arm
from circlepoint.column_map import load_column_map
from circlepoint.sensor_presets import load_sensor

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("[0-9]*.py"))
NUMBER = re.compile(r"-?\d+\.\d+\*?")


def assert_same_words(printed: str, expected: str) -> None:
    """Word by word; numbers may differ by two units of their last digit, as other mathematical libraries round."""
    assert len(printed.split()) == len(expected.split()), printed
    for word, expectation in zip(printed.split(), expected.split(), strict=True):
        if word == expectation:
            continue
        assert NUMBER.fullmatch(word), (word, expectation)
        assert NUMBER.fullmatch(expectation), (word, expectation)
        decimals = len(expectation.rstrip("*").partition(".")[2])
        assert float(word.rstrip("*")) == pytest.approx(float(expectation.rstrip("*")), abs=2.1 * 10.0**-decimals)


def blocks(page: str, language: str) -> list[str]:
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def output_of(example: Path, capsys: pytest.CaptureFixture[str]) -> str:
    runpy.run_path(str(example), run_name="__main__")
    return capsys.readouterr().out


def test_there_are_pairs_of_examples() -> None:
    assert len(EXAMPLES) == 3
    assert all(example.with_suffix(".cpp").is_file() for example in EXAMPLES)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_prints_what_stands_beside_it(example: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert_same_words(output_of(example, capsys), example.with_suffix(".txt").read_text(encoding="utf-8"))


def test_the_comparison_of_outputs_sees_a_wrong_number() -> None:
    with pytest.raises(AssertionError):
        assert_same_words("axis 0.104", "axis 0.101")


def test_the_readme_shows_the_first_example_and_what_it_prints(capsys: pytest.CaptureFixture[str]) -> None:
    snippet = blocks("README.md", "python")[0]
    assert snippet.strip() == EXAMPLES[0].read_text(encoding="utf-8").strip()
    tables = [block for block in blocks("README.md", "") if block.startswith("joint")]
    assert len(tables) == 1
    assert_same_words(output_of(EXAMPLES[0], capsys), tables[0])


def test_the_readme_shows_lines_of_the_first_example_in_cpp() -> None:
    example = [line.strip() for line in EXAMPLES[0].with_suffix(".cpp").read_text(encoding="utf-8").splitlines()]
    (snippet,) = blocks("README.md", "cpp")
    lines = [line.strip() for line in snippet.splitlines() if line.strip()]
    assert lines
    assert [line for line in lines if line not in example] == []


def test_links_between_pages_lead_somewhere() -> None:
    for page in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]:
        links = re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8"))
        assert [link for link in links if not (page.parent / link).exists()] == [], page


def test_the_files_in_the_recording_format_page_can_be_read(tmp_path: Path) -> None:
    pages = {}
    for block in blocks("docs/recording-format.md", "yaml"):
        name = (
            "arm"
            if "joints:" in block
            else "lines"
            if "lines:" in block
            else "sensor"
            if "bias_std:" in block
            else "columns"
        )
        pages[name] = tmp_path / f"{name}.yaml"
        pages[name].write_text(block, encoding="utf-8")
    arm = load_arm(pages["arm"])
    assert list(arm.joint_names) == ["joint1", "joint2"]
    joints = pages["arm"].read_text(encoding="utf-8").partition("dh:")[0]
    pages["arm"].write_text(joints + pages["lines"].read_text(encoding="utf-8"), encoding="utf-8")
    assert load_arm(pages["arm"]).has_nominal
    assert load_sensor(pages["sensor"]).scale_std == 0.003
    six = tmp_path / "six.yaml"
    joints = "\n".join(f"  - {{name: j{index}, type: revolute}}" for index in range(6))
    six.write_text(f"name: six\njoints:\n{joints}\n", encoding="utf-8")
    columns = load_column_map(pages["columns"], load_arm(six))
    header = next(block for block in blocks("docs/recording-format.md", "") if block.startswith("stamp"))
    assert set(columns.names.values()) == set(header.strip().split(","))


def test_names_of_functions_in_the_method_page_exist() -> None:
    public = "\n".join(path.read_text() for path in (ROOT / "cpp" / "include").rglob("*.hpp"))
    text = (ROOT / "docs" / "method.md").read_text(encoding="utf-8")
    names = set(re.findall(r"`([A-Za-z_]+(?:::[a-z_]+)?)`", text))
    assert len(names) > 20
    assert [name for name in names if not all(re.search(rf"\b{part}\b", public) for part in name.split("::"))] == []


def test_the_architecture_page_has_a_row_for_every_header_and_module() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    headers = [path.name.partition(".")[0] for path in (ROOT / "cpp" / "include").rglob("*.hpp*")]
    assert [name for name in headers if f"`{name}`" not in text] == []
    modules = [path.stem for path in (ROOT / "python" / "circlepoint").glob("*.py") if not path.stem.startswith("_")]
    assert [name for name in modules if f"`{name}`" not in text] == []
