#!/usr/bin/env python3
"""Runs studies and gathers their plots, tables and verdicts on one page that a repository shows: measured/README.md beside this file.

    configs/studies/publish.py PROGRAM [STUDY.toml ...]

PROGRAM is the nanson program (`./nanson`). Without names, all studies but those of the tests. Runs that are there already (results/ below the current folder) are
not made again. Standard library only (Python 3.11)."""
import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

HERE = pathlib.Path(__file__).parent
PAGE = HERE / "measured"
SHORT = {"sound": "yes", "energy grew": "energy"}


def number(text):
    try:
        value = float(text)
        return f"{value:.0f}" if value.is_integer() and abs(value) < 1e9 else f"{value:.3g}"
    except ValueError:
        return text


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows]


def map_table(study, rows):
    """Verdicts: one line for each combination of the other varied keys, one column for each value along x."""
    keys = (["case"] if "case" in study else []) + list(study.get("vary", {}))
    x = study["report"].get("x", keys[-1])
    along = list(dict.fromkeys(r[x] for r in rows))
    others = [k for k in keys if k != x]
    lines = {}
    for r in rows:
        lines.setdefault(tuple(r[k] for k in others), {})[r[x]] = SHORT.get(r["verdict"], r["verdict"])
    return table(others + [f"{x.split('.')[-1]} {number(a)}" for a in along], [list(k) + [v.get(a, "") for a in along] for k, v in lines.items()])


def result_table(study, rows):
    """What was measured: for a convergence study the finest mesh of each curve, otherwise every run."""
    report, keys = study["report"], (["case"] if "case" in study else []) + list(study.get("vary", {}))
    y = report.get("y", [])
    y = [y] if isinstance(y, str) else y
    over = report.get("rate_over", "")
    shown, finest = [k for k in keys if k != over], {}
    for r in rows:
        finest[tuple(r[k] for k in (shown if over else keys))] = r
    columns = (shown + [over] if over else keys) + [c for c in ("nodes", "steps", "cpu_s") if c not in y] + y
    rates = [f"rate of {q}" for q in y if over and f"rate of {q}" in rows[0]]
    return table(columns + rates, [[number(r.get(c, "")) for c in columns + rates] for r in finest.values()])


def section(file, study, rows):
    report, name = study["report"], study["study"]
    verdicts = {}
    for r in rows:
        verdicts.setdefault(r["verdict"], []).append(r)
    out = [f"## {report.get('title', name)}", report.get("text", ""), ""]
    out.append(f"`./nanson study configs/studies/{file.name}`: {len(rows)} runs, " + ", ".join(f"{len(v)} {k}" for k, v in verdicts.items()) + f"; commit {rows[-1]['commit']}.")
    out.append("")
    for plot in sorted((PAGE / name).glob("*.svg"), key=lambda f: int(f.stem.split("-")[1])):
        out.append(f"![{name}]({name}/{plot.name})")
    out.append("")
    out += map_table(study, rows) if study["kind"] == "stability" else result_table(study, rows)
    return out + [""]


def main():
    program, files = sys.argv[1], [pathlib.Path(f) for f in sys.argv[2:]]
    files = files or sorted(f for f in HERE.glob("*.toml") if not f.name.startswith("smoke"))
    PAGE.mkdir(exist_ok=True)
    page, machine, date = [], "", ""
    for file in files:
        study = tomllib.loads(file.read_text())
        subprocess.run([program, "study", str(file)], check=True)
        source, target = pathlib.Path("results") / study["study"], PAGE / study["study"]
        shutil.rmtree(target, ignore_errors=True)
        target.mkdir()
        for f in [*source.glob("*.svg"), source / "runs.csv"]:
            shutil.copy(f, target)
        rows = list(csv.DictReader(line for line in (source / "runs.csv").read_text().splitlines() if not line.startswith("#")))
        report = (source / "report.html").read_text()
        facts = dict(re.findall(r"<dt>([\w ]+)</dt><dd>([^<]*)</dd>", report))
        machine, date = facts.get("machine", ""), facts.get("page made", "")[:10]
        page += section(file, study, rows)
    head = ["# Studies", f"Error against run time, stability, and what is left out, as `publish.py` gathered them on {machine}{', ' + date if date else ''}: each run a process of its own,",
            "one thread, one after another. In the maps, yes: reached the end, the energy never grew by more than 1e-6, det F > 0, no tet was turned inside out.", ""]
    if not sys.argv[2:]:
        (PAGE / "README.md").write_text("\n".join(head + page))


main()
