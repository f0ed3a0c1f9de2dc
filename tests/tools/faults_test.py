#!/usr/bin/env python3
"""Kinds of faults, on the program itself: streams that are closed or full, signals, folders in use, input that is meant to hurt.
Usage: faults_test.py NANSON [NAME ...]"""
import json
import os
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

NANSON = sys.argv[1]
TINY = """scene = "tiny"
[mesh]
box = { origin = [0, 0, 0], size = [1, 1, 1] }
cells = [2, 2, 2]
[material]
law = "neo_hookean"
density = 1000.0
youngs_modulus = 1.0e7
poissons_ratio = 0.3
[initial]
field = "twist"
omega = 20.0
height = 1.0
[time]
end = 0.01
[output]
every = 0.002
"""


def nanson(*words, code=0, **more):
    more = {"capture_output": True, "text": True, "timeout": 60, **more}
    ended = subprocess.run([NANSON, *map(str, words)], **more)
    assert ended.returncode == code, (ended.returncode, words, ended.stdout, ended.stderr)
    return ended


def run(*words, code=0, **more):
    return nanson("run", "tiny.toml", "--threads", 1, *words, code=code, **more)


def summary(folder):
    return json.loads((Path(folder) / "summary.json").read_text())


def shell(line):
    return subprocess.run(["sh", "-c", line.replace("NANSON", NANSON)], capture_output=True, text=True, timeout=60)


def rows_are_whole(folder):
    lines = (Path(folder) / "history.csv").read_text().splitlines()
    return len(lines) > 5 and all(line.count(",") == lines[0].count(",") for line in lines)


def test_no_stream_that_is_closed_or_full_ends_a_run():
    run("--out", "right")
    right = summary("right")["state_hash"]
    ways = ["<&-", ">&-", "2>&-", "<&- >&-", "<&- 2>&-", ">&- 2>&-", "<&- >&- 2>&-", ">/dev/full", "2>/dev/full", ">/dev/full 2>/dev/full"]
    for i, way in enumerate(ways):
        ended = shell(f"NANSON run tiny.toml --threads 1 --out s{i} {way}")
        assert ended.returncode == 0, (way, ended)
        assert summary(f"s{i}")["state_hash"] == right and rows_are_whole(f"s{i}"), way
        assert Path(f"s{i}/.lock").read_text().isdigit(), way
        errors = shell(f"NANSON check tiny.toml --set a=1 {way}")
        assert errors.returncode == 2, (way, errors)


def test_a_report_that_is_lost_is_a_failure():
    assert shell("NANSON check tiny.toml >/dev/full").returncode == 1
    assert "could not be written: No space left" in shell("NANSON check tiny.toml >/dev/full").stderr
    assert shell("NANSON check tiny.toml | head -1").returncode == 0


def test_a_run_goes_on_when_nobody_reads_its_lines():
    ended = subprocess.run(["bash", "-c", f"{NANSON} run tiny.toml --threads 1 --out o 2>&1 | head -1; exit ${{PIPESTATUS[0]}}"], timeout=60)
    assert ended.returncode == 0 and summary("o")["status"] == "done"


def test_the_progress_line_ends_before_the_closing_line():
    master, slave = pty.openpty()
    ended = subprocess.Popen([NANSON, "run", "tiny.toml", "--threads", "1"], stdout=slave, stderr=slave, stdin=slave)
    os.close(slave)
    text = b""
    while True:
        try:
            piece = os.read(master, 4096)
        except OSError:
            break
        if not piece:
            break
        text += piece
    assert ended.wait(timeout=60) == 0
    assert b"ETA 0s\r\ndone" in text, text
    assert text.endswith(b"\r\n") and not text.endswith(b"\r\n\r\n"), text


def test_signals_leave_last_frame_and_summary():
    for how in signal.SIGHUP, signal.SIGTERM, signal.SIGINT:
        process = subprocess.Popen([NANSON, "run", "tiny.toml", "--threads", "1", "--set", "time.end=1000", "--out", f"o{how}"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
        process.stderr.readline()  # the first line of its progress
        while not Path(f"o{how}/history.csv").exists():
            time.sleep(0.01)
        time.sleep(0.2)
        process.send_signal(how)
        process.communicate(timeout=60)
        assert process.returncode == 128 + how, process.returncode
        assert summary(f"o{how}")["status"] == "stopped" and summary(f"o{how}")["cause"] == "signal"


def test_frames_closer_than_steps_are_one_a_step():
    """And no number of them makes the loop deaf to its time."""
    for every in "1e-12", "1e-30", "1e-300", "5e-324":
        run("--force", "--set", f"output.every={every}", "--set", "time.max_steps=5", timeout=10)
        assert Path("results/tiny/run.xdmf").read_text().count("<Time") == 6
    run("--force", "--set", "output.every=1e-30", "--set", "time.max_wall_s=0.5", "--set", "time.end=1000", timeout=10)
    assert summary("results/tiny")["cause"] == "max_wall_s"
    times = [float(t.split('"')[0]) for t in Path("results/tiny/run.xdmf").read_text().split('<Time Value="')[1:]]
    assert times[-1] == summary("results/tiny")["t_end"] and times == sorted(set(times))


def test_a_projection_without_end_hears_signals_and_the_time():
    text = TINY.replace("poissons_ratio = 0.3", 'poissons_ratio = 0.5\n[physics]\nformulation = "pFp"\n[projection]\ntolerance = 1e-300\nmax_iterations = 2147483647')
    Path("tiny.toml").write_text(text)
    for solver in "cg", "pseudo_time":
        solve = ["--set", f"projection.solver={solver}"] + (["--set", "projection.length_scale=1"] if solver == "pseudo_time" else [])
        run("--force", *solve, "--set", "time.max_wall_s=1", timeout=20)
        assert summary("results/tiny")["cause"] == "max_wall_s"
        process = subprocess.Popen([NANSON, "run", "tiny.toml", "--threads", "1", "--quiet", "--force", *solve], stderr=subprocess.PIPE)
        time.sleep(1)
        process.send_signal(signal.SIGTERM)
        err = process.communicate(timeout=10)[1]
        assert process.returncode == 128 + signal.SIGTERM and b"asked to stop within the projection" in err, err


def test_input_that_is_meant_to_hurt_is_refused():
    deep = ".".join(["a"] * 40000)
    Path("deep.toml").write_text(TINY + deep + " = 1\n")
    err = nanson("check", "deep.toml", code=2).stderr
    assert "deep.toml:18:128: a key of more than 64 parts" in err, err[-300:]
    nanson("check", "tiny.toml", "--set", deep + "=1", code=2)
    ranges = "\n".join(f'"{key}" = {{ from = 1.0, to = 2.0, count = 1000 }}' for key in ("time.end", "material.density", "material.youngs_modulus", "initial.omega"))
    Path("bomb.toml").write_text(f'study = "bomb"\nkind = "sweep"\nscene = "tiny.toml"\n[vary]\n{ranges}\n[report]\ny = ["steps"]\n')
    err = nanson("study", "bomb.toml", code=2, timeout=10).stderr
    assert "makes 1e+12 runs, allowed are 100000" in err, err


def test_nothing_is_overwritten_without_a_word():
    run("--quiet")
    first = summary("results/tiny")
    err = run("--quiet", "--set", "time.end=0.005").stderr
    assert err == "earlier results moved to results/tiny.1\n", err
    assert summary("results/tiny.1") == first and summary("results/tiny")["t_end"] == 0.005
    assert sorted(os.listdir("results/tiny.1")) == ["checkpoint.h5", "history.csv", "run.vtkhdf", "run.xdmf", "summary.json"]
    assert run("--quiet", "--force").stderr == ""
    assert summary("results/tiny")["t_end"] == 0.01 and not Path("results/tiny.2").exists()
    run("--quiet", "--set", "time.end=-1", code=2)
    assert not Path("results/tiny.2").exists()


FLAT = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0.3 0.3 -1e-13
$EndNodes
$Elements
2
1 4 2 1 1 1 2 3 4
2 4 2 1 1 1 3 2 5
$EndElements
"""


def test_a_tet_too_flat_for_double_precision_is_wrong_input():
    Path("flat.msh").write_text(FLAT)
    Path("tiny.toml").write_text(TINY.replace("box = { origin = [0, 0, 0], size = [1, 1, 1] }", 'file = "flat.msh"').replace("cells = [2, 2, 2]\n", ""))
    output = run("--out", "flat", code=2).stderr
    assert "flat.msh: tet 1 with nodes" in output and "is flat: volume" in output, output
    assert not Path("flat").exists()


def test_an_empty_name_is_refused():
    for what in "run", "study":
        Path("study.toml").write_text('study = "s"\nkind = "sweep"\nscene = "tiny.toml"\n[vary]\n"time.cfl" = [0.2, 0.3]\n[report]\ny = ["steps"]\n')
        err = nanson(what, "tiny.toml" if what == "run" else "study.toml", "--out", "", code=2).stderr
        assert err == "the name of the results folder is empty\n", err
    assert not Path("results").exists()


for name, test in sorted(globals().items()):
    if name.startswith("test_") and (len(sys.argv) < 3 or any(word in name for word in sys.argv[2:])):
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            Path("tiny.toml").write_text(TINY)
            began = time.monotonic()
            test()
            os.chdir("/")
            print(f"{name}: {time.monotonic() - began:.1f} s", flush=True)
