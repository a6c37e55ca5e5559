"""Textures of surfaces as arrays."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Literal, Union

from . import _asperity
from ._arrays import Float32Array

_Value = Union[str, float, "os.PathLike[str]", None]


def bake(
    *,
    noise: Literal["gaussian", "perlin", "simplex", "value", "cellular", "sparse"] | None = None,
    ndf: str | None = None,
    fractal: Literal["periodic"] | None = None,
    material: str | None = None,
    set: Mapping[str, _Value] | None = None,  # noqa: A002
    side: float | None = None,
    measure: Literal["normals", "solid-angle"] | None = None,
    reconstruction: Literal["constant", "bilinear"] | None = None,
    tangent_space: Literal["opengl", "directx"] | None = None,
    blue: Literal["z", "unused"] | None = None,
    size: int = 1024,
    tile: int | None = None,
    samples: int | None = None,
    tileable: bool = False,
    cells: int | None = None,
    octaves: int | None = None,
    lacunarity: float | None = None,
    gain: float | None = None,
    scaling: float | None = None,
    height: float | None = None,
    occlusion: float | None = None,
    tint: str | None = None,
    low_tint: str | None = None,
    roughness: float | None = None,
    metallic: float | None = None,
    seed: int = 1,
) -> dict[str, Float32Array]:
    """The maps of a texture, as ``asperity bake`` writes them, by name.

    Keywords are the options of the command, which ``asperity bake --help`` describes. Maps have the
    shape ``(size, size)`` or ``(size, size, 3)``, from the top left:

    - ``base_color``: sRGB encoded, in [0, 1].
    - ``normal``: components in [-1, 1], y up the image.
    - ``height``: in sides of the texture; missing if the surface has no height.
    - ``roughness``: √α, in [0, 1], which includes the slopes that a texel does not resolve.
    - ``metallic`` and ``ambient_occlusion``, in [0, 1].

    Numbers other than heights have 16 bits.
    """
    options: dict[str, _Value] = {
        "noise": noise, "ndf": ndf, "fractal": fractal, "material": material, "side": side,
        "measure": measure, "reconstruction": reconstruction, "tangent-space": tangent_space,
        "blue": blue, "size": size, "tile": tile, "samples": samples, "cells": cells,
        "octaves": octaves, "lacunarity": lacunarity, "gain": gain, "scaling": scaling,
        "height": height, "occlusion": occlusion, "tint": tint, "low-tint": low_tint,
        "roughness": roughness, "metallic": metallic, "seed": seed,
    }  # fmt: skip
    words = [f"--{name}={_word(value)}" for name, value in options.items() if value is not None]
    words += [f"--set={name}={_word(value)}" for name, value in (set or {}).items()]
    if tileable:
        words.append("--tileable")
    maps = {}
    for name, texels, channels, numbers in _asperity.bake(words):
        shape = (texels, texels, channels) if channels > 1 else (texels, texels)
        maps["normal" if name == "normal_opengl" else name] = numbers.reshape(shape)
    return maps


def _word(value: _Value) -> str:
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return str(value)
