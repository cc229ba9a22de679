"""Compares frames as vtkHDFReader reads them with the rows that `sandglass convert` wrote.

usage: vtkhdf_compare.py FOLDER DOCUMENTATION
FOLDER holds ours.csv (all frames), run/frames/*.vtkhdf and merged.vtkhdf. Prints one row a case and quantity;
exits 1 when a verdict is off. Everything must agree to the last bit: both sides read the same stored numbers.
"""

import collections
import contextlib
import csv
import io
import pathlib
import re
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOHDF import vtkHDFReader

source = "vtkHDFReader " + vtkVersion.GetVTKVersion()
failed = False


def row(case, quantity, ours, expected, who=source):
    global failed
    good = ours == expected
    failed |= not good
    csv.writer(sys.stdout, lineterminator="\n").writerow(
        [case, quantity, ours, "", expected, 0, who, "ok" if good else "off"])


def read_ours(file):
    """Frames by step: time and columns."""
    frames = collections.defaultdict(list)
    with open(file) as lines:
        rows = csv.reader(line for line in lines if not line.startswith("#"))
        header = next(rows)
        for cells in rows:
            frames[int(cells[1])].append([float(c) for c in cells])
    columns = {name: k for k, name in enumerate(header)}
    return [numpy.array(frames[step]) for step in sorted(frames)], columns


def read_vtk(file):
    """One (time, polydata) a step."""
    reader = vtkHDFReader()
    reader.SetFileName(str(file))
    reader.UpdateInformation()
    for step in range(reader.GetNumberOfSteps()):
        reader.SetStep(step)
        reader.Update()
        data = reader.GetOutput().NewInstance()
        data.DeepCopy(reader.GetOutput())
        yield reader.GetTimeValue(), data


def bounds(points):
    return [x for k in range(3) for x in (points[:, k].min(), points[:, k].max())]


def compare(case, ours, columns, frames):
    vectors = sorted({name[:-2] for name in columns if name.endswith(".x")})
    scalars = [n for n in columns if "." not in n and n not in ("time", "step", "x", "y", "z")]
    row(case, "steps", len(ours), len(frames))
    equal = collections.Counter()
    for mine, (time, data) in zip(ours, frames):
        points = vtk_to_numpy(data.GetPoints().GetData())
        equal["time"] += mine[0, columns["time"]] == time
        equal["number of points"] += len(mine) == data.GetNumberOfPoints() == data.GetNumberOfVerts()
        position = mine[:, [columns[c] for c in "xyz"]]
        equal["points"] += numpy.array_equal(position, points)
        equal["bounds"] += bounds(position) == list(data.GetBounds())
        arrays = data.GetPointData()
        for name in scalars:
            equal[name] += numpy.array_equal(mine[:, columns[name]], vtk_to_numpy(arrays.GetArray(name)))
        for name in vectors:
            three = mine[:, [columns[name + c] for c in (".x", ".y", ".z")]]
            equal[name] += numpy.array_equal(three, vtk_to_numpy(arrays.GetArray(name)))
    for quantity, count in equal.items():
        row(case, "steps with equal " + quantity, count, len(ours))


def run_documentation(file, folder, ours, columns):
    """The lines of Python that the documentation shows, on the merged file."""
    code = re.search(r"```python\n(.*?)```", pathlib.Path(file).read_text(), re.S).group(1)
    code = code.replace("DIR/frames/00000.vtkhdf", str(folder / "merged.vtkhdf"))
    names, printed = {}, io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(code, names)
    row("documentation", "frames that its h5py lines read", len(printed.getvalue().splitlines()), len(ours), "ours.csv")
    last = ours[-1][:, [columns[c] for c in "xyz"]]
    row("documentation", "positions of the last frame equal", int(numpy.array_equal(last, names["position"])), 1, "ours.csv")


def main():
    folder = pathlib.Path(sys.argv[1])
    ours, columns = read_ours(folder / "ours.csv")
    print("case,quantity,ours,uncertainty,expected,tolerance,source,verdict")
    segments = sorted((folder / "run" / "frames").glob("*.vtkhdf"))
    compare("segments", ours, columns, [frame for file in segments for frame in read_vtk(file)])
    compare("merged", ours, columns, list(read_vtk(folder / "merged.vtkhdf")))
    run_documentation(sys.argv[2], folder, ours, columns)
    sys.exit(1 if failed else 0)


main()
