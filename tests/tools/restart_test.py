#!/usr/bin/env python3
"""Runs that are stopped, killed and gone on with, on the program itself: their results end byte for byte as those of the run that nobody stopped.
Usage: restart_test.py NANSON SOURCES [NAME ...]"""
import hashlib
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

NANSON, SOURCES = sys.argv[1], Path(sys.argv[2]).resolve()
random.seed(int(os.environ.get("NANSON_TEST_SEED", "17")))
BAR = """scene = "bar"
[mesh]
box = { origin = [0, 0, 0], size = [1, 1, 2] }
cells = [10, 10, 20]
[material]
law = "neo_hookean"
density = 1000.0
youngs_modulus = 1.0e7
poissons_ratio = 0.3
[initial]
field = "twist"
omega = 30.0
height = 2.0
[body_force]
g = [0, 0, -9.81]
[[boundary]]
face = "zmin"
kind = "fixed"
[time]
end = 0.05
[output]
every = 0.004
[monitor]
energy = true
"""
# of summary.json: what is of the clock, the machine or the way, not of the solution
VOLATILE = {"wall_s", "cpu_s", "setup_s", "ns_per_node_step", "peak_bytes", "peak_bytes_per_node", "setup", "sweeps", "throughput",
            "threads", "provenance"}


def nanson(*words, code=0, **more):
    more = {"capture_output": True, "text": True, "timeout": 300, **more}
    ended = subprocess.run([NANSON, *map(str, words)], **more)
    assert ended.returncode == code, (ended.returncode, words, ended.stdout, ended.stderr)
    return ended


def run(*words, code=0, **more):
    return nanson("run", *words, "--quiet", "--threads", 1, code=code, **more)


def summary(folder):
    numbers = json.loads(Path(folder, "summary.json").read_text())
    return {key: value for key, value in numbers.items() if key not in VOLATILE}


def content(path):
    """Of run.vtkhdf: its bytes without the time of its start; where --set makes the text of the scene in it another one, all that can be read of it."""
    import h5py
    arrays = {}

    def take(name, thing):
        attributes = {key: str(value) for key, value in thing.attrs.items()}
        arrays[name] = attributes, thing[...].tobytes() if isinstance(thing, h5py.Dataset) else b""
    with h5py.File(path) as file:
        begun, scene = file.attrs["start"].encode(), file.attrs["scene"]
        file.visititems(take)
    data = Path(path).read_bytes()
    assert data.count(begun) == 1
    return scene, data.replace(begun, b""), arrays


def assert_same(a, b):
    for name in "history.csv", "run.xdmf":
        assert Path(a, name).read_bytes() == Path(b, name).read_bytes(), (a, b, name)
    (scene, data, arrays), (scene_b, data_b, arrays_b) = (content(Path(f, "run.vtkhdf")) for f in (a, b))
    assert arrays == arrays_b, (a, b, "run.vtkhdf")
    assert data == data_b or scene != scene_b, (a, b, "run.vtkhdf", "differ only in bytes that nobody reads")
    assert summary(a) == summary(b), [(k, v, summary(b)[k]) for k, v in summary(a).items() if v != summary(b)[k]]


def start(*words):
    return subprocess.Popen([NANSON, "run", *map(str, words), "--quiet", "--threads", "1"], stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, text=True)


def rows(folder):
    path = Path(folder, "history.csv")
    return path.read_text().count("\n") - 1 if path.exists() else 0


def wait_for_rows(folder, count, process):
    while rows(folder) < count and process.poll() is None:
        time.sleep(0.002)


def whole(scene="bar"):
    if not Path(f"whole_{scene}").exists():
        run(f"{scene}.toml", "--out", f"whole_{scene}")
    return f"whole_{scene}"


def test_stopped_by_signals_at_any_time_it_goes_on():
    for how in signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGXCPU:
        process = start("bar.toml", "--out", "a")
        wait_for_rows("a", random.randint(1, 150), process)
        process.send_signal(how)
        process.communicate(timeout=60)
        assert process.returncode == 128 + how, process.returncode
        assert summary("a")["status"] == "stopped"
        run("bar.toml", "--out", "a", "--restart")
        assert_same(whole(), "a")
        shutil.rmtree("a")


def test_killed_again_and_again_it_goes_on():
    process = start("often.toml", "--out", "k")
    kills = 0
    for _ in range(40):
        time.sleep(random.uniform(0.02, 0.25))
        if process.poll() is not None:
            break
        process.kill()
        process.wait()
        kills += 1
        valid = subprocess.run([NANSON, "info", "k"], capture_output=True).returncode == 0
        process = start("often.toml", "--out", "k", "--restart" if valid else "--force")
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    assert kills > 3, kills
    assert_same(whole("often"), "k")


def test_killed_long_after_its_checkpoint_what_came_later_is_written_again():
    process = start("bar.toml", "--out", "u")
    wait_for_rows("u", 20, process)
    process.send_signal(signal.SIGUSR1)
    while not Path("u", "checkpoint.h5").exists() and process.poll() is None:
        time.sleep(0.002)
    wait_for_rows("u", rows("u") + 60, process)
    process.kill()
    process.wait()
    for i in range(2):
        shutil.copytree("u", f"u{i}")
    text = run("bar.toml", "--out", "u", "--restart").stderr
    assert_same(whole(), "u")
    nanson("run", "bar.toml", "--out", "u0", "--restart", "--threads", 2)
    assert_same(whole(), "u0")
    run("bar.toml", "--restart", "u1", "--out", "elsewhere")
    assert_same(whole(), "elsewhere")
    assert rows("u1") > 60 and not Path("u1", "summary.json").exists(), "the folder gone on from stays as it was"


def test_a_finished_run_goes_on_to_a_later_end():
    run("bar.toml", "--out", "f", "--set", "time.end=0.02")
    nothing = run("bar.toml", "--out", "f", "--set", "time.end=0.02", "--restart", code=2).stderr
    assert "has reached time.end = 0.02 s" in nothing, nothing
    told = run("bar.toml", "--out", "f", "--restart").stderr
    assert "time.end: 0.02 -> 0.05" in told, told
    first, long = Path("f", "history.csv").read_text().splitlines(), Path(whole(), "history.csv").read_text().splitlines()
    same = next(i for i, (a, b) in enumerate(zip(first, long)) if a != b)
    t = [float(line.split(",")[1]) for line in first[1:]]
    assert sum(x < 0.02 for x in t) - same <= 1, "but for the last two steps of the first"
    assert t == sorted(set(t)) and t[-1] == 0.05


def test_steps_and_wall_time_end_a_run_that_goes_on():
    run("bar.toml", "--out", "m", "--set", "time.max_steps=30")
    assert "has done time.max_steps = 30" in run("bar.toml", "--out", "m", "--set", "time.max_steps=30", "--restart", code=2).stderr
    run("bar.toml", "--out", "m", "--set", "time.max_wall_s=0.05", "--restart")
    assert summary("m")["cause"] == "max_wall_s" and summary("m")["steps"] > 30
    run("bar.toml", "--out", "m", "--restart")
    assert_same(whole(), "m")


def test_another_problem_is_refused_by_key():
    run("bar.toml", "--out", "p", "--set", "time.max_steps=5")
    files = lambda: {f: f.read_bytes() for f in Path("p").iterdir() if f.name != ".lock"}
    before = files()
    for key, old, new in ("material.density", "1000 -> 1001", "1001.0"), ("mesh.cells", "[10, 10, 20]", "[10, 10, 21]"), ("boundary.0.kind", "fixed", "symmetric"):
        text = run("bar.toml", "--out", "p", "--restart", "--set", f"{key}={new}", code=2).stderr
        assert "is of another problem" in text and f"{key}: " in text and old in text, text
    text = run("bar.toml", "--out", "p", "--restart", "--set", "physics.formulation=pFHJ", code=2).stderr
    assert 'physics.formulation: "pFJ" -> "pFHJ"' in text, text
    assert before == files()


MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 {height}
5 1 1 1
$EndNodes
$Elements
2
1 4 2 0 1 1 2 3 4
2 4 2 0 1 2 3 4 5
$EndElements
"""


def test_a_mesh_file_that_has_changed_is_refused():
    scene = BAR.replace("box = { origin = [0, 0, 0], size = [1, 1, 2] }\ncells = [10, 10, 20]", 'file = "body.msh"').replace(
        '[[boundary]]\nface = "zmin"\nkind = "fixed"\n', "")
    Path("meshed.toml").write_text(scene)
    Path("body.msh").write_text(MSH.format(height=1))
    run("meshed.toml", "--out", "b", "--set", "time.max_steps=4")
    Path("body.msh").write_text(MSH.format(height=1.5))
    text = run("meshed.toml", "--out", "b", "--restart", code=2).stderr
    assert "mesh: another one than the 5 nodes and 2 tets of the checkpoint" in text, text
    Path("body.msh").write_text(MSH.format(height=1))
    run("meshed.toml", "--out", "b", "--restart", "--set", "time.max_steps=6")


def test_other_outputs_begin_anew_and_nothing_is_lost():
    run("bar.toml", "--out", "o", "--set", "time.max_steps=50")
    told = run("bar.toml", "--out", "o", "--restart", "--set", 'output.fields=["F"]').stderr
    assert "output.fields: " in told and "results begin anew at t = " in told and "earlier results moved to o.1" in told, told
    assert rows("o.1") == 51 and rows("o") == rows(whole()) - 50
    assert summary("o")["state_hash"] == summary(whole())["state_hash"]
    run("bar.toml", "--out", "e", "--set", "time.max_steps=50")
    run("bar.toml", "--out", "e", "--restart", "--set", "output.every=0.001")
    assert Path("e", "history.csv").read_bytes() == Path(whole(), "history.csv").read_bytes()
    assert Path("e", "run.vtkhdf").stat().st_size > Path(whole(), "run.vtkhdf").stat().st_size


def test_damage_is_seen_and_the_checkpoint_before_is_taken():
    run("bar.toml", "--out", "d", "--set", "time.max_steps=60", "--set", "output.checkpoint_every=0.01")
    newest, before = Path("d/checkpoint.h5"), Path("d/checkpoint.old.h5")
    assert newest.exists() and before.exists()
    data = bytearray(newest.read_bytes())
    data[len(data) // 2] ^= 1
    newest.write_bytes(data)
    seen = nanson("info", "d").stdout
    assert "d/checkpoint.h5: is damaged: its checksum is another" in seen and "d/checkpoint.old.h5: valid" in seen, seen
    told = run("bar.toml", "--out", "d", "--restart").stderr
    assert "d/checkpoint.h5: is damaged" in told, told
    assert_same(whole(), "d")
    run("bar.toml", "--out", "d", "--set", "time.max_steps=20")
    Path("d/checkpoint.h5").write_bytes(Path("d/checkpoint.h5").read_bytes()[:-1])
    Path("d/checkpoint.old.h5").unlink(missing_ok=True)
    text = run("bar.toml", "--out", "d", "--restart", code=2).stderr
    assert "d/checkpoint.h5: is damaged: it has " in text, text
    nanson("info", "d", code=2)
    Path("foreign").write_text("scene = 1\n")
    assert "is no checkpoint of nanson" in run("bar.toml", "--out", "d", "--restart", "foreign", code=2).stderr
    assert "no such file or folder" in run("bar.toml", "--out", "d", "--restart", "nowhere", code=2).stderr
    os.makedirs("empty", exist_ok=True)
    assert "holds no checkpoint" in run("bar.toml", "--out", "empty", "--restart", code=2).stderr


def test_results_that_were_cut_are_refused():
    run("bar.toml", "--out", "c", "--set", "time.max_steps=20")
    path = Path("c/history.csv")
    path.write_bytes(path.read_bytes()[:-800])
    assert "the run cannot go on in it: it has" in run("bar.toml", "--out", "c", "--restart", code=2).stderr


def test_a_checkpoint_that_finds_no_room_ends_no_run():
    run("bar.toml", "--out", "r", "--set", "time.max_steps=30", "--set", "output.every=1")
    room = max(f.stat().st_size for f in Path("r").iterdir() if not f.name.startswith("checkpoint")) + 20000
    assert Path("r/checkpoint.h5").stat().st_size > room
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
    told = run("bar.toml", "--out", "r", "--restart", "--set", "output.every=1", "--set", "time.max_steps=60", preexec_fn=limit).stderr
    assert "warning: r/checkpoint.h5: could not be written: File too large" in told, told
    assert "step 30, " in nanson("info", "r").stdout, "the one before stands"
    assert not Path("r/checkpoint.h5.tmp").exists()
    run("bar.toml", "--out", "r", "--restart", "--set", "output.every=1")
    assert summary("r")["state_hash"] == summary(whole())["state_hash"]


def test_the_word_before_or_after():
    run("bar.toml", "--out", "w", "--set", "time.max_steps=10")
    nanson("run", "--quiet", "--out", "w", "--restart", "bar.toml", "--set", "time.max_steps=20")
    assert summary("w")["steps"] == 20


def test_every_scene_of_configs():
    """Stopped at some step, gone on with on another number of threads."""
    for scene in sorted((SOURCES / "configs").glob("*.toml")):
        name, steps = scene.stem, random.randint(6, 10)
        stop = random.randint(1, steps - 1)
        few = ["--set", f"time.max_steps={steps}", "--set", "output.history_every=2"]
        run(scene, "--out", f"{name}_probe", *few)
        every = ["--set", f"output.every={json.loads(Path(f'{name}_probe', 'summary.json').read_text())['t_end'] / 3.5}"]
        run(scene, "--out", f"{name}_a", *few, *every)
        run(scene, "--out", f"{name}_b", *few, *every, "--set", f"time.max_steps={stop}")
        nanson("run", scene, "--out", f"{name}_b", *few, *every, "--restart", "--quiet", "--threads", 2)
        assert_same(f"{name}_a", f"{name}_b")
        for folder in "probe", "a", "b":
            shutil.rmtree(f"{name}_{folder}")


if __name__ == "__main__":
    tests = {name: test for name, test in list(globals().items()) if name.startswith("test_")}
    wanted = sys.argv[3:] or list(tests)
    failed = 0
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        Path("bar.toml").write_text(BAR)
        Path("often.toml").write_text(BAR.replace("every =", "checkpoint_every = 0.02\nevery ="))
        for name in wanted:
            begin = time.time()
            try:
                tests[name]()
                print(f"ok   {name} ({time.time() - begin:.1f} s)")
            except Exception as error:  # every test is told, and the reason of each failure
                failed += 1
                print(f"FAIL {name}: {type(error).__name__}: {error}")
    sys.exit(1 if failed else 0)
