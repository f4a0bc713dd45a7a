"""A campaign's statistics against SciPy's, its summary against the schema."""

import itertools
import json
from importlib import resources

import jsonschema
import numpy as np
import pytest
from campaign_support import table_of
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy import stats

from circlepoint.campaign.figure import draw_summary
from circlepoint.campaign.presentation import format_summary
from circlepoint.campaign.statistics import ErrorStatistics, wilson
from circlepoint.cli import main


def gathered(error, std, parts=5):
    statistics = ErrorStatistics()
    for some_error, some_std in zip(np.array_split(error, parts), np.array_split(std, parts), strict=True):
        statistics.add(some_error, some_std)
    return statistics


def test_statistics_of_one_parameter_are_those_of_all_trials_at_once():
    random = np.random.default_rng(1)
    std = random.uniform(1.0, 2.0, (400, 1))
    error = random.normal(0.3, std)
    found = gathered(error, std)
    flat = error.ravel()
    assert found.trials == 400
    assert found.bias().value == pytest.approx(flat.mean())
    assert found.bias().high - found.bias().value == pytest.approx(stats.norm.ppf(0.975) * stats.sem(flat))
    assert found.rmse().value == pytest.approx(np.sqrt(np.mean(flat**2)))
    assert found.predicted() == pytest.approx(np.sqrt(np.mean(std**2)))
    assert found.nees().value == pytest.approx(np.mean((error / std) ** 2))
    for level, share in zip((0.68, 0.95), found.coverage(), strict=True):
        inside = int(np.count_nonzero(np.abs(error / std) <= stats.norm.ppf(0.5 + 0.5 * level)))
        expected = stats.binomtest(inside, 400).proportion_ci(0.95, method="wilson")
        assert share.value == pytest.approx(inside / 400)
        assert share.low == pytest.approx(expected.low)
        assert share.high == pytest.approx(expected.high)


def test_the_interval_of_the_rmse_covers_the_truth_in_95_percent_of_campaigns():
    random = np.random.default_rng(2)
    inside = 0
    for _ in range(200):
        interval = gathered(random.normal(0.0, 2.0, (200, 1)), np.full((200, 1), 2.0)).rmse()
        inside += interval.low <= 2.0 <= interval.high
    assert stats.binomtest(inside, 200, 0.95).pvalue > 1e-3


@pytest.mark.parametrize(("shared", "narrow"), [(0.0, True), (1.0, False)])
def test_the_interval_of_a_groups_coverage_knows_what_its_parameters_share(shared, narrow):
    random = np.random.default_rng(3)
    std = np.ones((300, 8))
    common, own = random.normal(size=(300, 1)), random.normal(size=(300, 8))
    error = np.sqrt(shared) * common + np.sqrt(1.0 - shared) * own
    low, high = (getattr(gathered(error, std).coverage()[0], end) for end in ("low", "high"))
    alone = wilson(0.68, 300)
    together = wilson(0.68, 2400)
    expected = (together if narrow else alone).high - (together if narrow else alone).low
    assert high - low == pytest.approx(expected, rel=0.2)


def test_trials_without_a_figure_are_left_out_and_known_parameters_have_no_interval():
    error = np.array([[1.0, np.nan], [np.nan, np.nan], [3.0, 1.0]])
    std = np.array([[1.0, np.nan], [np.nan, np.nan], [0.0, 1.0]])
    found = gathered(error, std, parts=1)
    assert found.trials == 2
    assert found.rmse().value == pytest.approx(np.sqrt(np.mean([1.0, 5.0])))
    assert found.nees().value == pytest.approx(1.0)
    assert found.coverage()[1].value == pytest.approx(1.0)


def test_nothing_is_not_a_number():
    found = gathered(np.full((4, 2), np.nan), np.full((4, 2), np.nan), parts=2)
    assert found.rmse() is found.bias() is found.nees() is found.predicted() is None
    assert found.coverage() == [None, None]


def test_one_trial_says_nothing_of_how_well_it_is_known():
    interval = gathered(np.array([[2.0]]), np.array([[1.0]]), parts=1).rmse()
    assert (interval.value, interval.low, interval.high) == (2.0, None, None)


@pytest.fixture
def summary(finished):
    return json.loads((finished / "summary.json").read_text())


def test_the_summary_follows_its_schema(summary):
    text = resources.files("circlepoint").joinpath("schema/campaign-summary-1.json").read_text(encoding="utf-8")
    schema = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(summary, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**summary, "seed": -1}, schema)


def test_the_summary_is_that_of_the_tables(summary, finished):
    for cell in summary["cells"]:
        table = table_of(finished, cell["cell"])
        square = np.concatenate([np.square(table[f"{joint}.p1"]) for joint in ("pan", "tilt", "roll")])
        square = np.concatenate([square, *[np.square(table[f"{joint}.p2"]) for joint in ("pan", "tilt", "roll")]])
        assert cell["groups"]["point"]["rmse"]["value"] == pytest.approx(np.sqrt(square.mean()))
        assert cell["end_point"]["rmse"]["value"] == pytest.approx(np.sqrt(np.mean(np.square(table["end_point"]))))
        assert cell["parameters"]["tilt.d1"]["bias"]["value"] == pytest.approx(np.mean(table["tilt.d1"]))
        assert cell["lines"]["nees"]["value"] == pytest.approx(
            np.mean([np.mean(table[f"{joint}.nees"]) for joint in ("pan", "tilt", "roll")])
        )


def test_what_a_method_does_not_estimate_is_absent_in_the_summary(summary):
    assert summary["cells"][1]["method"] == "velocity"
    assert summary["cells"][1]["groups"]["bias"]["rmse"] is None
    assert summary["cells"][0]["groups"]["bias"]["rmse"]["value"] > 0.0


def test_trials_that_fail_are_counted_with_their_reason(change, config, tmp_path, capsys):
    plan = config.parent / "plan.yaml"
    plan.write_text(plan.read_text().replace("joint: all", "joint: roll"))
    change("[joint, velocity]", "joint")
    assert main(["campaign", str(config), "--out", str(tmp_path / "out")]) == 0
    found = json.loads((tmp_path / "out" / "summary.json").read_text())
    cell = found["cells"][0]
    assert (cell["complete"], cell["incomplete"], cell["failed"]) == (0, 6, 0)
    assert cell["end_point"]["rmse"] is None
    assert cell["groups"]["direction"]["trials"] == 6
    assert cell["reasons"][0]["trials"] == 6
    assert cell["reasons"][0]["reason"].startswith("joint 1: ")
    printed = capsys.readouterr().out
    assert printed.startswith(format_summary(found))
    assert "joints without a line in 6 of 6 trials" in printed


def test_reasons_that_differ_in_figures_alone_are_one(change, config, tmp_path):
    change("up: [0.4, -0.3, 0.8]", "up: [0, 0, 1]")
    change("[joint, velocity]", "velocity")
    assert main(["campaign", str(config), "--out", str(tmp_path / "out")]) == 0
    told = table_of(tmp_path / "out", 0)["reason"].to_pylist()
    assert len(set(told)) == 6
    cell = json.loads((tmp_path / "out" / "summary.json").read_text())["cells"][0]
    assert cell["reasons"] == [{"reason": told[0], "trials": 6}]


def scaled(summary, factors):
    """The summary with the lines' and the end-point's errors of each cell so many times as large."""
    other = json.loads(json.dumps(summary))
    for cell, factor in zip(other["cells"], factors, strict=True):
        for entry in (cell["end_point"], cell["groups"]["direction"], cell["groups"]["point"]):
            entry["predicted"] *= factor
            entry["rmse"] = {end: value and factor * value for end, value in entry["rmse"].items()}
    return other


def test_errors_of_many_sizes_are_drawn_on_logarithmic_axes_whose_labels_stand_apart(summary):
    plain, wide = draw_summary(summary), draw_summary(scaled(summary, [1.0, 1e2, 1e5, 1e9]))
    assert [panel.get_xscale() for panel in wide.axes[:3]] == ["log"] * 3
    assert plain.axes[1].get_xscale() == "linear"
    for figure in (plain, wide):
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        for panel in figure.axes:
            texts = [label for label in panel.get_xticklabels(which="both") if label.get_text() and label.get_visible()]
            low, high = panel.get_xlim()
            boxes = [label.get_window_extent() for label in texts if low <= label.get_position()[0] <= high]
            assert len(boxes) >= 2
            assert all(one.x1 < other.x0 for one, other in itertools.pairwise(sorted(boxes, key=lambda box: box.x0)))


def test_cells_are_drawn_under_their_whole_names(summary):
    name = "a small arm with a long name, on a slope, standing where it was delivered"
    for index, cell in enumerate(summary["cells"]):
        cell["arm"] = f"{name} {index}"
    figure = draw_summary(summary)
    FigureCanvasAgg(figure).draw()
    labels = figure.axes[0].get_yticklabels()
    assert [label.get_text() for label in labels] == [
        f"{cell['arm']}, {cell['noise']}, {cell['method']}" for cell in summary["cells"]
    ]
    assert min(label.get_window_extent().x0 for label in labels) >= 0.0


def test_figures_beyond_reason_stay_short_in_the_table(summary):
    printed = format_summary(scaled(summary, [1.0, 1.0, 1.0, 1e18]))
    assert "e+" in printed
    assert max(map(len, printed.splitlines())) < 220
