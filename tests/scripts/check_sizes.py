#!/usr/bin/env python3
"""Checks that files and classes stay small enough to be read: check_sizes.py [ROOT].

A source file has at most 400 lines, a class at most 30 public functions (overloads counted each). What is larger is named
below with its size and why; it may shrink, and the entry with it, but not grow. Exit status 1 and a line per violation.
"""
import re
import sys
from pathlib import Path

FOLDERS = ["sparse", "reductions", "ops", "engine", "replay", "tools"]
LINES, FUNCTIONS = 400, 30

# File: (lines, why).
LARGE_FILES = {
}
# Class: (public functions, why).
LARGE_CLASSES = {
}

TOKENS = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)
HEAD = re.compile(r"\b(class|struct)\s+(?:\[\[\w+\]\]\s*)?(\w+)\s*(?:final\s*)?(?::[^;{(]*)?$")


def without_comments(text):
    """Comments and literals away, so that brackets count; #include and #define lines too."""
    text = TOKENS.sub(lambda m: '""' if m[0][0] in "\"'R" else " ", text)
    return re.sub(r"^\s*#.*(?:\\\n.*)*$", "", text, flags=re.M)


def is_function(statement):
    """Whether what stands before a `;` or a body at class level declares a function."""
    statement = re.sub(r"\[\[.*?\]\]", "", statement).strip()
    if not statement or re.match(r"(using|friend|static_assert|typedef|enum|class|struct)\b", statement):
        return False
    head = re.split(r"=(?!=)", re.sub(r"operator\s*[^\s(]+", "operator_", statement), maxsplit=1)[0]
    return "(" in head and "= delete" not in statement and "= default" not in statement


def public_functions(text):
    """Per class name, the number of public functions that it declares itself."""
    counts = {}
    open_scopes = []  # [class name or None, is public now]
    statement = ""
    depth_of_parentheses = 0
    for char in without_comments(text):
        if char in "([":
            depth_of_parentheses += 1
        elif char in ")]":
            depth_of_parentheses -= 1
        if depth_of_parentheses == 0 and char in "{};:":
            inside = open_scopes[-1] if open_scopes else None
            if char == ":":
                word = statement.strip()
                if inside and word in ("public", "private", "protected"):
                    inside[1], statement = word == "public", ""
                    continue
            elif char == "}":
                if open_scopes:
                    open_scopes.pop()
                statement = ""
                continue
            else:
                if inside and inside[0] and inside[1] and is_function(statement):
                    counts[inside[0]] = counts.get(inside[0], 0) + 1
                if char == "{":
                    head = HEAD.search(re.sub(r"\s+", " ", statement).strip())
                    is_class = head and not re.search(r"\benum\b", statement) and "(" not in statement.split(head[0])[0]
                    open_scopes.append([head[2], head[1] == "struct"] if is_class else [None, False])
                statement = ""
                continue
        statement += char
    return counts


def main(root):
    files = sorted(f for folder in FOLDERS for f in (root / folder).rglob("*") if f.suffix in (".hpp", ".cpp"))
    if not files:
        print(f"{root}: no source files below {', '.join(FOLDERS)}", file=sys.stderr)
        return 2
    found = []

    def compare(what, size, limit, allowed, unit):
        most, why = allowed.get(what, (limit, ""))
        if size > most:
            found.append(f"{what} has {size} {unit}, more than {most}" + (f" (allowed: {why})" if why else ""))
        elif what in allowed and size <= limit:
            found.append(f"{what} has {size} {unit} and needs no exception any more")

    for file in files:
        text, name = file.read_text(encoding="utf-8"), str(file.relative_to(root))
        compare(name, text.count("\n"), LINES, LARGE_FILES, "lines")
        if file.suffix == ".hpp":
            for each, count in public_functions(text).items():
                compare(each, count, FUNCTIONS, LARGE_CLASSES, "public functions")
    for name in LARGE_FILES:
        if not (root / name).exists():
            found.append(f"{name} is an exception, and no file")
    print("\n".join([*found, f"{len(files)} files, {len(found)} too large"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()))
