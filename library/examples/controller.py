#!/usr/bin/env python3
"""A controller of the box: a tank is driven to the side, and a loop of one's own moves it so that the water sloshes less.

controller.py [PARTICLES]    prints how far the water swings afterwards, without and with the controller
"""
import sys

import slosh

particles = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
TARGET, DRIVE, END = 0.4, 0.8, 4.0  # m, s, s
RATE = 2.0  # 1/s: the box runs after the water as fast as the water leans; in its own frame that is a damper


def swing(rate):
    world = slosh.World("box_slosh", {"particles": particles, "motion": []}, tell=str)
    least, most, way, before = 0.0, 0.0, 0.0, 0.0
    while world.time < END:
        lean = float(world.position[:, 0].mean())  # m, of the centre of mass, from the middle of the box
        way += rate * lean * (world.time - before)
        before = world.time
        world.move_box((TARGET * min(world.time / DRIVE, 1) + way, 0, 0))
        world.step()
        if world.time > END / 2:
            least, most = min(least, lean), max(most, lean)
    return most - least


free, damped = swing(0), swing(RATE)
print(f"without: {1000 * free:.1f} mm")
print(f"with:    {1000 * damped:.1f} mm")
