#!/usr/bin/python3
"""read_with_h5py.py WRITE_SAMPLE: the results of tests/tools/write_sample.cpp as a user's script sees them (h5py, json, csv)."""
import csv
import json
import math
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

import h5py
import numpy as np

FRAMES, TIMES = 5, [0.0, 0.25, 0.5, 0.75, 1.0]
FIELDS = {"displacement": 3, "velocity": 3, "pressure": 1, "P": 9}


def expected(name, components, points, t):
    nodes = len(points)
    if name == "displacement":
        values = np.zeros((nodes, 3))
        values[:, 0] = 0.02 * t * points[:, 2] ** 2
    else:
        values = 1000 * t + np.arange(nodes)[:, None] + np.arange(components) / 16
    return (values[:, 0] if components == 1 else values).astype(np.float32)


def check_fields(path):
    with h5py.File(path, "r") as f:
        vtk = f["VTKHDF"]
        points, tets = vtk["Points"][:], vtk["Connectivity"][:].reshape(-1, 4)
        assert vtk.attrs["Type"] == b"UnstructuredGrid" and list(vtk.attrs["Version"]) == [2, 0]
        assert points.shape == (117, 3) and tets.shape == (288, 4) and (vtk["Types"][:] == 10).all()
        edges = points[tets[:, 1:]] - points[tets[:, :1]]
        assert np.allclose(np.linalg.det(edges), 1), "tets are right-handed, volume 1/6"
        region = vtk["CellData/region"]
        assert list(region.attrs["names"]) == ["bottom", "top"] and np.bincount(region[:]).tolist() == [144, 144]
        assert vtk["Steps"].attrs["NSteps"] == FRAMES and vtk["Steps/Values"][:].tolist() == TIMES
        assert list(f["frames"]) == [f"{i:06d}" for i in range(FRAMES)]
        for i, t in enumerate(TIMES):
            frame = f[f"frames/{i:06d}"]
            assert frame.attrs["time"] == t and frame.attrs["step"] == 100 * i
            assert frame.attrs.get("breakdown", 0) == (i == FRAMES - 1)
            for name, components in FIELDS.items():
                offset = vtk["Steps/PointDataOffsets"][name][i]
                for got in (frame[name][:], vtk["PointData"][name][offset:offset + len(points)]):
                    assert got.dtype == np.float32 and np.allclose(got, expected(name, components, points, t), rtol=1e-6), (name, i)
        assert vtk["PointData/pressure"].attrs["unit"] == "Pa"
        assert f.attrs["generator"] == "nanson" and f.attrs["threads"] == "2" and f.attrs["scene"] == 'scene = "sample"  # \u00e9\n'
        return dict(f.attrs)


def check_sidecar(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    grids = root.findall("./Domain/Grid/Grid")
    assert [float(g.find("Time").get("Value")) for g in grids] == TIMES
    assert [g.find("Information") is not None for g in grids] == [False] * 4 + [True]
    for item in root.iter("DataItem"):
        name, inside = item.text.split(":")
        with h5py.File(path.parent / name, "r") as f:
            assert math.prod(map(int, item.get("Dimensions").split())) == f[inside].size, item.text


def check_history(path):
    with open(path, newline="") as f:
        rows = list(csv.reader(f))
    assert rows[0] == ["t [s]", "third [-]", "broken [-]"]
    assert [[float(x) for x in row[:2]] for row in rows[1:]] == [[t, t / 3] for t in TIMES]
    assert [math.isnan(float(row[2])) for row in rows[1:]] == [False] * 4 + [True]
    assert np.genfromtxt(path, delimiter=",", skip_header=1).shape == (5, 3)


def check_summary(path, attributes):
    def refuse(constant):
        raise ValueError(f"{constant} is not JSON")
    summary = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)
    assert summary["status"] == "breakdown" and summary["reason"] == 'det F = NaN at node 7, "top"\n'
    assert summary["cause"] == "detF"
    assert summary["nodes"] == 117 and summary["tets"] == 288 and summary["wall_s"] == 0.1 + 0.2
    assert summary["peak_bytes"] == 234e3 and summary["peak_bytes_per_node"] == 2000
    assert summary["min_detF"] is None and summary["max_detF"] == 0
    assert summary["energy"] == {"initial": 2, "kinetic": 0, "strain": 0, "external_work": 0.5, "dissipated": None, "angular_momentum_work": None, "closure": None, "lost_at_start": None}
    assert summary["errors"] == {"p1_L2": 1 / 3, "P11_L2": None}
    assert summary["probes"] == {"tip": {"x": [1, 2, 3], "pressure": [-0.5]}}
    assert summary["setup"] == {"metis": 0.25} and summary["sweeps"] == {"edge_flux": 0.75} and summary["fields_left_out"] == ["H"]
    assert summary["provenance"] == {key: attributes[key] for key in ("version", "commit", "compiler", "flags", "cpu", "host")}


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], folder], check=True)
    results = Path(folder)
    attributes = check_fields(results / "run.vtkhdf")
    check_sidecar(results / "run.xdmf")
    check_history(results / "history.csv")
    check_summary(results / "summary.json", attributes)
