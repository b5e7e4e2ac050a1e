"""Reads the node and element data that febio4 writes beside its log."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from harness.arrays import Array, Ids
from harness.errors import DataFileError


@dataclass(frozen=True)
class History:
    """Node or element data over time."""

    times: Array  # shape (n_times,): s; the first is the initial state where febio4 wrote it
    items: Ids  # shape (n_items,): node or element numbers, from 1
    columns: tuple[str, ...]  # names of the data
    values: Array  # shape (n_times, n_items, n_columns): 12 significant digits, as febio4 writes them

    def __getitem__(self, column: str) -> Array:
        """The values of one column, shape (n_times, n_items)."""
        if column not in self.columns:
            raise KeyError(f"no data '{column}'; there is {', '.join(self.columns)}")
        return np.asarray(self.values[:, :, self.columns.index(column)])

    def has(self, time: float) -> bool:
        """Whether `at` finds a state at `time` (s)."""
        return bool(np.min(np.abs(self.times - time)) <= self._resolution)

    @property
    def _resolution(self) -> float:
        return 1e-6 * max(abs(float(self.times[-1])), 1e-12)

    def at(self, time: float) -> int:
        """Index of the state at `time` (s).

        Raises DataFileError where no state lies within 1e-6 of it, relative to the last time.
        """
        index = int(np.argmin(np.abs(self.times - time)))
        if abs(self.times[index] - time) > self._resolution:
            raise DataFileError(f"no data at t = {time:g} s; the nearest is at {self.times[index]:g} s")
        return index


def at_the_end(history: History, columns: Iterable[str]) -> Array:
    """The last values of some columns, shape (nodes or elements, columns)."""
    return np.stack([history[column][-1] for column in columns], axis=-1)


def read_history(path: Path, columns: tuple[str, ...]) -> History:
    """Read a data file.

    path: file named by a ``<node_data>`` or ``<element_data>`` line without ``format``.
    columns: names of its columns, the number of the node or element left out.
    Raises DataFileError: a missing file, a file without data, or one whose blocks differ in size; names file and line.
    """
    try:
        return _read(path, columns, path.stat().st_mtime_ns)
    except OSError as error:
        raise DataFileError(f"cannot read the data file {path}: {error.strerror}") from error


@lru_cache(maxsize=8)
def _read(path: Path, columns: tuple[str, ...], _changed: int) -> History:
    """The checks of a run read its files one after the other, each several times."""
    lines = path.read_text().splitlines()
    times: list[float] = []
    blocks: list[list[str]] = []
    for number, line in enumerate(lines, 1):
        if line.startswith("*Time"):
            times.append(_time(path, number, line))
            blocks.append([])
        elif not line.startswith("*") and line.strip():
            if not blocks:
                raise DataFileError(f"{path}, line {number}: data before the first '*Time' line")
            blocks[-1].append(line)
    return _assemble(path, columns, times, blocks)


def _time(path: Path, number: int, line: str) -> float:
    try:
        return float(line.split("=")[1])
    except (IndexError, ValueError) as error:
        raise DataFileError(f"{path}, line {number}: expected '*Time = <number>', found '{line}'") from error


def _assemble(path: Path, columns: tuple[str, ...], times: list[float], blocks: list[list[str]]) -> History:
    if not blocks:
        raise DataFileError(f"{path}: holds no data")
    n_items, width = len(blocks[0]), 1 + len(columns)
    for time, block in zip(times, blocks, strict=True):
        if len(block) != n_items:
            raise DataFileError(f"{path}: {len(block)} lines at t = {time:g} s, {n_items} at t = {times[0]:g} s")
    words = " ".join(line for block in blocks for line in block).split()
    if len(words) != len(blocks) * n_items * width:
        raise DataFileError(f"{path}: expected {width} numbers a line (item, {', '.join(columns)})")
    try:
        table = np.array(words, dtype=np.float64).reshape(len(blocks), n_items, width)
    except ValueError as error:
        raise DataFileError(f"{path}: {error}") from error
    table.flags.writeable = False  # shared by all who read the file
    return History(np.array(times), table[0, :, 0].astype(np.int64), columns, table[:, :, 1:])
