"""glTF models whose roughness has the slope variance that their normal maps lose."""

from __future__ import annotations

import os
from typing import Literal, NamedTuple

from . import _asperity
from ._arrays import readable


class FilteredLevel(NamedTuple):
    """A mip level of a filtered roughness map."""

    width: int
    height: int
    before: float
    """Mean roughness of plain mip levels."""
    after: float
    """Mean roughness of the new texture."""


class FilteredMaterial(NamedTuple):
    """A material with a normal map."""

    number: int
    """The index of the material in the file."""
    name: str
    levels: list[FilteredLevel] | None
    """The levels of its new roughness, or ``None`` if the material is left as it is."""
    reason: str | None
    """Why the material is left as it is."""
    error: tuple[float, float] | None
    """The relative error of the highlight before and after, with ``report=True``."""


class FilteredModel(NamedTuple):
    """What was done to a model."""

    materials: list[FilteredMaterial]
    files: list[str]
    """Files written, the model first."""


def filter(  # noqa: A001
    path: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    format: Literal["uastc", "zstd"] = "uastc",  # noqa: A002
    anisotropy: bool = False,
    png: str | os.PathLike[str] | None = None,
    report: bool = False,
) -> FilteredModel:
    """The model at ``path`` with the lost slope variance in its roughness, written to ``out``.

    Every mip level of a normal map loses variance of slopes, which makes models sparkle. The
    variance becomes roughness in a new texture with explicit mip levels; everything else keeps its
    bytes. Keywords are the options of ``asperity filter``. Nothing is written if anything fails.
    """
    readable(path)
    materials, files = _asperity.filter(path, out, format, anisotropy, png, report)
    return FilteredModel(
        [
            FilteredMaterial(
                number,
                name,
                None if levels is None else [FilteredLevel(*level) for level in levels],
                reason,
                None if error is None else (error[0], error[1]),
            )
            for number, name, levels, reason, error in materials
        ],
        files,
    )
