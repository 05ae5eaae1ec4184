# SPDX-License-Identifier: MIT
"""Progress of long calls: a function of the user's, or a bar of tqdm's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Union

import numpy as np

# False or None: nobody is told. True: a bar of tqdm's. A function is called with the fraction done, from 0 to 1, and cancels
# the call by returning False.
Progress = Union[bool, Callable[[float], object], None]


@contextmanager
def reporting(progress: Progress, title: str) -> Iterator[Callable[[float], object] | None]:
    """Give what is told the fraction done."""
    if progress is None or progress is False:
        yield None
    elif progress is not True:
        function = progress

        def tell(fraction: float) -> bool:
            answer = function(fraction)
            return bool(answer) if isinstance(answer, np.bool_) else answer is not False

        yield tell
    else:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            raise ImportError("progress=True shows a bar of tqdm's: pip install tqdm") from error
        with tqdm(total=100, desc=title, unit="%", leave=False) as bar:

            def show(fraction: float) -> None:
                bar.update(round(100 * fraction) - bar.n)

            yield show
