"""Arrays as the compiled parts take them."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Sequence
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

Float32Array = np.ndarray[Any, np.dtype[np.float32]]
Float64Array = np.ndarray[Any, np.dtype[np.float64]]


def real(name: str, numbers: npt.ArrayLike) -> npt.NDArray[Any]:
    """An array of real numbers, or a ``ValueError`` that names the argument."""
    array = np.asarray(numbers)
    if array.dtype.kind not in "fiub":
        raise ValueError(f"`{name}` must be an array of real numbers, got dtype {array.dtype}")
    return array


def readable(path: str | os.PathLike[str]) -> None:
    """Raises the ``OSError`` of a file that cannot be read."""
    with open(path, "rb"):
        pass


def rows(name: str, numbers: npt.ArrayLike, columns: int | None = None) -> tuple[Float32Array, tuple[int, ...]]:
    """The rows of an array along its last axis, C-contiguous ``float32``, and the shape of the other axes.

    An array that is C-contiguous and ``float32`` is not copied.
    """
    array = real(name, numbers)
    if array.ndim == 0:
        raise ValueError(f"`{name}` must have a last axis of coordinates, got a number")
    if columns is not None and array.shape[-1] != columns:
        raise ValueError(f"`{name}` must have the shape (..., {columns}), got {array.shape}")
    flat = np.require(array, np.float32, ("C", "A"))
    shape = array.shape[:-1]
    count = int(np.prod(shape, dtype=np.int64))
    return flat.reshape(count, array.shape[-1]), shape


def flat64(name: str, numbers: npt.ArrayLike) -> tuple[Float64Array, tuple[int, ...]]:
    """The numbers of an array as one C-contiguous ``float64`` list, and its shape."""
    array = real(name, numbers)
    return np.require(array, np.float64, ("C", "A")).reshape(-1), array.shape


def integers(name: str, numbers: SupportsIndex | Sequence[SupportsIndex]) -> list[int]:
    """An integer, or a list of integers."""
    try:
        return [operator.index(number) for number in (numbers if isinstance(numbers, Iterable) else [numbers])]
    except TypeError:
        raise ValueError(f"`{name}` must be an integer or a list of integers, got {numbers!r}") from None


def seed32(seed: SupportsIndex) -> int:
    """A seed of 32 bits."""
    try:
        number = operator.index(seed)
    except TypeError:
        raise ValueError(f"`seed` must be an integer, got {seed!r}") from None
    if not 0 <= number < 2**32:
        raise ValueError(f"`seed` must be between 0 and 4294967295, got {seed}")
    return number


def joined(*arguments: tuple[str, npt.ArrayLike, int]) -> tuple[Float32Array, tuple[int, ...]]:
    """Rows of several arrays side by side, broadcast against each other, and the broadcast shape.

    An argument is its name, its array and the length of its last axis; 0 is an array of numbers
    without a last axis. A single array is not copied if it is C-contiguous and ``float32``.
    """
    if len(arguments) == 1:
        name, numbers, columns = arguments[0]
        return rows(name, numbers, columns)
    arrays = []
    for name, numbers, columns in arguments:
        array = real(name, numbers)
        if columns and (array.ndim == 0 or array.shape[-1] != columns):
            raise ValueError(f"`{name}` must have the shape (..., {columns}), got {array.shape}")
        arrays.append(array if columns else array[..., None])
    try:
        shape = np.broadcast_shapes(*(array.shape[:-1] for array in arrays))
    except ValueError:
        names = ", ".join(f"`{name}`" for name, _, _ in arguments)
        shapes = ", ".join(str(array.shape[:-1]) for array in arrays)
        raise ValueError(f"{names} must have shapes that broadcast, got {shapes}") from None
    parts = [np.broadcast_to(array, (*shape, array.shape[-1])) for array in arrays]
    joint = np.concatenate(parts, axis=-1, dtype=np.float32, casting="unsafe")
    return joint.reshape(-1, joint.shape[-1]) if joint.size else joint.reshape(0, joint.shape[-1]), shape


def shaped(flat: Float32Array, shape: tuple[int, ...], columns: int) -> Float32Array:
    """Rows of results in the shape of their arguments; 0 columns are numbers without a last axis."""
    return flat.reshape((*shape, columns) if columns else shape)
