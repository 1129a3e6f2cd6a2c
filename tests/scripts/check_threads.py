#!/usr/bin/env python3
"""Checks that classes say what threads may do with them: check_threads.py [ROOT].

A class that says nothing is like a container of the standard library: its const functions may be called by several
threads at once while no other function is called, and different objects share nothing. A class with a mutable member
that is no mutex, and one that holds or reads such a class, is not like that, and says in its comment what holds for it,
with the word "Threads:" or "Thread-safe". Programs (tools/) have one thread. Exit status 1 and a line per violation.
"""
import re
import sys
from pathlib import Path

FOLDERS = ["sparse", "reductions", "ops", "engine", "replay"]
CLASS = re.compile(
    r"^(?P<comment>(?:///[^\n]*\n)*)(?:template[^\n]*\n)?"
    r"(?:class|struct) (?P<name>\w+)(?: final)?(?: : [^{;]*)? \{\n(?P<body>.*?)^\};", re.M | re.S)
MEMBER = re.compile(
    r"  (?!return|using|friend|static|//|explicit|virtual)(?P<type>[\w:<>,&* ]+?[\s&*])(?P<name>\w+)"
    r"(?: = .*|\{.*)?;(?:\s*//.*)?$", re.M)
SAYS = re.compile(r"Threads:|[Tt]hread-safe|any thread")


def classes_in(text):
    """(name, comment, the types of its data members) of each class at the outer level."""
    for found in CLASS.finditer(text):
        yield found["name"], found["comment"], [member["type"] for member in MEMBER.finditer(found["body"])]


def violations(classes):
    """`classes`: (where, name, comment, types of members). A line for each that should say something and does not."""
    unsafe = set()
    while True:
        found = {name for _, name, _, types in classes if any(is_unsafe(member, unsafe) for member in types)}
        if found <= unsafe:
            break
        unsafe |= found
    return [f"{where}: {name} has members that its const functions change, or reads a class that has, and its comment "
            "does not say what threads may do (\"Threads: one at a time, for queries too.\")"
            for where, name, comment, _ in classes if name in unsafe and not SAYS.search(comment)]


def is_unsafe(member, unsafe):
    words = set(re.findall(r"\w+", member))
    return ("mutable" in words and not any("mutex" in word for word in words)) or bool(words & unsafe)


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    classes = [(path.relative_to(root), *found) for folder in FOLDERS for path in sorted((root / folder).rglob("*.hpp"))
               for found in classes_in(path.read_text())]
    if len(classes) < 50:
        sys.exit(f"only {len(classes)} classes found: is {root} the root of the project?")
    lines = violations(classes)
    print("\n".join(lines) if lines else f"{len(classes)} classes say what threads may do with them")
    sys.exit(1 if lines else 0)


if __name__ == "__main__":
    main()
