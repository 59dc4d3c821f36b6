#!/usr/bin/python3
"""tools/models.py [FOLDER]: makes the meshes of scenes/meshes: a rabbit, a bust, a duck, a ship, each 1 high on the floor
y = 0, and the wheel of a mill, 1 across.

They are our own. All but the wheel are ellipsoids that melt into each other (I. Quilez, "Smooth minimum" and "Distance to an ellipsoid"), whose
surface is found by surface nets (S. Gibson, "Constrained elastic surface nets", 1998): in each cell of a grid that the
surface passes a vertex, around each edge of the grid that it crosses a face of four."""
import itertools
import math
import pathlib
import struct
import sys


def ellipsoid(centre, radii, tilt=0.0, roll=0.0):
    """Turned by `tilt` degrees about z, after `roll` about x."""
    c, s, d, t = (f(math.radians(a)) for a in (tilt, roll) for f in (math.cos, math.sin))

    def distance(x, y, z):
        x, y, z = x - centre[0], y - centre[1], z - centre[2]
        x, y = c * x + s * y, c * y - s * x
        y, z = d * y + t * z, d * z - t * y
        a, b, e = x / radii[0], y / radii[1], z / radii[2]
        k0 = math.sqrt(a * a + b * b + e * e)
        k1 = math.sqrt((a / radii[0])**2 + (b / radii[1])**2 + (e / radii[2])**2)
        return k0 * (k0 - 1) / k1 if k1 > 1e-9 else -min(radii)
    return distance


def disc(y, radius, half, round_):
    """A cylinder along y with round edges."""
    def distance(x, h, z):
        side, end = math.hypot(x, z) - radius + round_, abs(h - y) - half + round_
        return math.hypot(max(side, 0), max(end, 0)) + min(max(side, end), 0) - round_
    return distance


def melt(a, b, width):
    h = max(width - abs(a - b), 0) / width
    return min(a, b) - h * h * width / 4


def pair(centre, radii, tilt=0.0, roll=0.0):
    """The same on both sides of the plane z = 0."""
    x, y, z = centre
    return [ellipsoid((x, y, z), radii, tilt, roll), ellipsoid((x, y, -z), radii, tilt, -roll)]


def twins(centre, radii):
    """The same on both sides of the plane x = 0."""
    x, y, z = centre
    return [ellipsoid((x, y, z), radii), ellipsoid((-x, y, z), radii)]


def rabbit():
    """Sits, looks along x."""
    parts = [(0.08, ellipsoid((-0.04, 0.27, 0), (0.27, 0.24, 0.2), 25)), (0.08, ellipsoid((0.12, 0.33, 0), (0.16, 0.2, 0.15))),
             (0.06, ellipsoid((0.22, 0.57, 0), (0.15, 0.125, 0.115), -15)), (0.05, ellipsoid((0.33, 0.53, 0), (0.075, 0.065, 0.07))),
             (0.04, ellipsoid((-0.31, 0.2, 0), (0.085, 0.085, 0.085)))]
    parts += [(0.05, part) for part in pair((-0.1, 0.17, 0.14), (0.17, 0.165, 0.09), 15)]     # haunches
    parts += [(0.04, part) for part in pair((0.02, 0.045, 0.15), (0.17, 0.05, 0.06))]         # hind feet
    parts += [(0.05, part) for part in pair((0.19, 0.17, 0.08), (0.055, 0.16, 0.05), 8)]      # forelegs
    parts += [(0.03, part) for part in pair((0.24, 0.04, 0.08), (0.085, 0.045, 0.05))]        # paws
    parts += [(0.03, part) for part in pair((0.27, 0.545, 0.065), (0.06, 0.055, 0.05))]       # cheeks
    parts += [(0.035, part) for part in pair((0.1, 0.81, 0.075), (0.05, 0.2, 0.036), 18, -8)]  # ears
    return parts, [(0.02, part) for part in pair((0.275, 0.6, 0.125), (0.028, 0.028, 0.028))]  # eyes


def bust():
    """Looks along z, on a plinth."""
    parts = [(0.02, disc(0.05, 0.19, 0.05, 0.015)), (0.03, disc(0.13, 0.11, 0.05, 0.02)),
             (0.05, ellipsoid((0, 0.3, 0), (0.27, 0.15, 0.15))), (0.05, ellipsoid((0, 0.31, 0.05), (0.2, 0.12, 0.13))),
             (0.06, ellipsoid((0, 0.46, -0.015), (0.082, 0.16, 0.088))),
             (0.05, ellipsoid((0, 0.76, -0.01), (0.145, 0.175, 0.175))), (0.05, ellipsoid((0, 0.655, 0.05), (0.105, 0.12, 0.115))),
             (0.03, ellipsoid((0, 0.785, 0.135), (0.1, 0.028, 0.045))), (0.025, ellipsoid((0, 0.715, 0.18), (0.026, 0.06, 0.042))),
             (0.015, ellipsoid((0, 0.637, 0.16), (0.045, 0.016, 0.03))), (0.02, ellipsoid((0, 0.575, 0.125), (0.045, 0.035, 0.045))),
             (0.03, ellipsoid((0, 0.83, -0.045), (0.158, 0.145, 0.17))), (0.04, ellipsoid((0, 0.83, -0.235), (0.085, 0.085, 0.075)))]
    parts += [(0.06, part) for part in twins((0.27, 0.33, 0), (0.12, 0.115, 0.115))]          # shoulders
    parts += [(0.02, part) for part in twins((0.145, 0.715, -0.01), (0.024, 0.055, 0.038))]   # ears
    cuts = [(0.02, part) for part in twins((0.058, 0.745, 0.185), (0.036, 0.026, 0.03))]      # eye sockets
    return parts, cuts


def duck():
    """Swims along x."""
    parts = [(0.05, ellipsoid((0, 0.28, 0), (0.62, 0.28, 0.52))), (0.12, ellipsoid((-0.55, 0.44, 0), (0.17, 0.1, 0.16), -35)),
             (0.1, ellipsoid((0.24, 0.56, 0), (0.12, 0.18, 0.12))), (0.05, ellipsoid((0.26, 0.82, 0), (0.19, 0.17, 0.17))),
             (0.04, ellipsoid((0.46, 0.79, 0), (0.12, 0.04, 0.09), 10))]
    parts += [(0.05, part) for part in pair((-0.1, 0.4, 0.42), (0.26, 0.13, 0.1), 15)]        # wings
    return parts, []


def block(centre, half):
    def distance(*x):
        d = [abs(i - c) - h for i, c, h in zip(x, centre, half)]
        return math.hypot(*(max(i, 0) for i in d)) + min(max(d), 0)
    return distance


def hull(x, y, z):
    """Of a boat 3 long, whose bow is at x = 1.5; its stern is cut off."""
    along = max(-1.0, min(1.0, x / 1.5))
    wide = 0.68 * (1 - max(along, 0)**2.5) * (1 - 0.25 * min(along, 0)**2)
    deck, low = 0.62 + 0.16 * along * along, max(y, 0.0) / 0.7
    side = abs(z) - wide * min(low, 1.0)**0.4
    return -melt(-max(0.8 * side, -1.4 - x, x - 1.5), deck - y, 0.14)  # a rim as round as the grid can show


def ship():
    return [(0.02, hull), (0.03, block((-0.45, 0.75, 0), (0.5, 0.16, 0.26))), (0.02, block((-0.65, 0.9, 0), (0.22, 0.1, 0.2)))], []


def wheel(paddles=10, hub=0.2, width=0.13, half=0.16):
    """Turns about z: a star, whose every side is a plane, between its two faces."""
    ring = []
    for i in range(paddles):
        angle, root = 2 * math.pi * i / paddles, math.asin(0.5 * width / 2 / hub)
        tip = math.asin(0.5 * width / 2 / 0.5)
        ring += [(r * math.cos(angle + a), r * math.sin(angle + a)) for r, a in ((hub, -root), (0.5, -tip), (0.5, tip), (hub, root))]
    n = len(ring)
    vertices = [(x, y, z) for z in (-half, half) for x, y in ring] + [(0, 0, -half), (0, 0, half)]
    faces = []
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, n + j, n + i), (j, i, 2 * n), (n + i, n + j, 2 * n + 1)]
    return vertices, faces


def field_of(parts, cuts):
    def distance(x, y, z):
        d = 1e9
        for width, part in parts:
            d = melt(d, part(x, y, z), width)
        for width, part in cuts:
            d = -melt(-d, part(x, y, z), width)
        return -melt(-d, y, 0.02)  # cut off at the floor
    return distance


CORNERS = list(itertools.product((0, 1), repeat=3))
EDGES = [(a, b) for a in CORNERS for b in CORNERS if a < b and sum(abs(i - j) for i, j in zip(a, b)) == 1]


def between(a, b, va, vb):
    t = va / (va - vb)
    return [i + t * (j - i) for i, j in zip(a, b)]


def surface(distance, low, high, cell):
    """Vertices, and faces of four that turn counter-clockwise seen from outside."""
    size = [math.ceil((h - l) / cell) + 1 for l, h in zip(low, high)]
    value = {at: distance(*(l + cell * i for l, i in zip(low, at))) for at in itertools.product(*map(range, size))}
    number, vertices, faces = {}, [], []
    for at in itertools.product(*(range(n - 1) for n in size)):
        corner = {c: value[tuple(i + j for i, j in zip(at, c))] for c in CORNERS}
        cut = [between(a, b, corner[a], corner[b]) for a, b in EDGES if (corner[a] < 0) != (corner[b] < 0)]
        if cut:
            number[at] = len(vertices)
            vertices.append([l + cell * (i + sum(c[k] for c in cut) / len(cut)) for k, (l, i) in enumerate(zip(low, at))])
    for at in itertools.product(*map(range, size)):
        for axis in range(3):
            end = tuple(i + (k == axis) for k, i in enumerate(at))
            if end not in value or (value[at] < 0) == (value[end] < 0):
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            around = [number[tuple(i - du * (k == u) - dv * (k == v) for k, i in enumerate(at))]
                      for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces.append(around if value[at] < 0 else around[::-1])
    return [settled(distance, x, cell) for x in vertices], faces


def settled(distance, x, cell):
    """On the surface itself, as far as the cell allows."""
    d, h = distance(*x), 1e-4
    slope = [(distance(*(i + h * (k == a) for k, i in enumerate(x))) - d) / h for a in range(3)]
    square = sum(s * s for s in slope)
    return [i - max(-0.4 * cell, min(0.4 * cell, d * s / square)) for i, s in zip(x, slope)] if square > 0.1 else x


def unit_high(vertices):
    low, high = min(v[1] for v in vertices), max(v[1] for v in vertices)
    return [[v[0] / (high - low), (v[1] - low) / (high - low), v[2] / (high - low)] for v in vertices]


def write_obj(path, title, vertices, faces):
    lines = [f'# {title}: made by tools/models.py; CC0'] + ['v ' + ' '.join(f'{x:.4f}' for x in v) for v in vertices]
    path.write_text('\n'.join(lines + ['f ' + ' '.join(str(i + 1) for i in face) for face in faces]) + '\n')


def write_ply(path, title, vertices, faces):
    head = ['ply', 'format binary_little_endian 1.0', f'comment {title}: made by tools/models.py; CC0',
            f'element vertex {len(vertices)}', *(f'property float {k}' for k in 'xyz'), f'element face {len(faces)}',
            'property list uchar int vertex_indices', 'end_header', '']
    path.write_bytes('\n'.join(head).encode() + b''.join(struct.pack('<3f', *v) for v in vertices)
                     + b''.join(struct.pack('<B4i', 4, *face) for face in faces))


def main():
    folder = pathlib.Path(sys.argv[1] if sys.argv[1:] else pathlib.Path(__file__).resolve().parents[1] / 'scenes/meshes')
    for title, model, write, low, high, cell in [
            ('rabbit', rabbit(), write_obj, (-0.46, -0.05, -0.32), (0.46, 1.06, 0.32), 0.026),
            ('bust', bust(), write_ply, (-0.46, -0.05, -0.36), (0.46, 1.02, 0.3), 0.021),
            ('duck', duck(), write_obj, (-0.83, -0.05, -0.62), (0.75, 1.06, 0.62), 0.05),
            ('ship', ship(), write_obj, (-1.5, -0.06, -0.78), (1.6, 1.06, 0.78), 0.06)]:
        vertices, faces = surface(field_of(*model), low, high, cell)
        path = folder / (title + ('.obj' if write is write_obj else '.ply'))
        write(path, title, unit_high(vertices), faces)
        print(f'{path.name}: {len(vertices)} vertices, {2 * len(faces)} triangles, {path.stat().st_size} bytes')
    write_obj(folder / 'wheel.obj', 'wheel', *wheel())


if __name__ == '__main__':
    main()
