#!/usr/bin/env python3
"""A comparison with theory: fluid between two plates begins to run, beside the series of Poiseuille's flow.

theory.py [ACROSS]    particles between the plates; prints the speed in the middle, and the greatest difference
"""
import sys

import numpy

import slosh

across = int(sys.argv[1]) if len(sys.argv) > 1 else 25
HEIGHT, FORCE, NU = 1.0, 0.8, 0.1  # m, m/s2, m2/s: of the scene


def exact(y, time):
    """After: J. Morris, P. Fox, Y. Zhu, "Modeling low Reynolds number incompressible flows using SPH", 1997, eq. 21."""
    speed = FORCE / (2 * NU) * y * (HEIGHT - y)
    for n in range(1, 40, 2):
        k = n * numpy.pi / HEIGHT
        speed -= 4 * FORCE / (NU * HEIGHT * k**3) * numpy.sin(k * y) * numpy.exp(-NU * k**2 * time)
    return speed


world = slosh.World("poiseuille", {"particles.spacing": HEIGHT / across}, tell=str)
for until in (0.25, 0.5, 1.0):
    world.run(until)
    y, speed = world.position[:, 1], world.velocity[:, 0]
    theory = exact(y, world.time)
    print(f"{world.time:.2f} s: middle {theory.max():.3f} m/s, greatest difference {100 * abs(speed - theory).max() / theory.max():.1f} %")
