"""The written page: whole, self-contained, well-formed, and true to what it was given."""

from __future__ import annotations

import base64
import json
import re
import shutil
from html.parser import HTMLParser

import numpy as np
import pytest

from circlepoint.report import write_report

VOID = {"meta", "img", "br", "hr", "input", "link"}
SCRIPTS = {"script", "style"}


class Page(HTMLParser):
    """Reads a page strictly: every element is closed, in order; attributes and visible text are kept."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.attributes, self.texts, self.tags = [], [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += [(tag, name, value) for name, value in attrs]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += [(tag, name, value) for name, value in attrs]

    def handle_endtag(self, tag):
        assert self.open, f"</{tag}> closes nothing"
        assert self.open.pop() == tag

    def handle_data(self, data):
        if not SCRIPTS & set(self.open):
            self.texts.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.texts).split())


def written(directory, *arguments):
    write_report(directory, *arguments)
    return (directory / "report.html").read_text(encoding="utf-8")


@pytest.fixture
def html(whole_report):
    return whole_report[2]


def test_page_refers_to_nothing_outside_itself(html):
    assert not re.search(r"https?:|//[a-z]+\.|@import|file:", html)
    page = Page(html)
    assert "link" not in page.tags
    assert "iframe" not in page.tags
    for tag, name, value in page.attributes:
        if name in {"src", "href", "xlink:href", "data", "poster", "srcset"}:
            assert value.startswith(("data:", "#")), (tag, name, value)
    assert all(target.startswith("#") for target in re.findall(r"url\(([^)]+)\)", html))


def test_every_reference_within_the_page_leads_somewhere_and_ids_are_unique(html):
    page = Page(html)
    identifiers = [value for _, name, value in page.attributes if name == "id"]
    assert len(identifiers) == len(set(identifiers))
    targets = {value[1:] for _, name, value in page.attributes if name == "href"}
    targets |= set(re.findall(r"url\(#([^)]+)\)", html))
    assert targets <= set(identifiers)


def test_page_of_seven_joints_stays_small(html):
    assert len(html.encode()) < 3_000_000


def test_page_shows_every_joint_with_its_test(html, calibration):
    page = Page(html)
    for joint in calibration.document["joints"]:
        assert page.text.count(joint["name"]) >= 4
    assert "Whole-arm estimate" in page.text
    assert "free" in page.text
    assert "\N{MINUS SIGN}353.68" in page.text
    assert page.tags.count("svg") == 1 + 1 + len(calibration.fits)


def test_truth_columns_are_there_only_with_a_truth(html, brief_report):
    assert "true error" in Page(html).text
    assert "true " not in Page((brief_report / "report.html").read_text(encoding="utf-8")).text


def test_names_are_shown_and_never_run(tmp_path, named_calibration):
    names = ["<script>alert(1)</script>", "a&b", '"quoted"', "$x_1$", "</script><b>", "über", "joint7"]
    calibration = named_calibration("<b>x</b>", names)
    calibration.fits = calibration.fits[:5]
    calibration.document["findings"] = [{"level": "warning", "text": "<img src=x onerror=alert(2)>"}]
    html = written(tmp_path, calibration)
    page = Page(html)
    assert "<b>x</b>" not in html
    assert "<b>x</b>" in page.text
    assert "alert(1)" not in html.replace("&lt;script&gt;alert(1)&lt;/script&gt;", "")
    assert page.tags.count("script") == 2
    assert page.tags.count("img") == 1
    for name in names:
        assert " ".join(name.split()) in page.text


def test_missing_joint_is_named_with_its_reason_and_a_test_to_record(tmp_path, incomplete_calibration):
    page = Page(written(tmp_path, incomplete_calibration))
    assert "incomplete" in page.text
    assert "6 of 7 joint axes are estimated; joint5 is missing" in page.text
    assert "joint5 was never moved by itself." in page.text
    assert "joint5: move only this joint" in page.text
    assert "There are no parameters yet" in page.text


def test_findings_and_nearly_parallel_neighbours_are_said(tmp_path, brief_calibration):
    brief_calibration.document["findings"] = [
        {"level": "warning", "text": "The sensor clipped at 12.3 s."},
        {"code": "gap", "message": "0.4 s are missing after 7.1 s.", "joint": None},
        {"level": "next", "text": "Turn joint2 with the arm stretched out."},
    ]
    brief_calibration.document["dh"]["near_parallel"] = [["joint2", "joint3"], ["joint3", "joint4"]]
    text = Page(written(tmp_path, brief_calibration)).text
    assert "Warning The sensor clipped at 12.3 s." in text
    assert "Note 0.4 s are missing after 7.1 s." in text
    assert "Next Turn joint2 with the arm stretched out." in text
    assert "Nearly parallel neighbours: joint2 and joint3; joint3 and joint4." in text


def test_residuals_on_data_not_used_stand_beside_those_on_data_used(tmp_path, brief_calibration):
    def entry(name, residual, held_out):
        return {
            "name": name,
            "samples": 321,
            "residual_rms": residual,
            "normalised_rms": 0.99,
            "held_out_rms": held_out,
            "held_out_normalised_rms": None if held_out is None else 1.01,
        }

    joint = brief_calibration.document["joints"][0]["name"]
    brief_calibration.document["hold_out"] = [entry(joint, 4.77e-3, 4.81e-3), entry("several joints", 0.0123, None)]
    text = Page(written(tmp_path, brief_calibration)).text
    table = text[text.index("estimates that did not see") :]
    assert table.index(joint) < table.index("4.77") < table.index("4.81") < table.index("several joints")


def test_nothing_estimated_still_makes_a_page(tmp_path, calibration):
    for joint in calibration.document["joints"]:
        for key in ("direction_sensor", "point_sensor", "direction_std", "point_std", "covariance"):
            joint[key] = None
    calibration.document.update(
        complete=False, dh=None, end_point=None, sensor=None, gravity_sensor=None, fit=None, identifiability=None
    )
    calibration.document["findings"] = []
    calibration.fits = []
    calibration.segmentation.tests = []
    page = Page(written(tmp_path, calibration))
    assert "None of the 7 joint axes could be estimated" in page.text
    assert not (tmp_path / "figures" / "axes.png").exists()


def test_scene_holds_the_lines_in_millimetres(html, calibration):
    data = re.search(r'<script type="application/json" id="scene">(.*?)</script>', html)[1]
    scene = json.loads(data)
    for axis, joint in zip(scene["axes"], calibration.document["joints"], strict=True):
        assert axis["name"] == joint["name"]
        assert np.allclose(axis["nearest"], 1e3 * np.array(joint["point_sensor"]), atol=1e-3)
        assert np.allclose(axis["direction"], joint["direction_sensor"], atol=1e-6)
    view = np.array(scene["view"])
    assert np.allclose(view @ view.T, np.eye(3), atol=1e-5)
    assert np.isclose(np.linalg.det(view), 1.0, atol=1e-5)
    assert view[1] @ scene["up"] > 0.8


def test_printed_picture_is_the_written_one(whole_report, html):
    picture = re.search(r'src="data:image/png;base64,([^"]+)"', html)[1]
    assert base64.b64decode(picture) == (whole_report[1] / "figures" / "axes.png").read_bytes()


def contents(directory):
    return {path.relative_to(directory): path.read_bytes() for path in directory.rglob("*.*")}


def test_the_same_calibration_gives_the_same_bytes_whatever_the_users_settings_of_matplotlib(
    tmp_path, brief_report, brief_calibration
):
    import matplotlib as mpl

    with mpl.rc_context({"font.size": 31, "lines.linewidth": 9, "text.usetex": False, "axes.facecolor": "red"}):
        write_report(tmp_path, brief_calibration)
        assert mpl.rcParams["font.size"] == 31
    first, second = contents(brief_report), contents(tmp_path)
    assert len(first) == 3 + 1 + 1
    assert first.keys() == second.keys()
    for file, content in first.items():
        assert second[file] == content, file


def test_a_later_report_leaves_no_figure_of_an_earlier_one(tmp_path, brief_report, incomplete_calibration):
    shutil.copytree(brief_report, tmp_path, dirs_exist_ok=True)
    (tmp_path / "figures" / "mine.svg").write_text("kept")
    write_report(tmp_path, incomplete_calibration)
    names = {path.name for path in (tmp_path / "figures").iterdir()}
    assert names == {"axes.png", "axes.svg", "overview.svg", "mine.svg", "test_6.svg", "test_7.svg"}


def test_a_report_that_fails_leaves_the_earlier_one_whole(tmp_path, brief_report, brief_calibration):
    shutil.copytree(brief_report, tmp_path, dirs_exist_ok=True)
    brief_calibration.document["joints"][0]["direction_sensor"] = [1.0, 0.0]
    with pytest.raises(ValueError, match=r"shape|dimension|size"):
        write_report(tmp_path, brief_calibration)
    assert contents(tmp_path) == contents(brief_report)
    assert not list(tmp_path.rglob(".*"))


def test_a_gap_in_the_log_is_not_bridged(tmp_path, brief_calibration):
    from circlepoint.report.series import broken_line

    log = brief_calibration.recording
    log.time = log.time + np.where(np.arange(len(log.time)) >= 5000, 3.0, 0.0)
    time, values = broken_line(log.time, log.joint_positions[:, 0], log.sample_rate, 200)
    inside = (time > log.time[4999]) & (time < log.time[5000])
    assert not inside.any()
    assert np.isnan(values[np.searchsorted(time, log.time[5000]) - 1])
    assert "joint1" in written(tmp_path, brief_calibration)


def test_decimation_keeps_a_single_outlier():
    from circlepoint.report.series import decimate

    values = np.zeros(100_000)
    values[61_234] = 5.0
    time, kept = decimate(np.arange(100_000) / 1e3, values, 300)
    assert kept.max() == 5.0
    assert time[kept.argmax()] == 61.234
    assert len(time) <= 2 * 300 + 2


@pytest.mark.parametrize("part", ["dynamic", "static"])
def test_a_test_without_one_of_its_halves_is_drawn(tmp_path, brief_calibration, part):
    fit = brief_calibration.fits[0]
    names = (
        ("time", "position", "measured", "modelled")
        if part == "dynamic"
        else ("dwell_positions", "dwell_measured", "dwell_modelled")
    )
    for name in names:
        setattr(fit, name, getattr(fit, name)[:0])
    page = Page(written(tmp_path, brief_calibration))
    assert page.tags.count("svg") == 3
