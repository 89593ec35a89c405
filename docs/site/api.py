"""api.py - a page of the SDK out of a header: its comments are the text, what they stand before is the code.

The first comment is the introduction. Every comment at the margin begins a piece; the members of a struct that have a
comment of their own before them (functions, mostly) are pieces of that struct. Comments behind members stay in the code.
"""
import re

TOP = re.compile(r"/\*(.*?)\*/[ \t]*\n", re.S)
NAME = re.compile(r"^(?:extern .*?)?(struct|enum)\s+(\w+)\s*\{|^#define\s+(\w+)|^(extern)\b.*?(\w+);", re.M)
SLOT = re.compile(r"\(\*(\w+)\)\(|(\w+)(?:\[[^]]*\])?;")


def prose(comment):
    """The text of a comment, without its stars."""
    lines = [re.sub(r"^\s*\*? ?", "", line) for line in comment.strip().split("\n")]
    return "\n".join(lines).strip()


def escape(text):
    """Markdown of plain text: names with stars and underscores are code, formulas keep their characters."""
    text = re.sub(r"(?<![`\w])([A-Za-z_]\w*_\w*(?:\(\))?\*?|\w+\*)(?![`\w*])", r"`\1`", text)
    return re.sub(r"(?<!`)([<>\[\]])(?!`)", r"\\\1", text)


def paragraphs(comment):
    """Prose; lines that are indented in the comment are code."""
    out = []
    for block in re.split(r"\n\s*\n", prose(comment)):
        lines = block.split("\n")
        for i, line in enumerate(lines):
            if line.startswith("    "):
                lines[i] = "\n    " + line.strip() + "\n"
            else:
                lines[i] = escape(line)
        out.append("\n".join(lines))
    return "\n\n".join(out)


def wrap(line, width=92):
    """A line of code that fits the page: long lists of arguments go on below their first."""
    if len(line) <= width or "/*" in line or ", " not in line[:width]:
        return line
    cut = line.rindex(", ", 0, width) + 1
    indent = max(line.rfind("(", 0, line.index(", ")) + 1, len(line) - len(line.lstrip()))
    return line[:cut] + "\n" + wrap(" " * indent + line[cut + 1:], width)


def code(text):
    """A block of C, shifted to the margin."""
    lines = text.strip("\n").split("\n")
    indent = min((len(l) - len(l.lstrip()) for l in lines if l.strip()), default=0)
    return "```c\n" + "\n".join(wrap(l[indent:].rstrip()) for l in lines) + "\n```\n"


def members(body):
    """Splits the inside of a struct: (comment or None, code), a blank line or a comment of its own begins a piece."""
    pieces, comment, lines = [], None, []

    def close():
        if comment or any(l.strip() for l in lines):
            pieces.append((comment, "\n".join(lines)))

    text = body.split("\n")
    i = 0
    while i < len(text):
        line = text[i]
        if line.strip().startswith("/*"):
            close()
            held = [line]
            while "*/" not in text[i]:
                i += 1
                held.append(text[i])
            comment, lines = re.sub(r"^\s*/\*|\*/\s*$", "", "\n".join(held)), []
        elif not line.strip() and comment:
            close()
            comment, lines = None, []
        else:
            lines.append(line)
        i += 1
    close()
    return pieces


def struct(name, text):
    """A struct: all of it where no member has a comment of its own, else member by member."""
    start, end = text.index("{") + 1, text.rindex("}")
    pieces = members(text[start:end])
    if not any(comment for comment, _ in pieces):
        return code(text)
    out = []
    for comment, inside in pieces:
        slot = SLOT.search(inside)
        if comment and slot:
            out.append(f"### {name}.{slot[1] or slot[2]}\n")
        if comment:
            out.append(paragraphs(comment) + "\n")
        if inside.strip():
            out.append(code(inside))
    return "\n".join(out)


def declarations(text):
    """(comment or None, code) of what stands at the margin, without what only the preprocessor needs."""
    text = re.sub(r"#ifdef __cplusplus\n.*?#endif\n", "", text, flags=re.S)
    text = re.sub(r"^#(ifndef BULLA_\w+_H|define BULLA_\w+_H|include .*)\n", "", text, flags=re.M)
    text = re.sub(r"#endif\s*\Z", "", text)
    at, comment, out = 0, None, []
    for match in re.finditer(r"^/\*(.*?)\*/[ \t]*\n", text, re.S | re.M):
        out.append((comment, text[at:match.start()]))
        comment, at = match[1], match.end()
    out.append((comment, text[at:]))
    return [(c, t.strip("\n")) for c, t in out if c or t.strip()]


def page(name, text):
    """The Markdown of a header's page."""
    head = TOP.match(text)
    title, _, rest = prose(head[1]).partition("\n")
    what = escape(title.partition(" - ")[2])
    out = [f"# {name}\n", what[:1].upper() + what[1:] + "\n", paragraphs(rest) + "\n"]
    for comment, inside in declarations(text[head.end():]):
        pieces = re.split(r"\n\n(?=\S)", inside)
        for i, piece in enumerate(pieces):
            found = NAME.search(piece)
            kind, label = (found[1], found[2] or found[3] or found[5]) if found else (None, None)
            if label:
                out.append(f"## {kind + ' ' if kind else ''}{label}\n")
            if comment and i == 0:
                out.append(paragraphs(comment) + "\n")
            if piece.strip():
                out.append(struct(label, piece) if kind == "struct" else code(piece))
    return "\n".join(out)
