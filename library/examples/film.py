#!/usr/bin/env python3
"""A film, frame by frame: the pictures go to ffmpeg.

film.py OUT.mp4 [SECONDS] [WIDTH HEIGHT]
"""
import subprocess
import sys

import slosh

out = sys.argv[1]
seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 2
width, height = (int(text) for text in sys.argv[3:5]) if len(sys.argv) > 4 else (640, 360)
FPS = 30

world = slosh.World("dam_break", tell=str)
picture = slosh.Picture(world, "splat", (width, height), {"view.color_by": "speed"})
film = subprocess.Popen(["ffmpeg", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}",
                         "-r", str(FPS), "-i", "-", "-pix_fmt", "yuv420p", out], stdin=subprocess.PIPE)
for frame in range(round(seconds * FPS)):
    world.run(until=frame / FPS)
    film.stdin.write(picture.draw().tobytes())
film.stdin.close()
sys.exit(film.wait())
