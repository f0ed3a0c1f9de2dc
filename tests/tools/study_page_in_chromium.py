#!/usr/bin/env python3
"""The page of a study opened in headless Chromium, as wide as a phone: no console message, all plots there and with a size, links lead somewhere, nothing sticks out.
Usage: study_page_in_chromium.py NANSON SOURCE_DIR CHROMIUM"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

NANSON, SOURCE, CHROMIUM = sys.argv[1], Path(sys.argv[2]), sys.argv[3]

# Written into a copy of the page: the results are left in the document, which --dump-dom prints.
PROBE = """<script>
window.addEventListener("load", () => {
  const svgs = [...document.querySelectorAll("figure svg")];
  const links = [...document.querySelectorAll("a[href^='#']")];
  const found = {
    plots: svgs.length,
    empty: svgs.filter(s => s.getBoundingClientRect().width < 100 || s.getBoundingClientRect().height < 50 || s.querySelectorAll("path").length < 3).length,
    dead: links.filter(a => !document.getElementById(a.getAttribute("href").slice(1))).map(a => a.getAttribute("href")),
    width: document.documentElement.scrollWidth, window: window.innerWidth,
    outside: performance.getEntriesByType("resource").map(e => e.name),
  };
  const pre = document.createElement("pre");
  pre.id = "probe";
  pre.textContent = JSON.stringify(found);
  document.body.append(pre);
});
</script></body>"""


def open_page(path, width):
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--window-size={width},900", "--enable-logging=stderr", "--v=0",
               "--virtual-time-budget=5000", f"--user-data-dir={path.parent}/profile", "--dump-dom", path.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    messages = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    assert not messages, messages
    probe = re.search(r'<pre id="probe">(.*?)</pre>', done.stdout, re.S)
    assert probe, done.stdout[-2000:] + done.stderr[-2000:]
    return json.loads(probe.group(1).replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">"))


with tempfile.TemporaryDirectory() as folder:
    out = Path(folder) / "out"
    subprocess.run([NANSON, "study", str(SOURCE / "configs/studies/smoke.toml"), "--out", str(out)], check=True, capture_output=True)
    plots = len(list(out.glob("plot-*.svg")))
    page = Path(folder) / "probe.html"
    page.write_text((out / "report.html").read_text(encoding="utf-8").replace("</body>", PROBE), encoding="utf-8")
    for width in (500, 1200):  # Chromium's windows are not narrower than 500
        found = open_page(page, width)
        print(width, found)
        assert found["plots"] == plots and found["empty"] == 0 and not found["dead"] and not found["outside"], found
        assert found["width"] <= found["window"], found
