"""Times samplers of normals side by side: Asperity's, Mitsuba's and rand_distr's, one thread, in turn.

    pip install -r requirements.txt
    python compare.py                     # the table on standard output
    python compare.py --ship ndf.md

Mitsuba runs its LLVM variant, which needs a libLLVM that it finds; everything happens on one core.
"""

import argparse
import os
import pathlib
import platform
import statistics
import subprocess
import time

HERE = pathlib.Path(__file__).resolve().parent
SIDE = 256
ALPHA = (0.2, 0.4)

# Row, what it is, the unit, how much faster we want to be.
ROWS = [
    ("map_sample_bilinear", "256² map, bilinear: sampling", "ns", 2.5),
    ("map_forward_bilinear", "256² map, bilinear: inversion", "ns", 1.5),
    ("map_density_bilinear", "256² map, bilinear: evaluation", "ns", 1.3),
    ("map_sample_constant", "256² map, piecewise constant: sampling", "ns", 3.0),
    ("map_build_bilinear", "256² map, bilinear: building, ready for arrays", "µs", 1.0),
    ("map_build_constant", "256² map, piecewise constant: building, ready for arrays", "µs", 1.0),
    ("ggx_sample", "GGX: normals from uniform numbers", "ns", 1.5),
    ("beckmann_sample", "Beckmann: normals from uniform numbers", "ns", 1.5),
    ("ggx_visible", "GGX: visible normals", "ns", 1.2),
    ("beckmann_visible", "Beckmann: visible normals", "ns", 3.0),
]

class Asperity:
    """Our program, which times one row after another on demand."""

    def __init__(self, samples):
        subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=HERE, check=True)
        target = os.environ.get("CARGO_TARGET_DIR", HERE / "target")
        program = pathlib.Path(target) / "release" / "asperity-ndf-peer"
        self.process = subprocess.Popen(
            [str(program), str(samples)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.rows = self.process.stdout.readline().split()

    def time(self, row):
        self.process.stdin.write(row + "\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())


class Mitsuba:
    """The same rows by Mitsuba: arrays in memory, kernels compiled before the clock starts."""

    def __init__(self, samples):
        import drjit as dr
        import mitsuba as mi
        import numpy as np

        mi.set_variant("llvm_ad_rgb")
        dr.set_thread_count(0)
        self.dr, self.version, self.samples = dr, mi.__version__, samples
        random = np.random.default_rng(1)

        def uniform():
            return random.random(samples, dtype=np.float32)

        u = mi.Point2f(uniform(), uniform())
        up, azimuth = uniform() * 0.9 + 0.1, uniform() * 6.283
        across = np.sqrt(1 - up * up)
        view = mi.Vector3f(across * np.cos(azimuth), across * np.sin(azimuth), up)
        centres = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
        x, y = np.meshgrid(centres, centres)
        cos2 = 1 - x * x - y * y
        stretched = (x / ALPHA[0]) ** 2 + (y / ALPHA[1]) ** 2 + np.maximum(cos2, 0)
        density = np.where(cos2 > 0, 1 / (np.pi * ALPHA[0] * ALPHA[1] * stretched**2), 0)
        texels = mi.TensorXf(density.astype(np.float32))
        bilinear, constant = mi.MarginalContinuous2D0(texels), mi.MarginalDiscrete2D0(texels)
        points = bilinear.sample(u)[0]
        dr.eval(u, view, points)

        def microfacet(kind, visible):
            return mi.MicrofacetDistribution(kind, ALPHA[0], ALPHA[1], visible)

        ggx, beckmann = mi.MicrofacetType.GGX, mi.MicrofacetType.Beckmann
        # Only the normal or the point is evaluated where a call also gives a density.
        self.calls = {
            "map_sample_bilinear": lambda: dr.eval(bilinear.sample(u)[0]),
            "map_forward_bilinear": lambda: dr.eval(bilinear.invert(points)[0]),
            "map_density_bilinear": lambda: dr.eval(bilinear.eval(points)),
            "map_sample_constant": lambda: dr.eval(constant.sample(u)[0]),
            "map_build_bilinear": lambda: mi.MarginalContinuous2D0(texels),
            "map_build_constant": lambda: mi.MarginalDiscrete2D0(texels),
            "ggx_sample": lambda m=microfacet(ggx, False): dr.eval(m.sample(view, u)[0]),
            "beckmann_sample": lambda m=microfacet(beckmann, False): dr.eval(m.sample(view, u)[0]),
            "ggx_visible": lambda m=microfacet(ggx, True): dr.eval(m.sample(view, u)[0]),
            "beckmann_visible": lambda m=microfacet(beckmann, True): dr.eval(m.sample(view, u)[0]),
        }
        for call in self.calls.values():
            call()

    def time(self, row):
        self.dr.sync_thread()
        start = time.perf_counter()
        self.calls[row]()
        self.dr.sync_thread()
        took = time.perf_counter() - start
        return took * 1e6 if "build" in row else took * 1e9 / self.samples


def processor():
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or "unknown processor"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=1_000_000, help="samples in one turn")
    parser.add_argument("--rounds", type=int, default=15, help="turns of everybody")
    parser.add_argument("--ship", metavar="FILE", help="write the table also to FILE")
    wanted = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    ours, theirs = Asperity(wanted.samples), Mitsuba(wanted.samples)

    lines = [
        "# Samplers of normals, side by side",
        "",
        f"One thread of {processor()}; {wanted.samples:,} samples from arrays into arrays in one turn, {wanted.rounds} turns "
        "of everybody, interleaved; medians, and the median of the ratios of the turns. GGX 0.2, 0.4. "
        f"Mitsuba {theirs.version}, LLVM variant. `xtask/peers/ndf/compare.py` makes this table.",
        "",
        "| | Asperity | Mitsuba | ratio | wanted |",
        "|---|---|---|---|---|",
    ]
    for row, words, unit, goal in ROWS:
        if row not in ours.rows:
            continue
        ours.time(row)
        turns = [(ours.time(row), theirs.time(row)) for _ in range(wanted.rounds)]
        mine, other = (statistics.median(times) for times in zip(*turns))
        ratio = statistics.median(b / a for a, b in turns)
        lines.append(f"| {words} | {mine:.3g} {unit} | {other:.3g} {unit} | {ratio:.2f} | {goal} |")
        print(lines[-1], flush=True)
    lines += ["", "Ours alone:", "", "| | |", "|---|---|"]
    for row in ours.rows:
        if not any(row == known for known, *_ in ROWS):
            times = [ours.time(row) for _ in range(wanted.rounds)]
            lines.append(f"| `{row}` | {statistics.median(times):.3g} ns |")
    lines += [
        "",
        "How the cost of a map grows with its texels and with the samples of a call: `cargo xtask bench --growth`. "
        "What was tried to make maps faster: [maps-tried.md](maps-tried.md).",
    ]
    text = "\n".join(lines) + "\n"
    print("\n" + text)
    if wanted.ship:
        # Written beside and renamed, so that a table is whole or the old one.
        path = pathlib.Path(wanted.ship)
        part = path.with_suffix(".part")
        part.write_text(text, encoding="utf-8")
        part.replace(path)


if __name__ == "__main__":
    main()
