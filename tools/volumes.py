#!/usr/bin/env python3
"""Writes volume data for figures, as app/volume reads it: tools/volumes.py FOLDER makes cube.yaml, breast.yaml and organ0.yaml to organ3.yaml there."""
import array
import math
import os
import sys

SIDE = 64
CELL = 1 / (SIDE - 1)
CORNER = (-0.5, 0, -0.5)  # m: they fill a box of 1 m

# Each organ is the sum of Gaussian blobs (x, y, z, radius), m, which is 1 at its surface. Neighbours overlap.
ORGANS = [
    [(-0.18, 0.62, 0, 0.15), (-0.20, 0.45, 0.02, 0.16)],                             # lungs
    [(0.18, 0.62, 0, 0.15), (0.20, 0.45, 0.02, 0.16)],
    [(0.03, 0.52, 0.08, 0.09), (0.07, 0.45, 0.10, 0.08)],                            # heart
    [(-0.12, 0.27, 0.03, 0.13), (0.02, 0.25, 0.03, 0.10), (0.15, 0.24, 0.02, 0.07)],  # liver
]


def write(folder, name, size, spacing, values):
    with open(os.path.join(folder, name + '.raw'), 'wb') as file:
        array.array('f', values).tofile(file)
    with open(os.path.join(folder, name + '.yaml'), 'w', encoding='utf-8') as file:
        file.write(f'file: {name}.raw\nsize: {[size] * 3}\ntype: float32\nspacing: {[spacing] * 3}\ncorner: {list(CORNER)}\n'
                   f'byte_order: {sys.byteorder}\n')


def bell(at, middle, radius):
    """exp(1 - (r / radius)^2), 1 at the radius, as its factor for one axis; all three carry a third of the 1."""
    return math.exp(1 / 3 - ((at - middle) / radius) ** 2)


def organ(blobs):
    axes = [[[bell(CORNER[k] + CELL * i, blob[k], blob[3]) for i in range(SIDE)] for k in range(3)] for blob in blobs]
    return [sum(x[i] * y[j] * z[k] for x, y, z in axes) for k in range(SIDE) for j in range(SIDE) for i in range(SIDE)]


def breast(x, y, z):
    """0.7 at the skin, 1.4 within, 2 and more in the glands, which lead to the tip, 4 in a lump."""
    out = math.sqrt((x / 0.38) ** 2 + ((y - 0.5) / 0.4) ** 2 + ((z + 0.4) / 0.72) ** 2)
    value = 1.4 / (1 + math.exp(10 * (out - 1))) + 0.7 * math.exp(-(x * x + (y - 0.5) ** 2 + (z - 0.33) ** 2) / 0.05 ** 2)
    for lobe in range(9):
        turn = 2.4 * lobe  # the golden angle, in circles that grow
        wide = 0.09 + 0.017 * lobe
        for step in range(1, 5):
            part = step / 4
            at = wide * part * math.cos(turn), 0.5 + wide * part * math.sin(turn), 0.26 - 0.42 * part
            away = (x - at[0]) ** 2 + (y - at[1]) ** 2 + (z - at[2]) ** 2
            value += (0.1 + part) * math.exp(-away / (0.03 + 0.035 * part) ** 2)
    return value + 4 * math.exp(-((x - 0.13) ** 2 + (y - 0.63) ** 2 + (z + 0.02) ** 2) / 0.055 ** 2)


def main():
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        sys.exit('usage: tools/volumes.py FOLDER, which is there')
    folder = sys.argv[1]
    side, cell = 40, 1 / 39
    axis = [cell * i for i in range(side)]
    write(folder, 'breast', side, cell, [breast(x + CORNER[0], y + CORNER[1], z + CORNER[2]) for z in axis for y in axis for x in axis])
    write(folder, 'cube', 2, 1, [0, 1, 1, 0.1, 1, 0, 0.2, 1])  # x runs fastest
    for number, blobs in enumerate(ORGANS):
        write(folder, f'organ{number}', SIDE, CELL, organ(blobs))


main()
