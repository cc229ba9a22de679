#!/usr/bin/env python3
"""Two small files in layouts of earlier studies: ITEM: snapshots without names of columns (a spot model of 2007) and an
array of (frames, grains, x y z energy) as NumPy saves it (a vortex study of 2012). Needs no packages."""
import math
import struct

with open("snapshots_2007.txt", "w") as out:
    for frame in range(3):
        out.write(f"ITEM: TIMESTEP\n{20000 * frame}\nITEM: NUMBER OF ATOMS\n12\nITEM: BOX BOUNDS\n-2 2\n-2 2\n0 10\nITEM: ATOMS\n")
        for k in range(12):
            out.write(f"{k + 1} 1 1 {k % 2 - 0.5} {k // 2 % 2 - 0.5} {k // 4 + 0.5 + 0.25 * frame}\n")

frames, grains = 5, 8
header = "{'descr': '<f8', 'fortran_order': False, 'shape': (%d, %d, 4), }" % (frames, grains)
header += " " * (-(10 + len(header) + 1) % 64) + "\n"
with open("dump_r002.00_p2500.00_f050.0.npy", "wb") as out:
    out.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode())
    for frame in range(frames):
        for k in range(grains):
            turn = 2 * math.pi * k / grains + 0.05 * frame
            out.write(struct.pack("<4d", 0.05 * math.cos(turn), 0.05 * math.sin(turn), 0.01 * k, 1e-6 * k))
