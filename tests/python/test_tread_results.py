"""test_tread_results.py TREAD: makes small runs with that program and reads them with share/python/tread_results.py.

Exit status 77: numpy or h5py is not installed (Debian: python3-numpy python3-h5py).
"""

import contextlib
import copy
import csv
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TYRE = ["tyre.toml", "--set", "scene.element_size=8mm", "--set", "motion.duration=0.5ms",
        "--set", "solution_zone.start=0m", "--set", "output.frames=2"]
STUDY = """
[study]
scene = "{scene}"

[set]
scene.element_size = "8 mm"
solution_zone.start = "0 m"
motion.duration = "0.2 ms"
output.frames = 0

[grid]
motion.speed = ["200 km/h", "300 km/h"]
contact.friction = [0.5, 0.3]
"""

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "share" / "python"))
try:
    import numpy as np

    import tread_results
    from tread_results import Column, ResultError, Run, Sweep
except ModuleNotFoundError as missing:
    if missing.name not in ("numpy", "h5py"):
        raise
    print(f"skipped: python3 has no {missing.name}; the Debian packages python3-numpy and python3-h5py have it")
    sys.exit(77)

tread: str  # the program
folder: pathlib.Path  # of all runs


def call(*arguments, code=0):
    environment = {**os.environ, "TREAD_CACHE": "off", "OMP_WAIT_POLICY": "passive"}
    ended = subprocess.run([tread, *arguments, "-t", "1", "--quiet"], env=environment, cwd=folder, text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if ended.returncode != code:
        raise AssertionError(f"{ended.args} ended with {ended.returncode} in place of {code}: {ended.stdout}")


def run(name, scene, *options, code=0):
    call("run", str(ROOT / "scenes" / scene), *options, "-o", name, code=code)


def setUpModule():
    run("out", *TYRE)
    run("single", *TYRE, "--precision", "single")
    run("stopped", *TYRE, "--set", "stop.steps=200", code=4)
    run("bar", "bar-wave.toml", "--set", "output.frames=0")
    run("static", "sphere-on-block.toml", "--set", "scene.element_size=8mm")
    (folder / "study.toml").write_text(STUDY.format(scene=ROOT / "scenes" / "tyre.toml"))
    call("sweep", "study.toml", "-j", "1", "-o", "study")


class Test(unittest.TestCase):
    def refuses(self, action, *words):
        """The error of `action`, whose text has all words."""
        with self.assertRaises(ResultError) as caught:
            action()
        for word in words:
            self.assertIn(str(word), str(caught.exception))

    def copy(self, source):
        """A copy of a run's folder, to be damaged."""
        target = pathlib.Path(tempfile.mkdtemp(dir=folder)) / "copy"
        shutil.copytree(folder / source, target)
        return target


class Columns(Test):
    def setUp(self):
        self.column = Column([3.0, 1.0, 2.0], "N", "a force")

    def test_slices_keep_the_unit(self):
        c = self.column
        for part in (c[1:], c[c > 1], c[np.newaxis], copy.deepcopy(c)):
            self.assertEqual((part.unit, part.description), ("N", "a force"))
        self.assertEqual(self.column[1], 1.0)

    def test_arithmetic_returns_plain_arrays(self):
        for result in (2 * self.column, self.column / self.column, -self.column, np.diff(self.column),
                       np.gradient(self.column), self.column.argsort(), np.concatenate([self.column, self.column])):
            self.assertIs(type(result), np.ndarray)
        self.assertEqual(np.mean(self.column), 2.0)
        self.assertEqual(self.column.max(), 3.0)
        np.testing.assert_array_equal(np.asarray(self.column, dtype=np.float32), [3, 1, 2])

    def test_values_cannot_be_changed(self):
        with self.assertRaises(ValueError):
            self.column *= 2
        with self.assertRaises(TypeError):
            self.column[0] = 5.0


class WheelOnRail(Test):
    def setUp(self):
        self.run = Run(folder / "out")

    def test_histories_are_those_of_the_table(self):
        for name in ("out", "single", "bar"):
            history = Run(folder / name).history
            with open(folder / name / "histories.csv", encoding="utf-8", newline="") as file:
                header, *rows = csv.reader(file)
            self.assertEqual({f"{key} [{column.unit}]" for key, column in history.items()}, set(header))
            for head, cells in zip(header, zip(*rows)):
                column = history[head.split(" [")[0]]
                np.testing.assert_allclose(column, np.array(cells, float), rtol=5.1e-9, atol=0)  # nine digits
                self.assertTrue(column.description)

    def test_summary_states_the_mean_of_the_histories(self):
        first, last = self.run.summary["evaluated_x_m"]
        x, force = self.run.history["wheel_x"], self.run.history["vertical_force"]
        inside = (x >= first - 1e-9) & (x <= last + 1e-9)
        self.assertEqual(force.unit, "N")
        for name in ("mean", "min", "max"):
            stated = self.run.summary["vertical_force_N"][name]
            self.assertAlmostEqual(getattr(force[inside], name)() / stated, 1, delta=1e-12)

    def test_patch_has_the_samples_of_the_histories(self):
        patch, history = self.run.patch, self.run.history
        for name in ("time", "wheel_x"):
            np.testing.assert_array_equal(patch[name], history[name])
        samples, stations, rows = patch["pressure"].shape
        self.assertEqual((samples, rows), (history["time"].size, patch["y"].size))
        self.assertEqual(patch["x"].shape, (samples, stations))
        units = {"pressure": "Pa", "shear_along": "Pa", "shear": "Pa", "slip_along": "m/s", "slip": "m/s", "state": "-"}
        for name, unit in units.items():
            self.assertEqual((patch[name].shape, patch[name].unit), ((samples, stations, rows), unit))
        np.testing.assert_allclose(patch["pressure"].max(axis=(1, 2)), history["max_pressure"], rtol=1e-6)
        np.testing.assert_allclose(patch["shear"].max(axis=(1, 2)), history["max_shear"], rtol=1e-6)
        for name, out in (("pressure", 0), ("state", tread_results.OUT)):
            np.testing.assert_array_equal(patch[name] == out, patch["pressure"] == 0)

    def test_window_moves_with_the_wheel(self):
        patch = self.run.patch
        x, wheel = patch["x"], patch["wheel_x"]
        self.assertEqual((x.unit, patch["y"].unit), ("m", "m"))
        self.assertTrue(np.all(np.diff(x, axis=1) > 0))
        self.assertGreater(x[-1, 0], x[0, 0])
        load = patch["pressure"].sum(axis=2)
        centre = (load * x).sum(axis=1) / load.sum(axis=1)
        np.testing.assert_allclose(centre, wheel, atol=4e-3)  # half an element
        for i in (0, 7, wheel.size - 1):
            self.assertEqual(self.run.instant(wheel[i] + 1e-6), i)
            np.testing.assert_array_equal(x[i], patch["rail_x"][patch["first_station"][i]:][:x.shape[1]])

    def test_histories_over_the_wheels_position(self):
        x, force = self.run.history["wheel_x"], self.run.history["vertical_force"]
        resampled = self.run.over_x("vertical_force", [x[3], 0.5 * (x[3] + x[4]), x[0] - 1, x[-1] + 1])
        self.assertEqual(resampled.unit, "N")
        np.testing.assert_allclose(resampled, [force[3], 0.5 * (force[3] + force[4]), np.nan, np.nan], rtol=1e-12)

    def test_surface_and_tables(self):
        surface, axis = self.run.surface, self.run.axis
        stations, rows = surface["x"].size, surface["y"].size
        self.assertEqual(surface["frictional_work"].shape, (stations, rows))
        self.assertEqual(surface["max_von_mises"].shape, (stations - 1, rows - 1))
        self.assertEqual((surface["frictional_work"].unit, axis["frictional_work"].unit), ("J/m2", "J/m2"))
        area = np.outer(surface["length"], surface["width"])
        stated = self.run.summary["surface"]["frictional_work_every_step_J"]
        self.assertAlmostEqual((surface["frictional_work"] * area).sum() / stated, 1, delta=1e-9)
        np.testing.assert_allclose(axis["x"], surface["x"], rtol=1e-8)
        row = np.argmin(np.abs(surface["y"] - self.run.summary["surface"]["axis_y_m"]))
        np.testing.assert_allclose(axis["max_pressure"], surface["max_pressure"][:, row], rtol=1e-8)
        self.assertEqual({column.unit for column in self.run.deflection.values()}, {"m"})

    def test_scene_is_the_resolved_one(self):
        self.assertIn("[motion]", self.run.scene)


class OtherRuns(Test):
    def test_without_a_wheel(self):
        bar = Run(folder / "bar")
        self.assertEqual(bar.history["strain_energy"].unit, "J")
        self.refuses(lambda: bar.over_x("strain_energy", 0), "run.h5", "wheel_x", "without a wheel", "strain_energy")
        self.refuses(lambda: bar.patch, folder / "bar" / "patch.h5", "only a wheel on a rail", "Run.history")

    def test_static_alone(self):
        static = Run(folder / "static")
        self.assertGreater(static.summary["static_max_pressure_Pa"], 0)
        self.assertEqual(static.patch["time"].size, 1)
        self.assertGreater(static.patch["pressure"].max(), 0)
        self.refuses(lambda: static.history, "run.h5", "[motion]", "use Run.summary and Run.patch")
        self.refuses(lambda: static.surface, "surface.h5", "[motion]", "static values and the patch")

    def test_unfinished(self):
        self.refuses(lambda: Run(folder / "stopped"), folder / "stopped", "not finished", "stop.steps", "tread resume")
        partial, whole = Run(folder / "stopped", partial=True), Run(folder / "out")
        force = partial.history["vertical_force"]
        np.testing.assert_array_equal(force, whole.history["vertical_force"][:force.size])
        np.testing.assert_array_equal(partial.patch["x"][:, 0], whole.patch["x"][:force.size, 0])
        self.refuses(lambda: partial.surface, "surface.h5", "not finished", "tread resume")

    def test_progress_of_a_rolling_run(self):
        place = self.copy("stopped")
        (place / "status.json").write_text('{"stage": "rolling", "time_s": 0.012, "duration_s": 0.04}')
        self.refuses(lambda: Run(place), place, "rolling", "12 of 40 ms", "30 %", "partial=True")
        (place / "status.json").unlink()
        self.refuses(lambda: Run(place), place, "status.json does not say", "partial=True")


class Studies(Test):
    def test_points_have_their_keys_and_results(self):
        sweep = Sweep(folder / "study")
        self.assertEqual(sweep.states, ["done"] * 4)
        self.assertEqual(list(sweep.varied), ["motion.speed", "contact.friction"])
        self.assertEqual([sweep.varied[key].unit for key in sweep.varied], ["km/h", "-"])
        np.testing.assert_array_equal(sweep.varied["motion.speed"], [200, 200, 300, 300])
        self.assertEqual(sweep.results["vertical_force_max"].unit, "N")
        for i, (name, point) in enumerate(sweep.runs.items()):
            self.assertIn(name, sweep.names)
            stated = point.summary["vertical_force_N"]["max"]
            self.assertAlmostEqual(sweep.results["vertical_force_max"][i] / stated, 1, delta=5.1e-9)
            self.assertEqual(sweep.results["state_hash"][i], point.summary["state_hash"])
            self.assertEqual(sweep.results["warnings"][i], len(point.summary["warnings"]))
            for truth in ("passed", "traction_steady"):
                self.assertEqual(sweep.results[truth][i], point.summary[truth])

    def test_points_that_are_not_done_have_nan(self):
        place = self.copy("study")
        (place / "sweep.csv").write_text('point,state,wheel.profile [-],scene.title [-],corrugation.depth [mm],dt [s],'
                                         'state_hash\na,done,arc,"b, c",absent,2e-7,12\nb,failed,lma,d,0.1,,\n')
        sweep = Sweep(place)
        self.assertEqual(sweep.varied["wheel.profile"].tolist(), ["arc", "lma"])
        self.assertEqual(sweep.varied["scene.title"][0], "b, c")
        np.testing.assert_array_equal(sweep.varied["corrugation.depth"], [np.nan, 0.1])
        np.testing.assert_array_equal(sweep.results["dt"], [2e-7, np.nan])
        self.assertEqual(sweep.results["state_hash"].tolist(), ["12", ""])
        self.refuses(lambda: sweep.runs["b"], place / "b", "no such folder")

    def test_unfinished_study(self):
        place = self.copy("study")
        (place / "sweep.csv").unlink()
        self.refuses(lambda: Sweep(place), place / "sweep.csv", "4 of 4", "sweep again")

    def test_run_and_study_are_not_confused(self):
        self.refuses(lambda: Run(folder / "study"), folder / "study", "Sweep(")
        self.refuses(lambda: Sweep(folder / "out"), folder / "out", "no study", "tread sweep -o")

    def test_development_is_no_study_with_points(self):
        place = self.copy("study")
        (place / "sweep.csv").unlink()
        (place / "status.json").write_text('{"stage": "ended", "command": "develop", "done": 2, "waiting": 3, '
                                           '"points": [{"name": "passage-0001", "state": "done"}]}')
        for reader in (Run, Sweep):
            self.refuses(lambda reader=reader: reader(place), place, "results of `tread develop`", "Run('")
        (place / "status.json").write_text('{"command": "sweep", "done": 2, "waiting": 3, "points": []}')
        self.refuses(lambda: Sweep(place), "2 of 5 points are done", "sweep again")
        (place / "status.json").write_text('{"command": "paper", "done": 2, "waiting": 3, "points": []}')
        self.refuses(lambda: Run(place), place, "Sweep(")
        self.refuses(lambda: Sweep(place), "2 of 5 points are done", "paper again")


class BrokenFolders(Test):
    def test_no_run(self):
        self.refuses(lambda: Run(folder / "nowhere"), folder / "nowhere", "no such folder", "tread run -o")
        self.refuses(lambda: Run(tempfile.mkdtemp(dir=folder)), folder, "no run", "summary.json", "tread run -o")

    def test_unknown_name(self):
        history = Run(folder / "out").history
        self.refuses(lambda: history["force"], "run.h5", "'force'", "vertical_force")
        self.assertNotIn("force", history)
        self.assertIsNone(history.get("force"))

    def test_missing_file(self):
        place = self.copy("out")
        (place / "run.h5").unlink()
        self.refuses(lambda: Run(place).history, place / "run.h5", "moved or removed", "run the scene again")

    def test_damaged_files(self):
        place = self.copy("out")
        for name in ("run.h5", "patch.h5"):
            with open(place / name, "r+b") as file:
                file.truncate(3000)
        self.refuses(lambda: Run(place).history, place / "run.h5", "HDF5", "run the scene again")
        self.refuses(lambda: Run(place).patch, place / "patch.h5", "HDF5")
        text = (place / "surface_axis.csv").read_text()
        (place / "surface_axis.csv").write_text(text[:text.rindex(",")])
        self.refuses(lambda: Run(place).axis, place / "surface_axis.csv:", "columns", "run the scene again")
        (place / "summary.json").write_text('{"title": ')
        self.refuses(lambda: Run(place), place / "summary.json:1", "JSON", "run the scene again")


class CommandLine(Test):
    def printed(self, *arguments):
        return subprocess.run([sys.executable, "-B", ROOT / "share/python/tread_results.py", *arguments], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)

    def test_lists_what_is_there(self):
        lines = [line.split(maxsplit=2) for line in self.printed(folder / "out").stdout.splitlines()]
        patch = Run(folder / "out").patch
        self.assertIn(["patch.h5", "pressure", f"{patch['pressure'].shape!s:16} Pa"], lines)
        self.assertIn(["run.h5", "histories/vertical_force", f"({patch['time'].size},)            N"], lines)
        self.assertIn("frames.hdf.series", [line[0] for line in lines])
        for name in ("bar", "static", "stopped", "study"):
            ended = self.printed(folder / name)
            self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("motion.speed", ended.stdout)

    def test_refuses_a_folder_without_results(self):
        ended = self.printed(tempfile.mkdtemp(dir=folder))
        self.assertEqual(ended.returncode, 2)
        self.assertIn("holds no results", ended.stderr)


class Page(Test):
    def test_blocks_of_the_how_to_run_in_order(self):
        try:
            import matplotlib
        except ModuleNotFoundError:
            self.skipTest("python3 has no matplotlib; the Debian package python3-matplotlib has it")
        matplotlib.use("Agg")
        page = (ROOT / "docs" / "how-to" / "read-results-in-python.md").read_text(encoding="utf-8")
        names, before, printed = {}, os.getcwd(), io.StringIO()
        try:
            os.chdir(folder)
            with contextlib.redirect_stdout(printed):
                for block in re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
                    exec(compile(block, "read-results-in-python.md", "exec"), names)  # noqa: S102
        finally:
            os.chdir(before)
        self.assertIn("motion.speed Column(array([200., 200., 300., 300.]), unit='km/h')", printed.getvalue())
        for picture in ("forces.png", "patch.png"):
            self.assertGreater((folder / picture).stat().st_size, 5000)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tread = str(pathlib.Path(sys.argv.pop(1)).resolve())
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made).resolve()
        unittest.main(exit=False).result.wasSuccessful() or sys.exit(1)
