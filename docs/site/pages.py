#!/usr/bin/env python3
"""pages.py PROGRAM FOLDER [--pictures] - lays out the sources of the documentation site in FOLDER/source.

They are the pages of docs/ as they are, but for their links: what points into the tree outside of the site becomes plain
text, cases get pages of their own. Beside them a gallery of all cases and the headers of the SDK. Without --pictures the
gallery shows pictures that are there already.
"""
import concurrent.futures
import html
import os
import re
import shutil
import sys

import api
import pictures

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MATHJAX = "/usr/share/javascript/mathjax"
PARTS = [  # of the table of contents; pages that are named nowhere come last
    ("Use", ["install", "running", "watch", "cluster", "editor", "repository"]),
    ("Cases", ["gallery/index", "tutorial", "cases", "keys", "lua"]),
    ("Results", ["output", "verification", "reliability", "scaling"]),
    ("Method", ["numerics", "thermodynamics"]),
    ("Modules and code", ["modules", "api/index", "extending", "walk", "decisions/index"]),
    ("Project", ["changelog", "contributing", "security", "release"]),
]
RENAMED = {"README.md": "index.md", "CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md",
           "SECURITY.md": "security.md"}
FOLDERS = {"tour": "Tour", "verify": "Verification", "tissue": "Tissue", "heating": "Heating", "hard": "Hard cases"}


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as stream:
        return stream.read()


def write(folder, path, text):
    full = os.path.join(folder, path)
    os.makedirs(os.path.dirname(full), exist_ok=True)
    with open(full, "w", encoding="utf-8") as stream:
        stream.write(text)


def place(path):
    """Where a file of the tree stands in the site, or None."""
    if path in RENAMED:
        return RENAMED[path]
    if path.startswith("docs/site"):
        return None
    if path == "docs/decisions":
        return "decisions/index.md"
    if path.startswith("docs/"):
        return path[len("docs/"):]
    if re.fullmatch(r"cases/\w+/[\w.-]+\.yaml", path):
        return "gallery/" + path[len("cases/"):-len(".yaml")] + ".md"
    return None


def links(text, path, here):
    """Text of a page with its links as the site has them; `path` in the tree, `here` in the site."""
    folder, own = os.path.dirname(path), os.path.dirname(here)

    def follow(match):
        words, target = match[1], match[2]
        if re.match(r"[a-z]+:", target) or target.startswith("#"):
            return match[0]
        target, hash_sign, anchor = target.partition("#")
        to = place(os.path.normpath(os.path.join(folder, target)))
        if to is None:
            return words.lstrip("[").rstrip("]") if "`" in words else words.strip("[]")
        return f"{words}({os.path.relpath(to, own or '.')}{hash_sign}{anchor})"

    pieces = re.split(r"(^```.*?^```[ \t]*$)", text, flags=re.M | re.S)
    for i in range(0, len(pieces), 2):
        pieces[i] = re.sub(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\])\(([^)\s]+)\)", follow, pieces[i])
    fences = {"math": "{math}", "csv": "text"}  # words that Sphinx has other names for
    return "".join(re.sub(r"\A```(math|csv)$", lambda found: "```" + fences[found[1]], piece, flags=re.M)
                   for piece in pieces)


def documents(folder):
    """Pages of the tree; their names without suffix, with the title of each."""
    names = {}
    sources = list(RENAMED)
    for top, folders, files in os.walk(os.path.join(ROOT, "docs")):
        folders[:] = [name for name in folders if name not in ("site", "images")]
        sources += [os.path.relpath(os.path.join(top, name), ROOT) for name in files if name.endswith(".md")]
    for path in sorted(sources):
        here = place(path)
        text = links(read(path), path, here)
        if here != "index.md":
            write(folder, here, text)
        names[here[:-len(".md")]] = text
    shutil.copytree(os.path.join(ROOT, "docs/images"), os.path.join(folder, "images"))
    return names


def toctree(names, caption="", depth=1, hidden=True):
    options = [f":caption: {caption}"] * bool(caption) + [f":maxdepth: {depth}"] + [":hidden:"] * hidden
    return "\n".join(["```{toctree}", *options, "", *names, "```", ""])


def cases():
    """Scenes of cases/, {folder/name: path}; files without a domain are parts of others."""
    found = {}
    for part in sorted(os.listdir(os.path.join(ROOT, "cases"))):
        folder = os.path.join(ROOT, "cases", part)
        if os.path.isdir(folder):
            for file in sorted(os.listdir(folder)):
                if file.endswith(".yaml"):
                    found[f"{part}/{file[:-len('.yaml')]}"] = os.path.join(folder, file)
    return found


def case_page(name, scene, source, picture):
    """Markdown of a case: what it is, its picture, how it is run, its text."""
    path = f"cases/{name}.yaml"
    out = ["---\norphan: true\n---\n", f"# {scene.get('title', name)}\n",
           f"[Gallery](../index.md) / {FOLDERS.get(name.split('/')[0], name.split('/')[0])}\n"]
    if picture:
        title = html.escape(scene.get("title", name))
        out.append(f'```{{raw}} html\n<img src="../../_static/pictures/{picture}" alt="{title}">\n```\n')
    out.append(f"{scene.get('about', '')}\n")
    if "cite" in scene:
        out.append(f"*{scene['cite']}*\n")
    quick = " --variant quick" if re.search(r"^quick:", source, re.M) or picture else ""
    out.append(f"    bulla run {path}\n")
    if quick:
        out.append(f"In seconds, on a coarse mesh{' (the picture shows its end)' if picture else ''}:\n\n"
                   f"    bulla run {path}{quick}\n")
    out.append(f"`{path}`:\n\n```yaml\n{source.rstrip()}\n```\n")
    return "\n".join(out)


def card(name, scene, picture):
    image = f'<img src="../_static/pictures/{picture}" alt="" loading="lazy">' if picture else "<span>no picture</span>"
    title = html.escape(scene.get("title", name))
    return (f'<a href="{name}.html"><span class="frame">{image}</span><span class="name">{name}</span>'
            f'<span class="title">{title}</span></a>')


def gallery(program, folder, store, draw):
    """The gallery and a page for each case."""
    found, cards = cases(), {}
    drawn = pictures.make(program, found, store) if draw else {}
    static = os.path.join(folder, "_static/pictures")
    os.makedirs(static, exist_ok=True)
    for file in drawn.values():
        shutil.copy(os.path.join(store, file), static)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        texts = pool.map(lambda path: pictures.show(program, path, None), found.values())
    for (name, path), text in zip(found.items(), texts):
        if text is None:
            continue  # a part of other cases
        scene = pictures.load(text)
        write(folder, f"gallery/{name}.md", case_page(name, scene, read(path), drawn.get(name)))
        cards.setdefault(name.split("/")[0], []).append((name, card(name, scene, drawn.get(name))))
    out = ["# Gallery\n", "All cases of the tree, with the picture of a quick run and the command that makes it.\n"]
    order = sorted(cards, key=lambda part: (list(FOLDERS) + [part]).index(part))
    for part in order:
        inside = "\n".join(text for _, text in cards[part])
        out.append(f"## {FOLDERS.get(part, part)}\n\n```{{raw}} html\n<div class=\"gallery\">\n{inside}\n</div>\n```\n")
    write(folder, "gallery/index.md", "\n".join(out))


def sdk(folder):
    """A page for each header of the SDK."""
    top = os.path.join(ROOT, "core/include/bulla")
    names = sorted(name for name in os.listdir(top) if name.endswith(".h"))
    names.sort(key=lambda name: name != "module.h")
    for name in names:
        write(folder, f"api/{name[:-2]}.md", api.page(f"bulla/{name}", read(f"core/include/bulla/{name}")))
    text = ("# Headers of the SDK\n\nWhat a module sees of bulla, and all it needs to be built: the headers of "
            "`core/include/bulla`. [Modules](../modules.md) tells how to write one.\n\n")
    write(folder, "api/index.md", text + toctree([name[:-2] for name in names], hidden=False))


def index(folder, names):
    """The front page: the README and the table of contents."""
    listed = {name for _, part in PARTS for name in part} | {"index"}
    rest = sorted(name for name in names if name not in listed and "/" not in name)
    parts = PARTS + ([("More", rest)] if rest else [])
    write(folder, "index.md", names["index"] + "\n" + "\n".join(toctree(part, title) for title, part in parts))
    decisions = sorted(name[len("decisions/"):] for name in names if name.startswith("decisions/"))
    write(folder, "decisions/index.md", "# Decisions\n\nWhy things are as they are, with figures.\n\n" +
          toctree(decisions, hidden=False))


def extras(folder):
    """What pages need and Sphinx does not make."""
    static = os.path.join(folder, "_static")
    os.makedirs(static, exist_ok=True)
    shutil.copy(os.path.join(HERE, "site.css"), static)
    shutil.copy(os.path.join(HERE, "conf.py"), folder)
    mathjax = os.path.join(static, "mathjax")
    for part in ("MathJax.js", "config/TeX-AMS_CHTML.js", "jax/element", "jax/input/TeX", "jax/output/CommonHTML",
                 "extensions", "localization/en", "fonts/HTML-CSS/TeX/woff"):
        source, to = os.path.join(MATHJAX, part), os.path.join(mathjax, part)
        os.makedirs(os.path.dirname(to), exist_ok=True)
        if os.path.isdir(source):
            shutil.copytree(source, to)
        elif os.path.exists(source):
            shutil.copy(source, to)


def main():
    program, folder = sys.argv[1], sys.argv[2]
    source = os.path.join(folder, "source")
    shutil.rmtree(source, ignore_errors=True)
    names = documents(source)
    gallery(program, source, os.path.join(folder, "pictures"), "--pictures" in sys.argv)
    sdk(source)
    index(source, names)
    extras(source)


if __name__ == "__main__":
    main()
