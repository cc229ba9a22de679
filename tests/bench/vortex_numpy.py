"""The vortex tank as array code: 256 beads, all pairs at once in dense n x n (x 3) arrays, one time step after
the other. Written from the published description of the program (H. E. Rice, M.S. thesis, University of
Mississippi, 2012), defects included, to be timed beside Sandglass.

    vortex_numpy.py STEPS [RADIUS_MM] [OMEGA]

Prints: steps, wall seconds, CPU seconds, mean speed of the flow less that of the beads at the end [m/s].
"""

import sys
import time

import numpy as np

R, H, DT, G = 0.06, 0.20, 1e-4, 9.8
Y, NU, A, MU = 2e5, 0.3, 1e-3, 0.01
ALPHA, BETA, WIND, SPIN_DRAG = 0.5, 25.0, 8.0, 6e-8
N = 256


def place(r, random):
    for _ in range(6):
        x = np.empty((0, 3))
        rejected = 0
        while len(x) < N and rejected < 10000:
            p = random.uniform([-R, -R, -H / 2], [R, R, 1.5 * H])
            near = len(x) and np.min(np.sum((x - p) ** 2, axis=1)) <= 4 * r * r
            if np.hypot(p[0], p[1]) >= R - r or near:
                rejected += 1
                continue
            x = np.vstack([x, p])
            rejected = 0
        if len(x) == N:
            return x
    sys.exit("no room for the beads")


def hertz(kappa, overlap, before):
    depth = np.maximum(overlap, 0.0)
    rate = (depth - before) / DT
    return np.maximum(0.0, kappa * (depth**1.5 + A * np.sqrt(depth) * rate)), depth


def drag(c1, c2, u):
    return -c1 * u - c2 * u * np.abs(u)


def run(steps, r, omega):
    random = np.random.default_rng(1)
    x = place(r, random)
    v = random.uniform(-0.5, 0.5, (N, 3))
    w = random.uniform(-0.5, 0.5, (N, 3))
    m = 0.75 * 4.0 / 3.0 * np.pi * r**3 * 10000.0
    inertia = 0.4 * m * r * r
    pair = 2 * Y * np.sqrt(r) / (3 * (1 - NU**2))
    wall = 2 * Y * np.sqrt(2 * r) / (3 * (1 - NU**2))
    c1, c2 = 1.55e-4 * 2 * r, 0.22 * 4 * r * r
    before_pair = np.zeros((N, N))
    before_side, before_floor = np.zeros(N), np.zeros(N)
    wall_time, cpu_time = time.perf_counter(), time.process_time()
    for _ in range(steps):
        # all pairs
        apart = x[:, None, :] - x[None, :, :]
        distance = np.sqrt(np.sum(apart * apart, axis=2))
        np.fill_diagonal(distance, 1.0)
        n = apart / distance[:, :, None]
        overlap = 2 * r - distance
        push, before_pair = hertz(pair, overlap, before_pair)
        touching = (overlap > 0)[:, :, None]
        spins = w[:, None, :] + w[None, :, :]
        slip = r * np.cross(spins, n)
        f = np.sum(push[:, :, None] * n + touching * (MU * m / DT) * slip, axis=1)
        torque = np.sum(touching * (-MU * inertia / DT) * spins * (1 - np.abs(n)), axis=1)
        # side wall: the way to the axis over the distance from the origin
        outward = np.hypot(x[:, 0], x[:, 1])
        n = np.zeros((N, 3))
        n[:, :2] = -x[:, :2] / np.sqrt(np.sum(x * x, axis=1))[:, None]
        overlap = r - (R - outward)
        push, before_side = hertz(wall, overlap, before_side)
        touching = (overlap > 0)[:, None]
        f += push[:, None] * n + touching * (MU * m / DT) * r * np.cross(w, n)
        torque += touching * (-MU * inertia / DT) * w * (1 - np.abs(n))
        # floor
        n = np.tile([0.0, 0.0, 1.0], (N, 1))
        overlap = r - x[:, 2] - H
        push, before_floor = hertz(wall, overlap, before_floor)
        touching = (overlap > 0)[:, None]
        f += push[:, None] * n + touching * (MU * m / DT) * r * np.cross(w, n)
        torque += touching * (-MU * inertia / DT) * w * (1 - np.abs(n))
        # wind from below, weakened by the beads below, and a push where beads are pressed together
        aside = np.max(np.abs(apart[:, :, :2]), axis=2)
        shields = np.sum((aside < 2 * r) & (apart[:, :, 2] > 0), axis=1)
        fade = np.exp(-BETA * (x[:, 2] + H / 1.5))
        f[:, 2] += 100 * fade * ALPHA**shields * drag(c1, c2, v[:, 2] - WIND)
        f[:, 2] += 10 * fade * np.sum(before_pair, axis=1) - m * G
        # the flow that turns
        flow = np.stack([omega * x[:, 1], -omega * x[:, 0], np.zeros(N)], axis=1)
        f += drag(c1, c2, v - flow)
        # step
        v = v + f * DT / m
        x = x + v * DT
        w = w + torque * DT / inertia
        w = w - SPIN_DRAG * w * DT / inertia
        if np.isnan(f).any() or np.abs(x[:, :2]).max() > 2 * R or np.abs(x[:, 2]).max() > 10 * H:
            sys.exit("a bead left the tank")
    wall_time, cpu_time = time.perf_counter() - wall_time, time.process_time() - cpu_time
    flow = omega * np.hypot(x[:, 0], x[:, 1])
    lag = np.mean(flow) - np.mean(np.sqrt(np.sum(v * v, axis=1)))
    print(steps, wall_time, cpu_time, lag)


if __name__ == "__main__":
    values = [float(a) for a in sys.argv[1:]]
    run(int(values[0]), (values[1] if len(values) > 1 else 4.0) * 1e-3, values[2] if len(values) > 2 else 100.0)
