#!/usr/bin/env python3
"""check_pages.py SOURCE NANSON: what the pages of the repository promise. Links and file names lead somewhere, README stays a door of at most 900 words and its
scene passes `nanson check`, sources cite only sections of the method and pages that exist, and every scene has its line in the gallery."""
import os
import re
import subprocess
import sys
import tempfile

root, program = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
files = []
for folder, folders, names in os.walk(root):
    if folder == root:  # what is made here
        folders[:] = [f for f in folders if f not in {"results", ".git"} and not f.startswith("build")]
    files += [os.path.relpath(os.path.join(folder, n), root) for n in names]
pages = [f for f in files if f.endswith(".md")]
wrong = []


def text_of(name):
    with open(os.path.join(root, name), encoding="utf-8") as f:
        return f.read()


def anchors(page):  # of its headings, as GitHub makes them
    return {re.sub(r"[^\w\- ]", "", h.strip().lower()).replace(" ", "-") for h in re.findall(r"^#+ (.*)$", text_of(page), re.M)}


def without_code(text):
    return re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)


for page in pages:
    text = without_code(text_of(page))
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", text)):
        if re.match(r"\w+://", target):
            continue
        path, _, anchor = target.partition("#")
        to = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if not os.path.exists(os.path.join(root, to)):
            wrong.append(f"{page}: there is no {target}")
        elif anchor and anchor not in anchors(to):
            wrong.append(f"{page}: {to} has no heading #{anchor}")
    if page == "CHANGELOG.md":
        continue  # names of their time
    for code in re.findall(r"`([^`\n]+)`", text):
        for name in re.findall(r"(?<![\w./*{-])[\w][\w./-]*\.(?:toml|hpp|cpp|py|cmake|sh|geo|md|txt)\b", code):
            if name != "beam.toml" and not any(f == name or f.endswith("/" + name) for f in files):
                wrong.append(f"{page}: there is no file {name}")

readme = text_of("README.md")
if len(readme.split()) > 900:
    wrong.append(f"README.md has {len(readme.split())} words, at most 900: the rest belongs into a page of its own")

sections = set(re.findall(r"^## (\d+)\. ", text_of("kernels/README.md"), re.M))
for f in files:
    if not f.endswith((".hpp", ".cpp", ".in", ".toml", ".py", ".cmake", ".sh", ".geo", "CMakeLists.txt", "nanson")):
        continue
    text = text_of(f)
    for cited in re.findall(r"method, sections? (\d+)(?: and (\d+))?", text):
        wrong += [f"{f}: (method, section {s}): kernels/README.md has none" for s in cited if s and s not in sections]
    for name in re.findall(r"[\w/]*\w\.md\b", text):
        if not any(p == name or p.endswith("/" + name) for p in pages):
            wrong.append(f"{f}: cites {name}, which is not here")

gallery = text_of("configs/README.md")
for f in files:
    if re.fullmatch(r"configs/(extreme/)?\w+\.toml", f) and f"`{os.path.basename(f)[:-5]}`" not in gallery:
        wrong.append(f"configs/README.md: the gallery has no {f}")

scenes = [s for s in re.findall(r"^```toml\n(.*?)^```", readme, re.M | re.S) if s.startswith("scene")]
if len(scenes) != 1:
    wrong.append(f"README.md: {len(scenes)} scenes, one was meant")
for scene in scenes:
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "beam.toml"), "w", encoding="utf-8") as f:
            f.write(scene)
        check = subprocess.run([program, "check", "beam.toml", "--threads", "1"], cwd=folder, capture_output=True, text=True)
        if check.returncode != 0:
            wrong.append(f"README.md: its scene: {check.stderr}")

print("\n".join(wrong) if wrong else f"{len(pages)} pages keep their promises")
sys.exit(bool(wrong))
