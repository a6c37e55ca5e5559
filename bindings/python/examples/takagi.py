"""Takagi's function and its relatives: one number makes a curve smooth or rough."""

import matplotlib.pyplot as plt
import numpy as np

from asperity import fif

x = np.linspace(0, 1, 4001)
scalings = np.linspace(0.25, 0.75, 11)
shades = plt.get_cmap("viridis")(np.linspace(0.9, 0.05, len(scalings)))

figure, axes = plt.subplots(figsize=(9.6, 4.6), facecolor="white")
for scaling, shade in zip(scalings, shades):
    f = fif.affine([0, 0.5, 1], [0, 0.5, 0], scaling=scaling)
    low, high = f.dimension
    bold = np.isclose(scaling, 0.5)
    label = f"{scaling:.2f}   dimension {low:.3f}" + ("   Takagi" if bold else "")
    axes.plot(x, f(x), color="#d1345b" if bold else shade, lw=1.6 if bold else 0.8, label=label)

# The maximum of Takagi's function is 2/3, with a proof: the bracket is as wide as rounding allows.
takagi = fif.affine([0, 0.5, 1], [0, 0.5, 0], scaling=0.5)
low, high = takagi.extrema(width=1e-12).maximum
axes.axhline(high, color="#d1345b", lw=0.6, ls=":")
axes.text(1.005, high, "2/3", color="#d1345b", fontsize=9, va="center")
axes.set(xlim=(0, 1), ylim=(0, None), xlabel="x", ylabel="f(x)")
axes.spines[["top", "right"]].set_visible(False)
axes.legend(title="scaling α", fontsize=7, title_fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1.04, 0.5))
figure.tight_layout()
figure.savefig("takagi.png", dpi=100, bbox_inches="tight", pad_inches=0.12)
