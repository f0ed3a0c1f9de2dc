"""pvpython read_with_paraview.py WRITE_SAMPLE [PNG]: the results of tests/tools/write_sample.cpp in ParaView's own readers.

ParaView from 5.12 on reads all times from run.vtkhdf, older ones the first frame only; the three XDMF readers show all times in every version.
With PNG the warped beam at the last time is drawn (needs a display: xvfb-run)."""
import subprocess
import sys
import tempfile
from pathlib import Path

from paraview import simple

TIMES = [0.0, 0.25, 0.5, 0.75, 1.0]


def check(name, reader, times):
    reader.UpdatePipelineInformation()
    found = list(getattr(reader, "TimestepValues", None) or [])
    assert found == times or not times, (name, found)
    for t in times or [0.0]:
        reader.UpdatePipeline(t)
        data = reader.GetDataInformation()
        assert (data.GetNumberOfPoints(), data.GetNumberOfCells()) == (117, 288), (name, t)
        ranges = {a.GetName(): [a.GetRange(c) for c in range(a.GetNumberOfComponents())] for a in reader.PointData.values()}
        assert set(ranges) == {"displacement", "velocity", "pressure", "P"}, (name, sorted(ranges))
        assert abs(ranges["displacement"][0][1] - 0.02 * t * 144) < 1e-6, (name, t, ranges["displacement"])
        assert ranges["pressure"][0] == (1000 * t, 1000 * t + 116), (name, t, ranges["pressure"])
        assert [r[0] for r in ranges["P"]] == [1000 * t + c / 16 for c in range(9)], (name, t, ranges["P"])
        assert [a.GetName() for a in reader.CellData.values()] == ["region"], name
        assert reader.CellData["region"].GetRange() == (0, 1), name
    print(name, "reads", len(times) or 1, "frames")


def draw(reader, png):
    view = simple.CreateView("RenderView")
    view.ViewSize = [900, 500]
    warp = simple.WarpByVector(Input=reader)
    warp.Vectors = ["POINTS", "displacement"]
    shown = simple.Show(warp, view)
    shown.Representation = "Surface With Edges"
    view.ViewTime = TIMES[-1]
    simple.UpdatePipeline(TIMES[-1], warp)
    simple.ColorBy(shown, ("POINTS", "displacement", "Magnitude"))
    shown.RescaleTransferFunctionToDataRange()
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [8, -25, 14], [2, 1, 6], [1, 0, 0]
    simple.Render(view)
    simple.SaveScreenshot(png, view)


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], folder], check=True)
    fields, sidecar = str(Path(folder) / "run.vtkhdf"), str(Path(folder) / "run.xdmf")
    transient = simple.GetParaViewVersion() >= (5, 12)
    check("VTKHDFReader", simple.VTKHDFReader(FileName=fields), TIMES if transient else [])
    check("Xdmf3ReaderS", simple.Xdmf3ReaderS(FileName=[sidecar]), TIMES)
    check("Xdmf3ReaderT", simple.Xdmf3ReaderT(FileName=[sidecar]), TIMES)
    last = simple.XDMFReader(FileNames=[sidecar])
    check("XDMFReader", last, TIMES)
    if len(sys.argv) > 2:
        draw(last, sys.argv[2])
