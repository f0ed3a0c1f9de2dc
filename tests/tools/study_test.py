#!/usr/bin/env python3
"""`nanson study` end to end on tiny meshes: results, verdicts, resuming after Ctrl-C and after a kill, time limit, without gnuplot, bad input.
Usage: study_test.py NANSON SOURCE_DIR"""
import csv
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

NANSON, SOURCE = sys.argv[1], Path(sys.argv[2])
STUDIES = SOURCE / "configs/studies"
XHTML, SVG = "{http://www.w3.org/1999/xhtml}", "{http://www.w3.org/2000/svg}"
HAS_GNUPLOT = shutil.which("gnuplot") is not None


def start(study, out="out", **more):
    return subprocess.Popen([NANSON, "study", str(study), "--out", out], stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True, **more)


def study(path, code=0, **more):
    process = start(path, **more)
    out, err = process.communicate(timeout=6000)
    assert process.returncode == code, (process.returncode, out, err)
    return err


def rows(folder="out"):
    with open(f"{folder}/runs.csv", newline="") as f:
        return list(csv.DictReader(f))


def records():
    """When each finished run was made."""
    return {p.parent.name: p.stat().st_mtime_ns for p in Path("out/runs").glob("*/run.toml")}


def check_links(root, name):
    ids = [e.get("id") for e in root.iter() if e.get("id")]
    assert len(ids) == len(set(ids)), f"{name}: ids that stand twice: {sorted(i for i in set(ids) if ids.count(i) > 1)}"
    wanted = []
    for e in root.iter():
        for key, value in e.attrib.items():
            if key.endswith("href"):
                assert value.startswith("#") or value == "data:,", f"{name}: {value} is not on this page"
                wanted += [value[1:]] if value.startswith("#") else []
            assert key != "src", f"{name}: loads {value}"
            wanted += re.findall(r"url\(#([^)]*)\)", value)
    missing = set(wanted) - set(ids)
    assert not missing, f"{name}: nothing has the ids {sorted(missing)}"
    return len(wanted)


def check_page(plots, runs):
    text = Path("out/report.html").read_text(encoding="utf-8")
    assert "@import" not in text and 'name="viewport"' in text
    page = ElementTree.fromstring(text)
    assert check_links(page, "report.html") > runs
    assert len(list(page.iter(XHTML + "figure"))) == plots
    assert len([e for e in page.iter(XHTML + "tr") if e.get("id", "").startswith("run-")]) == runs
    drawn = plots if HAS_GNUPLOT else 0
    assert len(list(page.iter(SVG + "svg"))) == len(list(Path("out").glob("*.svg"))) == drawn
    for path in Path("out").glob("*.svg"):
        picture = ElementTree.parse(path).getroot()
        assert picture.tag == SVG + "svg" and picture.get("viewBox")
        check_links(picture, path.name)


def test_convergence():
    study(STUDIES / "smoke.toml")
    table = rows()
    assert len(table) == 6 and {r["verdict"] for r in table} == {"sound"}, table
    for r in table:
        first = r["mesh.cells"] == "[2, 2, 2]"
        assert (r["rate of errors.p1_L2"] == "") == first and float(r["cpu_s"]) > 0 and float(r["bytes_per_node"]) > 0
    errors = [float(r["errors.p1_L2"]) for r in table]
    assert errors[0] > errors[1] > errors[2] and errors[3] > errors[4] > errors[5] and errors[5] < errors[2]
    check_page(plots=4, runs=6)
    made = records()
    err = study(STUDIES / "smoke.toml")
    assert err.count("made before") == 6 and records() == made and rows() == table


def test_map_with_runs_that_break():
    study(STUDIES / "smoke_map.toml")
    table = rows()
    assert len(table) == 8
    for r in table:
        assert (r["verdict"] == "sound") == (r["time.cfl"] == "0.3"), r
        assert (r["reason"] == "") == (r["verdict"] == "sound"), r
    assert any("det F is not positive" in r["reason"] for r in table)
    check_page(plots=1, runs=8)


SLOW = """study = "slow"
kind = "sweep"
scene = "{source}/configs/twisting_column.toml"
[set]
"mesh.cells" = [{n}, {n}, {six_n}]
"time.end" = {end}
"output.every" = 10.0
[vary]
"time.cfl" = {cfl}
[report]
y = "energy.closure"
{more}
"""


def write_slow(end, more="", n=6, runs=2):
    Path("slow.toml").write_text(SLOW.format(source=SOURCE, end=end, more=more, n=n, six_n=6 * n, cfl=[0.3 - 0.01 * i for i in range(runs)]))
    return "slow.toml"


def interrupted(how, code):
    """Ends the study in its third run (or a later one, on a busy machine), then goes on: what was finished is kept, the rest is made."""
    path = write_slow(0.03, runs=6)
    process = start(path)
    while len(records()) < 2:
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    process.send_signal(how)
    out, err = process.communicate(timeout=600)
    assert process.returncode == code, (process.returncode, err)
    kept = records()
    assert 2 <= len(kept) < 6, kept
    if how == signal.SIGINT:
        assert "the same command goes on from there" in err, err
        assert len(rows()) == len(kept)
        check_page(plots=1, runs=len(kept))
    err = study(path)
    assert err.count("made before") == len(kept), err
    now = records()
    assert len(now) == 6 and all(now[run] == made for run, made in kept.items())
    assert len(rows()) == 6


def test_goes_on_after_control_c():
    interrupted(signal.SIGINT, 130)


def test_goes_on_after_a_kill():
    interrupted(signal.SIGKILL, -signal.SIGKILL)


def test_a_cut_summary_is_made_again():
    path = write_slow(0.001, n=2)
    study(path)
    victim = next(Path("out/runs").iterdir())
    (victim / "summary.json").write_text((victim / "summary.json").read_text()[:100])
    err = study(path)
    assert err.count("made before") == 1, err
    assert len(rows()) == 2


def test_too_slow_is_a_verdict():
    path = write_slow(10, "max_wall_s = 0.3")
    study(path)
    assert [r["verdict"] for r in rows()] == ["too slow"] * 2, rows()
    assert study(path).count("made before") == 2
    err = study(write_slow(10, "max_wall_s = 0.4"))
    assert "made before" not in err, err
    check_page(plots=0, runs=2)


def test_compare():
    Path("compare.toml").write_text(f"""study = "compare"
kind = "compare"
scene = "{STUDIES}/../low_dispersion_cube.toml"
[set]
"mesh.cells" = [4, 4, 4]
[[case]]
name = "lean & quick"
set = {{ "physics.flux_correction" = "none", "monitor.energy" = false }}
[[case]]
name = "full <correction>"
[report]
y = ["bytes_per_node", "errors.p1_L2"]
baseline = "lean & quick"
""")
    study("compare.toml")
    table = rows()
    assert [r["case"] for r in table] == ["lean & quick", "full <correction>"]
    assert float(table[0]["bytes_per_node"]) < float(table[1]["bytes_per_node"])
    check_page(plots=2, runs=2)


def test_without_gnuplot():
    err = study(STUDIES / "smoke.toml", env={**os.environ, "PATH": "/nonexistent"})
    assert "gnuplot is not installed" in err, err
    assert len(rows()) == 6 and not list(Path("out").glob("*.svg"))
    page = ElementTree.parse("out/report.html").getroot()
    check_links(page, "report.html")
    assert len(list(page.iter(XHTML + "figure"))) == 4 and not list(page.iter(SVG + "svg"))
    assert len(list(Path("out").glob("plot-*.gnuplot"))) == 4


def test_a_quote_in_the_folder():
    err = study(STUDIES / "smoke_map.toml", out="it's")
    assert "could not draw" not in err, err
    assert len(list(Path("it's").glob("plot-*.svg"))) == HAS_GNUPLOT


HOSTILE = """study = "hostile"
kind = "{kind}"
scene = "{source}/configs/low_dispersion_cube.toml"
[set]
"mesh.cells" = [2, 2, 2]
"time.end" = 0.0002
[vary]
"time.cfl" = [0.2, 0.3]
[[case]]
name = "{name}"
set = {{ "monitor.energy" = true }}
[report]
y = ["steps"]
{more}
"""


def test_nothing_between_backquotes_runs():
    """Not from a case's name, a reference's label, the folder or --labels, quoted either way; names that gnuplot takes for a pipe neither."""
    names = ["a`touch RAN1`b", "q' . system('touch RAN2') . 'b", 'q\\" . system(\\"touch RAN3\\") . \\"b', "=cmd|'touch RAN4'", "{brace", "back\\\\slash\\\\"]
    Path("reference.csv").write_text('label,cpu_s,steps\n"x`touch RAN5`",1,2\n')
    for i, name in enumerate(names):
        for kind, more in ("sweep", 'x = "cpu_s"\nreference = "reference.csv"'), ("compare", ""), ("stability", 'x = "time.cfl"'):
            Path("hostile.toml").write_text(HOSTILE.format(kind=kind, source=SOURCE, name=name, more=more))
            out = f"<`touch RAN6`{i}{kind}" if i % 2 else f"|touch RAN7;{i}{kind}"
            err = study("hostile.toml", out=out)
            assert "could not draw" not in err, err
            if HAS_GNUPLOT:
                assert list(Path(out).glob("plot-*.svg")), err
                plain = subprocess.run(["gnuplot", "plot-1.gnuplot"], cwd=out, capture_output=True, text=True)
                assert plain.returncode == 0 and "</svg>" in plain.stdout, plain.stderr
    if HAS_GNUPLOT:
        run = subprocess.run([NANSON, "run", f"{SOURCE}/configs/low_dispersion_cube.toml", "--quiet", "--set", "mesh.cells=[2,2,2]", "--set", "time.end=0.0002", "--out", "<`touch RAN8`"])
        assert run.returncode == 0
        subprocess.run([f"{SOURCE}/io/results/plot_history.py", "<`touch RAN8`", "--columns", "dt", "-o", "|`touch RAN8`.svg", "--labels", "`touch RAN9`'"], check=True)
        assert Path("|`touch RAN8`.svg").read_text().endswith("</svg>\n\n")
    assert not list(Path(".").rglob("RAN*")), list(Path(".").rglob("RAN*"))


def test_bad_input_starts_nothing():
    Path("bad.toml").write_text((STUDIES / "smoke.toml").read_text().replace('"../', f'"{SOURCE}/configs/').replace("[6, 6, 6]", "[6, 6]").replace('"full"', '"fall"'))
    err = study("bad.toml", code=2)
    assert err.startswith("bad.toml:11:38: physics.flux_correction = \"fall\"") and "\nbad.toml:12:39: mesh.cells = [6, 6]" in err and "\n2 errors: nothing was run or written" in err, err
    assert not Path("out").exists()
    assert "no such file" in study("none.toml", code=2)


for name, test in sorted(globals().items()):
    if name.startswith("test_"):
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            began = time.monotonic()
            test()
            os.chdir("/")
            print(f"{name}: {time.monotonic() - began:.1f} s", flush=True)
