"""Procedural surface detail: noise with gradients, normal distribution functions, fractal
interpolation functions, shading, and the command ``asperity``.

Arrays go in and come out as NumPy arrays. Last axes are coordinates: points have the shape
``(..., N)`` and directions ``(..., 3)``.
"""

from . import fif, ndf, noise, shading
from ._bake import bake
from ._filter import filter

__all__ = ["__version__", "bake", "fif", "filter", "ndf", "noise", "shading"]

__version__ = "0.1.0"
