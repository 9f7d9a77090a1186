"""Results of tread as numpy arrays with units.

    run = Run("out")                   # folder of a finished `tread run`
    run.history["vertical_force"]      # F_N by sample, with .unit "N" and .description
    Sweep("study").results             # results by point of a `tread sweep`

`python3 tread_results.py FOLDER` lists files, datasets, shapes and units of a run or a study.
Needs numpy 1.24 and h5py 3.7 or later, the Debian packages python3-numpy and python3-h5py.
"""

from __future__ import annotations

import argparse
import csv
import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

OUT, STICKS, SLIPS = 0, 1, 2  # values of Run.patch["state"]
_SCENE = "scene.resolved.toml"
_TABLED = ("sweep", "dial", "paper")  # commands that leave sweep.csv


class ResultError(Exception):
    """Error of a folder, file or name: place, value, reason and way out."""


class UnknownName(ResultError, KeyError):
    """Error of a name that a table does not have."""
    __str__ = Exception.__str__


class Column(NDArrayOperatorsMixin):
    """Read-only array with a unit. Slices keep the unit; arithmetic returns plain arrays, whose units would differ."""

    def __init__(self, values: Any, unit: str = "", description: str = "") -> None:
        self.values = np.array(values)
        self.values.flags.writeable = False
        self.unit = unit  # as "N" or "m/s"; "-" for pure numbers, "" for text
        self.description = description  # empty where the file has none

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.array(self.values, dtype) if copy else np.asarray(self.values, dtype)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        options = {key: tuple(map(_plain, given)) if key == "out" else _plain(given) for key, given in options.items()}
        return getattr(ufunc, method)(*map(_plain, inputs), **options)

    def __getitem__(self, place: Any) -> Any:
        part = self.values[_plain(place)]
        return Column(part, self.unit, self.description) if isinstance(part, np.ndarray) else part

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name == "values":  # not yet there while a copy is made
            raise AttributeError(name)
        return getattr(self.values, name)

    def __len__(self) -> int:
        return len(self.values)

    def __repr__(self) -> str:
        return f"Column({self.values!r}, unit={self.unit!r})"


class Table(Mapping):
    """Entries by name, each read when first asked for. Raises UnknownName for a name that it does not have."""

    def __init__(self, path: Path, names: Iterable[str], read: Callable[[str], Any], hint: str = "") -> None:
        self._path, self._names, self._read, self._hint = path, list(names), cache(read), hint

    def __getitem__(self, name: str) -> Any:
        if name not in self:
            raise UnknownName(f"{self._path}: there is no '{name}'{self._hint}; there are: {', '.join(self)}")
        return self._read(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names


class Run:
    """Results of a `tread run`, each file read when first used.

    Raises ResultError if the folder holds no run, or a run that is not finished. With `partial`, reads the samples
    that an unfinished run has written so far; `summary` is empty then. A file that the run lacks raises ResultError.
    """

    summary: dict[str, Any]  # summary.json; names end in units, as "static_wheel_load_N"

    def __init__(self, folder: str | Path, partial: bool = False) -> None:
        self.folder = _existing(folder)
        if (self.folder / "sweep.csv").is_file() or _command(self.folder) in _TABLED:
            raise ResultError(f"{folder}: it holds a study; read it with Sweep('{folder}')")
        if "points" in _status(self.folder):
            raise ResultError(f"{folder}: {_other_study(self.folder)}")
        summary, checkpoint = self.folder / "summary.json", self.folder / "checkpoint"
        self._unfinished = not summary.is_file() or any(checkpoint.glob("*.h5"))  # as tread judges
        self.summary = {} if self._unfinished else _read_json(summary)
        if not (checkpoint.exists() or _status(self.folder) or "state_hash" in self.summary):
            raise ResultError(f"{folder}: it holds no run: neither status.json nor a summary.json with a state_hash; "
                              f"give the folder of `tread run -o`")
        if self._unfinished and not partial:
            raise ResultError(f"{folder}: the run is not finished ({_progress(self.folder)}); wait, go on with `tread "
                              f"resume {folder}`, or read the samples so far with Run('{folder}', partial=True)")

    @property
    def scene(self) -> str:
        """Text of scene.resolved.toml: every key with its value."""
        return _read_text(self._file(_SCENE))

    @cached_property
    def history(self) -> Table:
        """Histories of run.h5, columns [sample]: "time" [s] and, with a wheel on a rail, "wheel_x" [m]."""
        return self._datasets("run.h5", "histories")

    @cached_property
    def patch(self) -> Table:
        """Contact patch of patch.h5, on a window of the rail's surface nodes that moves with the wheel.

        "time" [s], "wheel_x" [m], "first_station" [-]: [sample], the samples of `history`
        "x" [m]: [sample, station], nodes of the window along the rail; beyond the rail, the place of its end
        "y" [m]: [row], nodes across the rail, field side positive; "rail_x" [m]: stations of the whole rail
        "pressure", "shear_along", "shear_across", "shear" (magnitude) [Pa]: [sample, station, row]
        "slip_along", "slip_across", "slip" (magnitude) [m/s]: [sample, station, row]
        "state" [-]: [sample, station, row], OUT, STICKS or SLIPS
        """
        file = self._datasets("patch.h5", "/")

        def read(name: str) -> Column:
            if name == "x":
                rail, first, stations = file["x"], file["first_station"], file["state"].shape[1]
                places = np.minimum(first[:, np.newaxis] + np.arange(stations), rail.size - 1)
                return Column(rail[places], rail.unit, "nodes of the window along the rail")
            if name in ("shear", "slip"):
                along, across = file[f"{name}_along"], file[f"{name}_across"]
                return Column(np.hypot(along, across), along.unit, f"magnitude of {name}_along and {name}_across")
            return file["x" if name == "rail_x" else name]

        return Table(self.folder / "patch.h5", [*file, "shear", "slip", "rail_x"], read)

    @cached_property
    def surface(self) -> Table:
        """Effects of the passage on the rail's surface, surface.h5.

        "x", "length" [m]: [station], "y", "width" [m]: [row], nodes that were in contact and the size of their areas
        "max_pressure", "max_shear" [Pa], "frictional_work", "frictional_work_sampled" [J/m2]: [station, row]
        "max_von_mises" [Pa]: [station - 1, row - 1], of the surface elements between the nodes
        """
        return self._datasets("surface.h5", "/")

    @cached_property
    def axis(self) -> Table:
        """Values on the patch's longitudinal axis, surface_axis.csv: columns [node], with "x" [m]."""
        return _read_csv(self._file("surface_axis.csv"))

    @cached_property
    def deflection(self) -> Table:
        """Height of the rail's surface about the wheel, deflection.csv: columns [place], in m."""
        return _read_csv(self._file("deflection.csv"))

    def over_x(self, name: str, x: Any) -> Column:
        """Returns history `name` at the places `x` [m] of the wheel's axis, in the shape of `x`.

        Interpolates linearly between samples; nan where the wheel has not been. Raises ResultError if the wheel
        does not move forwards from every sample to the next.
        """
        place, values = self.history["wheel_x"], self.history[name]
        if place.size == 0 or np.any(np.diff(place) <= 0):
            raise ResultError(f"{self.folder}: wheel_x [m] does not grow with each of {place.size} samples, so that a "
                              f"place names no sample; use the histories over time")
        return Column(np.interp(x, place, values, left=np.nan, right=np.nan), values.unit, values.description)

    def instant(self, x: float) -> int:
        """Returns the sample of `patch` and `history` at which the wheel's axis is nearest to `x` [m]."""
        return int(np.argmin(np.abs(self.patch["wheel_x"] - x)))

    def _file(self, name: str) -> Path:
        """Path of a file; raises ResultError with the reason if it is not there."""
        path = self.folder / name
        if path.is_file():
            return path
        if self._unfinished:
            reason = f"the run is not finished ({_progress(self.folder)}); wait, or `tread resume {self.folder}`"
        elif self.summary["steps"] == 0:
            patch = " and the patch; use Run.summary and Run.patch" if (self.folder / "patch.h5").is_file() else \
                " alone; use Run.summary"
            reason = f"a scene without [motion] leaves static values{patch}"
        elif "vertical_force_N" not in self.summary and name != "run.h5":
            reason = "only a wheel on a rail leaves it; use Run.history and Run.summary"
        else:
            reason = "it was moved or removed; run the scene again"
        raise ResultError(f"{path}: there is no such file: {reason}")

    def _datasets(self, name: str, group: str) -> Table:
        """Datasets of a group. Those that grow with the run are cut to the samples that all of them have."""
        path = self._file(name)
        with _opened(path) as file:
            names = list(file[group]) if group in file else []
            samples = {file[group][key].shape[0] for key in names if file[group][key].maxshape[0] is None}
        if not names or len(samples) > 1 and not self._unfinished:
            raise ResultError(f"{path}: '{group}' has {len(names)} datasets, of {sorted(samples)} samples: the file is "
                              f"damaged; run the scene again")

        def read(key: str) -> Column:
            with _opened(path) as file:
                data = file[group][key]
                values = data[:min(samples)] if data.maxshape[0] is None else data[()]
                return Column(values, _attribute(data, "unit"), _attribute(data, "description"))

        contact = self._unfinished or "vertical_force_N" in self.summary
        return Table(path, names, read, "" if contact else " in a run without a wheel on a rail")


class Sweep:
    """Results of a `tread sweep`, a row of sweep.csv for each point; nan for results of points that are not done.

    Raises ResultError if the folder holds no study, or a study that has no sweep.csv yet.
    """

    names: list[str]  # points, named as their folders
    states: list[str]  # "done", "failed", "interrupted", "running" or "waiting", by point
    varied: Table  # scene key -> column [point] in the unit of docs/reference/scene.md; nan where a number is absent
    results: Table  # name -> column [point] in SI; truths such as "passed" are 1 or 0, "state_hash" is text
    runs: Table  # point -> Run, opened when asked for

    def __init__(self, folder: str | Path) -> None:
        self.folder = _existing(folder)
        path = self.folder / "sweep.csv"
        if not path.is_file():
            status = _status(self.folder)
            if _command(self.folder) in _TABLED:
                counts = [status.get(state, 0) for state in ("done", "failed", "interrupted", "running", "waiting")]
                reason = (f"the study is not finished ({counts[0]} of {sum(counts)} points are done); wait or "
                          f"{_command(self.folder)} again")
            elif "points" in status:
                reason = _other_study(self.folder)
            else:
                reason = "it holds no study; give the folder of `tread sweep -o`"
            raise ResultError(f"{path}: there is no such file: {reason}")
        table = _read_csv(path)
        self.names, self.states = table["point"].tolist(), table["state"].tolist()
        keys = [name for name in table if "." in name]  # scene keys have dots, names of results have none
        self.varied = Table(path, keys, table.__getitem__)
        self.results = Table(path, [n for n in table if n not in ("point", "state", *keys)], table.__getitem__)
        self.runs = Table(path, self.names, lambda name: Run(self.folder / name))


def listing(folder: str | Path) -> list[tuple[str, str, str, str]]:
    """Returns file, dataset, shape and unit of everything that a run or a study has left so far."""
    rows = []
    for path in sorted(_existing(folder).iterdir()):
        if path.suffix == ".h5":
            with _opened(path) as file:
                names: list[str] = []
                file.visit(names.append)
                rows += [(path.name, name, str(file[name].shape), _attribute(file[name], "unit")) for name in names
                         if isinstance(file[name], h5py.Dataset)]
        elif path.suffix == ".csv":
            rows += [(path.name, name, str(values.shape), values.unit) for name, values in _read_csv(path).items()]
        elif path.name in ("summary.json", _SCENE, "frames.hdf.series") or (path / _SCENE).is_file():
            rows.append((path.name, "", "", ""))
    if not rows:
        raise ResultError(f"{folder}: it holds no results; give the folder of `tread run -o`")
    return rows


def _plain(value: Any) -> Any:
    return value.values if isinstance(value, Column) else value


@contextmanager
def _opened(path: Path) -> Iterator[h5py.File]:
    try:
        with h5py.File(path, "r", locking=False) as file:  # as tread: a run may be writing the file
            yield file
    except OSError as error:
        raise ResultError(f"{path}: it cannot be read as HDF5: {error}; if no run is writing it, run the scene again, "
                          f"otherwise try again") from error


def _attribute(dataset: h5py.Dataset, name: str) -> str:
    value = dataset.attrs.get(name, "")
    return value.decode() if isinstance(value, bytes) else str(value)


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ResultError(f"{path}: it cannot be read: {error}; check permissions or run the scene again") from error


def _read_json(path: Path) -> dict[str, Any]:
    try:
        return json.loads(_read_text(path))
    except json.JSONDecodeError as error:
        raise ResultError(f"{path}:{error.lineno}: it is not JSON: {error.msg}; run the scene again") from error


def _read_csv(path: Path) -> Table:
    """Columns of a table with a header `name [unit]`; text where there is no unit or a cell is no number."""
    header, *rows = csv.reader(_read_text(path).splitlines() or [""])
    for line, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise ResultError(f"{path}:{line}: {len(row)} values under {len(header)} columns: the table is damaged; "
                              f"run the scene again")
    columns = {}
    for head, cells in zip(header, zip(*rows) if rows else [()] * len(header)):
        name, bracket, unit = head.partition(" [")
        numbers: Any = cells
        if bracket:
            with suppress(ValueError):
                numbers = [np.nan if cell in ("", "absent") else float(cell) for cell in cells]
        columns[name] = Column(numbers, unit.rstrip("]"))
    return Table(path, columns, columns.__getitem__)


def _existing(folder: str | Path) -> Path:
    if not Path(folder).is_dir():
        raise ResultError(f"{folder}: there is no such folder; give that of `tread run -o` or `tread sweep -o`")
    return Path(folder)


def _status(folder: Path) -> dict[str, Any]:
    path = folder / "status.json"
    return _read_json(path) if path.is_file() else {}


def _command(folder: Path) -> str:
    """Command of a study, as "sweep", from its status.json; empty for a run."""
    status = _status(folder)
    return str(status.get("command", "sweep")) if "points" in status else ""


def _other_study(folder: Path) -> str:
    """Sentence on a folder of `tread develop`, which leaves no sweep.csv."""
    runs = [path.name for path in sorted(folder.iterdir()) if (path / _SCENE).is_file()]
    return (f"it holds results of `tread {_command(folder)}`, which are no table of points; read its files, or a "
            f"run in it with Run('{folder / runs[-1] if runs else folder / 'RUN'}')")


def _progress(folder: Path) -> str:
    """Stage of an unfinished run and how far it is, from status.json."""
    status = _status(folder)
    time, duration = status.get("time_s", 0.0), status.get("duration_s", 0.0)
    if duration > 0:
        return f"{status.get('stage')}: {1e3 * time:.4g} of {1e3 * duration:.4g} ms, {100 * time / duration:.0f} %"
    return f"{status.get('stage')}: {status['text']}" if "text" in status else "status.json does not say how far"


def main() -> None:
    parser = argparse.ArgumentParser(description="Lists files, datasets, shapes and units of a run or a study.")
    parser.add_argument("folder", help="folder of `tread run -o` or `tread sweep -o`")
    try:
        for row in [("file", "dataset", "shape", "unit"), *listing(parser.parse_args().folder)]:
            print("{:20} {:36} {:16} {}".format(*row).rstrip())
    except ResultError as error:
        parser.error(str(error))


if __name__ == "__main__":
    main()
