"""Objects that keep the call that made them, so that they can be pickled and copied."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

import numpy as np

_P = ParamSpec("_P")
_R = TypeVar("_R", bound="Recorded")


class Recorded:
    """An object that is pickled as the call that made it."""

    __slots__ = ("_call",)

    _call: tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]

    def __new__(cls, *arguments: Any, **keywords: Any) -> Any:
        made = object.__new__(cls)
        made._record(cls, arguments, keywords)
        return made

    def _record(
        self, function: Callable[..., Any], arguments: tuple[Any, ...], keywords: dict[str, Any]
    ) -> None:
        self._call = (
            function,
            tuple(_kept(argument) for argument in arguments),
            {name: _kept(argument) for name, argument in keywords.items()},
        )

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        if not hasattr(self, "_call"):
            raise TypeError(f"cannot pickle {self!r}")
        return _again, self._call


def recorded(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """A function or method whose results keep the call."""

    @functools.wraps(function)
    def call(*arguments: _P.args, **keywords: _P.kwargs) -> _R:
        made = function(*arguments, **keywords)
        made._record(call, arguments, keywords)
        return made

    return call


def text_of(made: Recorded) -> str:
    """The call as it was written."""
    function, arguments, keywords = made._call
    written = [repr(argument) for argument in arguments]
    written += [f"{name}={argument!r}" for name, argument in keywords.items()]
    return f"{function.__name__}({', '.join(written)})"


def _again(function: Callable[..., Any], arguments: tuple[Any, ...], keywords: dict[str, Any]) -> Any:
    return function(*arguments, **keywords)


def _kept(argument: Any) -> Any:
    """An argument that does not change with the caller's."""
    if isinstance(argument, np.ndarray):
        return argument.copy()
    return list(argument) if isinstance(argument, list) else argument
