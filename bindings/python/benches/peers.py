"""Times this package and other noise packages for Python, in one process.

    python benches/peers.py [--side 1024]

Missing packages are left out. A figure is the fastest of nine runs, in million points per second, so that
other work of the machine counts little. Every grid has 64 points a cell along each axis. `pyfastnoisesimd`
builds with Python 3.10, ``numpy<2``, ``setuptools<70`` and ``--no-build-isolation`` only.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from asperity.noise import Fbm, Perlin, Simplex

Task = Callable[[], object]


def peer(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def tasks(side: int) -> dict[str, dict[str, tuple[Task, int]]]:
    """Functions to time with their number of points, by task and package."""
    plane, cube = (side, side), (side // 8,) * 3
    rng = np.random.default_rng(1)
    points2 = rng.uniform(0, 64, (side * side // 4, 2)).astype(np.float32)
    points3 = rng.uniform(0, 64, (side * side // 4, 3)).astype(np.float32)
    x, y, z = (np.arange(n) / 64.0 for n in (cube[2], cube[1], cube[0]))
    u, v = np.arange(side) / 64.0, np.arange(side) / 64.0
    perlin, simplex = Perlin(1), Simplex(1)
    area, volume, listed = side * side, int(np.prod(cube)), len(points2)
    table: dict[str, dict[str, tuple[Task, int]]] = {
        "2-D grid": {}, "3-D grid": {}, "2-D points": {}, "3-D points": {},
    }  # fmt: skip
    for label, threads in (("asperity, 1 thread", 1), ("asperity, all cores", None)):
        for kind, noise in (("Perlin", perlin), ("simplex", simplex)):
            name = f"{label}, {kind}"
            table["2-D grid"][name] = (lambda n=noise, t=threads: n.grid(plane, 1 / 64, threads=t), area)
            table["3-D grid"][name] = (lambda n=noise, t=threads: n.grid(cube, 1 / 64, threads=t), volume)
            table["2-D points"][name] = (lambda n=noise, t=threads: n(points2, threads=t), listed)
            table["3-D points"][name] = (lambda n=noise, t=threads: n(points3, threads=t), listed)

    if opensimplex := peer("opensimplex"):
        opensimplex.seed(1)
        table["2-D grid"]["opensimplex"] = (lambda: opensimplex.noise2array(u[:128], v[:128]), 128**2)
        table["3-D grid"]["opensimplex"] = (lambda: opensimplex.noise3array(x[:24], y[:24], z[:24]), 24**3)
        few = points2[:2_000].tolist()
        table["2-D points"]["opensimplex"] = (lambda few=few: [opensimplex.noise2(a, b) for a, b in few], len(few))
        few3 = points3[:2_000].tolist()
        table["3-D points"]["opensimplex"] = (
            lambda few=few3: [opensimplex.noise3(a, b, c) for a, b, c in few], len(few3)
        )
    if old := peer("noise"):
        few = points2[:50_000].tolist()
        table["2-D points"]["noise"] = (lambda few=few: [old.pnoise2(a, b) for a, b in few], len(few))
        table["2-D grid"]["noise"] = table["2-D points"]["noise"]
        few3 = points3[:50_000].tolist()
        table["3-D points"]["noise"] = (lambda few=few3: [old.pnoise3(a, b, c) for a, b, c in few], len(few3))
        table["3-D grid"]["noise"] = table["3-D points"]["noise"]
    if pn := peer("perlin_numpy"):
        table["2-D grid"]["perlin-numpy"] = (lambda: pn.generate_perlin_noise_2d(plane, (16, 16)), area)
        table["3-D grid"]["perlin-numpy"] = (lambda: pn.generate_perlin_noise_3d(cube, (2, 2, 2)), volume)
    if lite := peer("pyfastnoiselite.pyfastnoiselite"):
        for kind in ("NoiseType_Perlin", "NoiseType_OpenSimplex2"):
            fast = lite.FastNoiseLite(1)
            fast.noise_type = getattr(lite.NoiseType, kind)
            name = f"pyfastnoiselite, {kind.split('_')[1]}"
            if hasattr(fast, "gen_from_coords"):
                table["2-D points"][name] = (lambda f=fast: f.gen_from_coords(points2.T.copy()), listed)
                table["3-D points"][name] = (lambda f=fast: f.gen_from_coords(points3.T.copy()), listed)
                table["2-D grid"][name] = (lambda f=fast: f.gen_from_coords(grid_points(u, v)), area)
                table["3-D grid"][name] = (lambda f=fast: f.gen_from_coords(grid_points(x, y, z)), volume)
            else:
                few = points2[:50_000].tolist()
                table["2-D points"][name] = (lambda f=fast: [f.get_noise(a, b) for a, b in few], len(few))
                table["2-D grid"][name] = table["2-D points"][name]
                few3 = points3[:50_000].tolist()
                table["3-D points"][name] = (lambda f=fast: [f.get_noise(a, b, c) for a, b, c in few3], len(few3))
                table["3-D grid"][name] = table["3-D points"][name]
    if simd := peer("pyfastnoisesimd"):
        for threads in (1, simd.num_virtual_cores() if hasattr(simd, "num_virtual_cores") else 2):
            for kind in ("Perlin", "Simplex"):
                fast = simd.Noise(seed=1, numWorkers=threads)
                fast.noiseType, fast.frequency = getattr(simd.NoiseType, kind), 1 / 64
                name = f"pyfastnoisesimd, {threads} threads, {kind}"
                table["2-D grid"][name] = (lambda f=fast: f.genAsGrid(plane), area)
                table["3-D grid"][name] = (lambda f=fast: f.genAsGrid(cube), volume)
                coords = simd.empty_coords(listed)
                coords[:3, :listed] = points3.T
                table["3-D points"][name] = (lambda f=fast, c=coords: f.genFromCoords(c), listed)
                flat = simd.empty_coords(listed)
                flat[:, :listed] = 0
                flat[:2, :listed] = points2.T
                table["2-D points"][name] = (lambda f=fast, c=flat: f.genFromCoords(c), listed)
    return table


def grid_points(*axes: np.ndarray) -> np.ndarray:
    return np.stack([a.ravel() for a in np.meshgrid(*axes, indexing="ij")]).astype(np.float32)


def rate(task: Task, points: int) -> float:
    """Million points per second."""
    task()
    times = []
    for _ in range(9):
        start = time.perf_counter()
        task()
        times.append(time.perf_counter() - start)
    return points / min(times) / 1e6


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--side", type=int, default=1024)
    side = parser.parse_args().side
    print(f"Python {sys.version.split()[0]}, million points per second")
    for task, packages in tasks(side).items():
        print(f"\n{task}")
        rates = {name: rate(*made) for name, made in packages.items()}
        for name, found in sorted(rates.items(), key=lambda pair: -pair[1]):
            print(f"  {name:<44} {found:9.2f}")
        ours = max(found for name, found in rates.items() if name.startswith("asperity, 1"))
        for threads in ("1 thread", "any threads"):
            others = {
                name: found
                for name, found in rates.items()
                if not name.startswith("asperity")
                and (threads == "any threads" or "threads" not in name or ", 1 threads" in name)
            }
            if others:
                best = max(others, key=lambda name: others[name])
                print(f"  one thread is {ours / others[best]:.1f} times the fastest other of {threads}, {best}")


if __name__ == "__main__":
    main()
