"""Bad input: each file ends the command with status 2 and says where, what and what to do; nothing is written."""

import pytest

from circlepoint.cli import main

ROWS = 40


def rows(change=lambda _, row: row, count=ROWS):
    """A plain recording of a two-joint arm at 100 Hz, each row changed on its way into the file."""
    header = "t,q1,q2,ax,ay,az"
    lines = [header]
    for index in range(count):
        row = [f"{0.01 * index:.2f}", f"{0.001 * index:.4f}", "0.5", f"{0.01 * (index % 3):.3f}", "0.02", "9.81"]
        lines.append(",".join(change(index, row)))
    return "\n".join(lines) + "\n"


def cell(line, column, value):
    """Replace one cell; lines are counted as an editor does, the header being line 1."""
    return rows(lambda index, row: [*row[:column], value, *row[column + 1 :]] if index == line - 2 else row)


def each(column, change):
    return rows(lambda _, row: [*row[:column], change(row[column]), *row[column + 1 :]])


def scaled(columns, factor):
    return rows(lambda _, row: [f"{float(x) * factor:.9g}" if i in columns else x for i, x in enumerate(row)])


BAD_LOGS = {
    "missing sensor column": (rows().replace(",az", ",bz"), ["az", "missing", "bz", "--columns"]),
    "missing time": (rows().replace("t,q1", "clock,q1"), ["time column", "missing", "clock"]),
    "missing joint": (rows().replace("q2", "elbow"), ["2 joints", "1 joint column"]),
    "more joints than the arm": (each(2, "{},0.1".format).replace("q2", "q2,q3"), ["3 joint columns", "2 joints"]),
    "no sensor at all": (rows().replace("ax,ay,az", "u,v,w"), ["ax, ay, az", "missing", "u, v, w"]),
    "no joints at all": (rows().replace("q1,q2", "u,v"), ["q1 .. q2", "missing"]),
    "text in a cell": (cell(12, 3, "oops"), ["line 12", "`ax`", "'oops'", "number"]),
    "NaN": (cell(12, 3, "nan"), ["line 12", "`ax`", "not a number"]),
    "empty cell": (cell(12, 1, ""), ["line 12", "`q1`", "empty"]),
    "infinite": (cell(12, 5, "inf"), ["line 12", "`az`", "inf", "finite"]),
    "time backwards": (cell(20, 0, "0.01"), ["line 20", "backwards", "0.01", "0.17"]),
    "repeated rows": (rows(lambda i, row: [f"{0.01 * (i - (i > 20)):.2f}", *row[1:]]), ["line", "0.2 s", "again"]),
    "time stands still": (each(0, lambda _: "1.0"), ["time", "1"]),
    "short line": (rows().replace("0.10,0.0100,0.5,", "0.10,0.0100,"), ["line 12", "5 cells", "6 columns"]),
    "empty file": ("", ["empty"]),
    "blank file": ("\n\n", ["empty"]),
    "header only": ("t,q1,q2,ax,ay,az\n", ["0 samples", "8"]),
    "two rows": (rows(count=2), ["2 samples", "8"]),
    "no header": (rows().split("\n", 1)[1], ["line 1", "header line is missing"]),
    "prose": ("Dear sir\nplease find enclosed\n", ["not a CSV", "Dear sir"]),
    "binary": (b"\x7fELF\x00\x01\x02\xff\xfe" * 50, ["not a CSV"]),
    "not UTF-8": (rows().encode() + b"\xff\xfe\xfa", ["not UTF-8"]),
    "degrees": (scaled({1}, 2000.0), ["joint 1", "degrees", "q: deg", "--columns"]),
    "g": (scaled({3, 4, 5}, 1 / 9.81), ["in g", "a: g", "--columns"]),
    "milli-g": (scaled({3, 4, 5}, 1000 / 9.80665), ["in mg", "a: mg"]),
    "gravity removed": (scaled({3, 4, 5}, 0.001 * 9.80665 / 9.81 * 7), ["gravity", "removed"]),
    "milliseconds": (scaled({0}, 1000.0), ["in ms", "t: ms"]),
    "column twice": (each(5, "{},9.81".format).replace("ay,az", "ay,az,az"), ["`az`", "2 times"]),
}


@pytest.fixture
def arm_file(tmp_path):
    path = tmp_path / "arm.yaml"
    path.write_text("name: two\njoints:\n  - {name: shoulder, type: revolute}\n  - {name: elbow2, type: revolute}\n")
    return path


def run(capsys, *arguments):
    status = main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    assert "Traceback" not in captured.err
    return status, captured.out, captured.err


@pytest.mark.parametrize("command", ["check", "calibrate"])
@pytest.mark.parametrize("name", BAD_LOGS)
def test_bad_log_says_where_and_what_to_do(name, command, tmp_path, arm_file, capsys):
    content, words = BAD_LOGS[name]
    log = tmp_path / "log.csv"
    log.write_bytes(content if isinstance(content, bytes) else content.encode())
    out = tmp_path / "result"
    extra = ["--out", out] if command == "calibrate" else []
    status, printed, message = run(capsys, command, log, "--arm", arm_file, *extra)
    assert status == 2
    assert not printed
    assert str(log) in message
    for word in words:
        assert word in message
    assert not out.exists()


BAD_ARMS = {
    "not YAML": ("name: [two\njoints: 3\n", ["line", "not valid YAML"]),
    "empty": ("", ["empty"]),
    "a list": ("- name\n", ["top level"]),
    "no joints": ("name: two\n", ["line 1", "joints: is missing", "base to tip"]),
    "joints not a list": ("name: two\njoints: 6\n", ["line 2", "joints", "list"]),
    "unknown key": ("name: two\nlinks: 3\njoints: [{name: a, type: revolute}]\n", ["line 2", "links", "unknown key"]),
    "key twice": ("name: two\nname: three\njoints: [{name: a, type: revolute}]\n", ["line 2", "name", "line 1"]),
    "unknown type": (
        "name: two\njoints:\n  - {name: a, type: hinge}\n",
        ["line 3", "'hinge'", "revolute or prismatic"],
    ),
    "name twice": ("name: two\njoints: [{name: a, type: revolute}, {name: a, type: revolute}]\n", ["'a'", "differ"]),
    "limits in degrees": (
        "name: two\njoints: [{name: a, type: revolute, limits: [-170, 170]}]\n",
        ["joints[0].limits", "degrees", "-2.967"],
    ),
    "limits reversed": ("name: two\njoints: [{name: a, type: revolute, limits: [1, -1]}]\n", ["limits", "not below"]),
    "negative velocity": (
        "name: two\njoints: [{name: a, type: revolute, velocity: -1}]\n",
        ["velocity: is -1", "above 0"],
    ),
    "text for a number": ("name: two\njoints: [{name: a, type: revolute, velocity: fast}]\n", ["velocity", "'fast'"]),
    "number of rows": (
        (
            "name: two\njoints: [{name: a, type: revolute}]\n"
            "dh: {convention: standard, rows: [{a: 0, alpha: 0, d: 0, theta: 0}, {a: 0, alpha: 0, d: 0, theta: 0}]}\n"
        ),
        ["line 3", "dh.rows", "2 rows", "1 joints"],
    ),
    "convention": (
        "name: two\njoints: [{name: a, type: revolute}]\ndh: {convention: denavit, rows: []}\n",
        ["dh.convention", "'denavit'", "standard or modified"],
    ),
    "angle in degrees": (
        (
            "name: a\njoints: [{name: a, type: revolute}]\n"
            "dh: {convention: standard, rows: [{a: 0, alpha: 90, d: 0, theta: 0}]}\n"
        ),
        ["line 3", "dh.rows[0].alpha", "degrees", "1.570796"],
    ),
    "angle as a formula": (
        (
            "name: a\njoints: [{name: a, type: revolute}]\n"
            "dh: {convention: standard, rows: [{a: 0, alpha: -pi/2, d: 0, theta: 0}]}\n"
        ),
        ["'-pi/2'", "-1.570796"],
    ),
    "missing parameter": (
        "name: a\njoints: [{name: a, type: revolute}]\ndh: {convention: standard, rows: [{a: 0, alpha: 0, d: 0}]}\n",
        ["line 3", "dh.rows[0].theta: is missing", "0.0 where it is zero"],
    ),
    "counts": (
        "name: a\njoints: [{name: a, type: revolute}]\nencoder: {counts_per_revolution: 0}\n",
        ["line 3", "counts_per_revolution: is 0", "above 0"],
    ),
    "one joint's counts": (
        (
            "name: a\njoints: [{name: a, type: revolute}, {name: b, type: revolute}]\n"
            "encoder: {counts_per_revolution: [null, -1]}\n"
        ),
        ["counts_per_revolution[1]: is -1", "above 0"],
    ),
    "counts of other joints": (
        "name: a\njoints: [{name: a, type: revolute}]\nencoder: {counts_per_revolution: [1, 2]}\n",
        ["2 values", "1 joints"],
    ),
    "URDF": ('<?xml version="1.0"?>\n<robot name="two"></robot>\n', ["no <link>", "URDF"]),
}


@pytest.mark.parametrize("name", BAD_ARMS)
def test_bad_arm_says_where_and_what_to_do(name, tmp_path, capsys):
    content, words = BAD_ARMS[name]
    arm = tmp_path / "arm.yaml"
    arm.write_text(content)
    log = tmp_path / "log.csv"
    log.write_text(rows())
    status, _, message = run(capsys, "check", log, "--arm", arm)
    assert status == 2
    for word in (str(arm), *words):
        assert word in message


BAD_MAPS = {
    "unknown key": ("speed: v\n", ["line 1", "speed", "unknown key"]),
    "unknown unit": ("units: {a: gal}\n", ["units.a", "'gal'", "m/s^2"]),
    "unit that is a list": ("units: {a: [g]}\n", ["line 1", "units.a", "a list of 1", "m/s^2"]),
    "column not there": ("q1: pan\n", ["q1", "'pan'", "no file has", "ax"]),
    "list of the wrong length": ("q: [q1]\n", ["list of 2 column names"]),
    "one column twice": ("q: [q1, q1]\n", ["'q1'", "two quantities"]),
    "length for an angle": ("units: {q1: mm}\n", ["units.q1", "revolute"]),
}


@pytest.mark.parametrize("name", BAD_MAPS)
def test_bad_column_map_says_where_and_what_to_do(name, tmp_path, arm_file, capsys):
    content, words = BAD_MAPS[name]
    columns = tmp_path / "map.yaml"
    columns.write_text(content)
    log = tmp_path / "log.csv"
    log.write_text(rows())
    status, _, message = run(capsys, "check", log, "--arm", arm_file, "--columns", columns)
    assert status == 2
    for word in (str(columns), *words):
        assert word in message


def test_files_that_are_not_there_are_named(tmp_path, arm_file, capsys):
    status, _, message = run(capsys, "check", tmp_path / "none.csv", "--arm", arm_file)
    assert status == 2
    assert "none.csv: cannot be read (No such file" in message
    log = tmp_path / "log.csv"
    log.write_text(rows())
    status, _, message = run(capsys, "check", log, "--arm", tmp_path / "none.yaml")
    assert status == 2
    assert "none.yaml: cannot be read" in message
    status, _, message = run(capsys, "check", tmp_path, "--arm", arm_file)
    assert status == 2
    assert "directory" in message


def test_the_same_file_twice_is_refused(tmp_path, arm_file, capsys):
    log = tmp_path / "log.csv"
    log.write_text(rows())
    status, _, message = run(capsys, "check", log, log, "--arm", arm_file)
    assert status == 2
    assert "given twice" in message


@pytest.mark.parametrize(
    ("name", "content"),
    [("log.parquet", b"PAR1 and no more"), ("log.csv.gz", b"\x1f\x8b not gzip"), ("log.gz", b"plain")],
)
def test_broken_containers_are_named(name, content, tmp_path, arm_file, capsys):
    log = tmp_path / name
    log.write_bytes(content)
    status, _, message = run(capsys, "check", log, "--arm", arm_file)
    assert status == 2
    assert name in message


def test_an_output_folder_that_cannot_be_made_is_refused(tmp_path, arm_file, capsys):
    log = tmp_path / "log.csv"
    log.write_text(rows())
    status, _, message = run(capsys, "calibrate", log, "--arm", arm_file, "--out", log / "result")
    assert status == 2
    assert "is a file" in message


def test_a_reference_of_the_wrong_size_is_refused_and_may_begin_with_a_minus(tmp_path, arm_file, capsys):
    log = tmp_path / "log.csv"
    log.write_text(rows())
    status, _, message = run(
        capsys, "calibrate", log, "--arm", arm_file, "--out", tmp_path / "r", "--reference-configuration", "-1,2,3"
    )
    assert status == 2
    assert "3 values" in message
    assert "2 joints" in message
