#!/usr/bin/env python3
"""The table "rows of the matrix" in docs/verification.md, from docs/rows.txt and from the tables that `bulla verify --save` has
left there: of each scene the last row, which is its finest
(linear modes: the last three, less those of the mesh alone). `--check`: says whether the table is that, and writes nothing."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "verification.md"


def figures(page, scene):
    """Figures of the finest row, its CPU seconds, and whether its bounds hold."""
    block = re.search(rf"<!-- verify {scene} -->\n(.*?)<!-- end {scene} -->", page, re.S)
    if not block:
        return "not computed", "", False
    cells = [[c.strip() for c in line.strip("|").split("|")] for line in block[1].splitlines() if line.startswith("|")]
    head, rows = cells[0], [row for row in cells[2:] if row[0] != "all"]
    rows = [row for row in rows if not row[0].endswith("on=0")]
    shown = []
    for column, name in enumerate(head):
        value = rows[-1][column].replace("**", "")
        if "mode=" in rows[-1][0]:  # one after another on each mesh
            value = " / ".join(row[column] for row in rows[-3:])
        if name not in ("cells", "CPU s", "cell steps", "order") and value:
            shown.append(f"{name} {value}")
        if name == "order" and value:
            shown[-1] += f" (order {value})"
    return f"{'; '.join(shown)} at {rows[-1][0]}", rows[-1][head.index("CPU s")], "Does not hold" not in block[1]


def lines(page):
    yield "| row | asked | scene, figures of its finest row | CPU s | what is to be said |"
    yield "| --- | --- | --- | ---: | --- |"
    for line in (ROOT / "docs" / "rows.txt").read_text().splitlines():
        if not line or line.startswith("#"):
            continue
        row, asked, scenes, note = (part.strip() for part in line.split("|"))
        for scene in scenes.split() or ["-"]:
            if scene.startswith("test:"):
                what, seconds = f"`ctest -R '{scene[5:]}$'`", ""
            elif scene == "-":
                what, seconds = "-", ""
            else:
                shown, seconds, holds = figures(page, scene)
                what = f"`bulla verify {scene}`: {shown}{'' if holds else ' **does not hold**'}"
            yield f"| {row} | {asked} | {what} | {seconds} | {note} |"
            row = asked = note = ""


def main():
    page = PAGE.read_text()
    table = "<!-- rows -->\n" + "\n".join(lines(page)) + "\n<!-- end rows -->"
    new = re.sub(r"<!-- rows -->.*?<!-- end rows -->", lambda _: table, page, flags=re.S)
    if "--check" in sys.argv:
        if new != page:
            sys.exit("docs/verification.md: the table of rows is not that of docs/rows.txt: tests/study/rows.py")
    else:
        PAGE.write_text(new)


main()
