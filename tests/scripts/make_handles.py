#!/usr/bin/env python3
"""Writes closed surfaces with many handles or a knot, as OFF: make_handles.py plate HOLES SIDES | knot P Q STEPS SIDES.

`plate` is a plate with HOLES x HOLES square holes, each unit square of its surface cut into SIDES x SIDES x 2 triangles,
and bent a little so that no two of its points have a coordinate in common: genus HOLES^2. `knot` is a tube of SIDES sides
around the torus knot (P, Q), in STEPS steps: genus 1. What `sesame mesh` takes for them is in replay/FORMAT.md.
"""
import math
import sys


def bent(x, y, z):
    return x + 0.05 * math.sin(1.3 * y + z), y + 0.05 * math.sin(1.7 * z + x), z + 0.1 * math.sin(0.7 * x + 0.9 * y)


def plate(holes, sides):
    width = 2 * holes + 1

    def is_full(x, y, z):
        return 0 <= x < width and 0 <= y < width and z == 0 and not (x % 2 and y % 2)

    numbers, points, faces = {}, [], []

    def number(point):
        if point not in numbers:
            numbers[point] = len(points)
            points.append(bent(*(c / sides for c in point)))
        return numbers[point]

    for x, y in ((x, y) for x in range(width) for y in range(width) if is_full(x, y, 0)):
        for axis in range(3):
            for step in (0, 1):
                beside = [x, y, 0]
                beside[axis] += 2 * step - 1
                if is_full(*beside):
                    continue
                for u in range(sides):
                    for v in range(sides):
                        square = []
                        for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                            point = [x * sides, y * sides, 0]
                            point[axis] += step * sides
                            point[(axis + 1) % 3] += u + du
                            point[(axis + 2) % 3] += v + dv
                            square.append(number(tuple(point)))
                        a, b, c, d = square if step else square[::-1]
                        faces += [(a, b, c), (a, c, d)]
    return points, faces


def knot(p, q, steps, sides):
    def at(t):
        r = 2 + math.cos(q * t)
        return r * math.cos(p * t), r * math.sin(p * t), -math.sin(q * t)

    def unit(v):
        length = math.sqrt(sum(x * x for x in v))
        return [x / length for x in v]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

    points, faces = [], []
    for i in range(steps):
        t = 2 * math.pi * i / steps
        here, ahead = at(t), at(t + 1e-4)
        tangent = unit([y - x for x, y in zip(here, ahead)])
        # Across the tube: away from the circle that the knot winds around, so that the frame closes up.
        circle = (2 * math.cos(p * t), 2 * math.sin(p * t), 0)
        other = unit(cross(tangent, [x - y for x, y in zip(here, circle)]))
        normal = cross(other, tangent)
        for j in range(sides):
            c, s = math.cos(2 * math.pi * j / sides), math.sin(2 * math.pi * j / sides)
            points.append([x + 0.2 * (c * n + s * o) for x, n, o in zip(here, normal, other)])
            corner = [(i + di) % steps * sides + (j + dj) % sides for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces += [(corner[0], corner[1], corner[2]), (corner[0], corner[2], corner[3])]
    return points, faces


def main():
    kind, numbers = sys.argv[1], [int(x) for x in sys.argv[2:]]
    points, faces = {"plate": plate, "knot": knot}[kind](*numbers)
    print(f"OFF\n{len(points)} {len(faces)} 0")
    for point in points:
        print(*point)
    for face in faces:
        print(3, *face)


if __name__ == "__main__":
    main()
