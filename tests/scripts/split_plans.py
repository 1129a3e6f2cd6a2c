"""Fields `split` of `deidentify` steps, found from a state of the oracle.

Every function returns a list of entries, empty when there is nothing to split. `fresh` is a callable that gives a new
free name at every call.
"""

import itertools

import oracle


def entries(state, copies, moves):
    """The field itself. copies: key -> (cell, name of the copy); moves: key -> [(name, face number)]."""
    return [{"cell": state.cells[x].name, "as": name, "moves": [list(move) for move in moves.get(key, [])]}
            for key, (x, name) in copies.items()]


def users(state):
    """cell -> the cells that have it, or a degenerate cell on it, among their faces."""
    found = {c: set() for c in state.cells}
    for t in state.cells:
        for cell, _ in state.faces(t):
            found[cell].add(t)
    return found


def isolate(state, top, fresh, leave_closure=False):
    """Cuts the closure of a cell off from everything else; what is glued inside the closure stays so.

    Incidences inside the closure go to copies, or with leave_closure those outside do. A cell that is a face of others
    is copied itself.
    """
    closure = set(state.closure([top]))
    used_by = users(state)
    shared = set()
    pending = [x for x in closure if used_by[x] - closure]
    while pending:
        x = pending.pop()
        if x not in shared:
            shared.add(x)
            pending.extend(cell for cell, _ in state.faces(x))
    copies = {x: (x, fresh()) for x in sorted(shared)}
    moves = {}
    for t in state.alive():
        if t in shared:
            name = copies[t][1]
        elif (t in closure) == leave_closure:
            continue
        else:
            name = state.cells[t].name
        for number, face in enumerate(state.faces(t)):
            if face[0] in shared and not oracle.is_degenerate(face):
                moves.setdefault(face[0], []).append((name, number))
    return entries(state, copies, moves)


def corners(state, top):
    """The faces of the standard simploid, the largest first, each with the cell that it is in the object."""
    kind = state.cells[top].kind
    for subsets in sorted(itertools.product(*map(oracle.subsets, kind)), key=lambda s: (-sum(map(len, s)), s)):
        yield subsets, oracle.restrict(state.plain(top), subsets, state.faces)


def tear_out(state, top, fresh):
    """Makes a cell a standard simploid of its own: cut off from everything, nothing of its boundary glued.

    Of a face of other cells, a copy becomes that. Nothing is done when some face of a face is degenerate: no splitting
    makes it otherwise. Nor to a cell that is no simploid.
    """
    if not oracle.is_simploid(state.cells[top].kind):
        return []
    cells, shapes = {}, {}
    for subsets, value in corners(state, top):
        if oracle.is_degenerate(value):
            return []
        cells[subsets], shapes[subsets] = value
    used_by = users(state)
    keeps = set()  # the corners that stay what they are
    kept = set()
    copies = {}
    for subsets, x in cells.items():
        if x not in kept and used_by[x] <= kept:
            keeps.add(subsets)
            kept.add(x)
        else:
            copies[subsets] = (x, fresh())
    moves = {}
    for subsets, x in cells.items():
        name = state.cells[x].name if subsets in keeps else copies[subsets][1]
        number = 0
        for i, part in enumerate(subsets):
            if len(part) > 1:
                for j in range(len(part)):
                    below = subsets[:i] + (part[:j] + part[j + 1:],) + subsets[i + 1:]
                    if below not in keeps:
                        slot = oracle.slot_in_order(shapes[subsets], number)
                        moves.setdefault(below, []).append((name, slot))
                    number += 1
    return entries(state, copies, moves)


def link_classes(state, x):
    """The incidences of x in classes that no face law lets part, without those that cannot leave x at all.

    Every incidence gets a cell of its own in the place of x; what the laws then say of these cells is the answer.
    """
    own = {}
    classes = {x: x}

    def faces_of(cell):
        if isinstance(cell, tuple):
            return state.faces(x)
        marked = []
        for number, face in enumerate(state.faces(cell)):
            if face[0] == x and not oracle.is_degenerate(face):
                own[cell, number] = face = ((cell, number), face[1])
                classes.setdefault(face[0], face[0])
            marked.append(face)
        return marked

    def root(node):
        while classes[node] != node:
            node = classes[node]
        return node

    for u in state.alive():
        kind, below = state.cells[u].kind, faces_of(u)
        for (one, _), (two, _), _ in oracle.double_faces(kind, below, faces_of) if below else ():
            if one != two:
                classes[root(one)] = root(two)
    groups = {}
    for node in sorted(own):
        if root(node) != root(x):
            groups.setdefault(root(node), []).append(node)
    return list(groups.values())


def split_cell(state, x, incidences, fresh):
    """One copy that gets the listed incidences (cell, face number)."""
    return [{"cell": state.cells[x].name, "as": fresh(), "moves": [[state.cells[t].name, k] for t, k in incidences]}]


class Gluing:
    """What an identification did, so that it can be taken back later, when other things have happened since."""

    def __init__(self, before, after):
        self.gone = []  # canonical names of the cells that became others
        self.incidences = []  # (name, face number, name of the face) where the face is one of these
        for c, cell in before.cells.items():
            if c not in after.cells:
                self.gone.append(cell.name)
        for t, cell in before.cells.items():
            for number, face in enumerate(cell.faces):
                if face[0] not in after.cells and not oracle.is_degenerate(face):
                    self.incidences.append((cell.name, number, before.cells[face[0]].name))

    def undone(self, state, fresh):
        """Copies of the cells that went, with the incidences that they had, as far as these are still there."""
        here = [n for n in self.gone if state.names.get(n) and not oracle.is_degenerate(state.names[n])]
        copies = {name: (state.names[name][0], fresh()) for name in here}
        moves, seen = {}, set()
        for t, number, name in self.incidences:
            value = state.names.get(t)
            if name not in copies or not value or oracle.is_degenerate(value):
                continue
            owner = copies[t][1] if t in copies else state.cells[value[0]].name
            faces = state.faces(value[0])
            face = faces[number] if number < len(faces) else (None, ())
            if face[0] == copies[name][0] and not oracle.is_degenerate(face) and (owner, number) not in seen:
                seen.add((owner, number))
                moves.setdefault(name, []).append((owner, number))
        return entries(state, copies, moves)
