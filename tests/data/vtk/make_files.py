# VTKHDF files as h5py writes them after VTK's description of the format, without anything of Sandglass, and checked
# with VTK's own reader; and a collection (.pvd) whose parts ParaView's legacy and XML forms hold. Run in Debian 13
# (python3-h5py, python3-vtk9 9.3): python3 make_files.py
import h5py
import numpy as np

STEPS = 3


def positions(step, count):
    k = np.arange(count)
    return np.column_stack((0.001 * k, 0.002 * (k % 3) + 0.0005 * step, 0.01 - 0.001 * step + 0 * k))


def root(name, kind):
    file = h5py.File(name, "w", libver="latest")
    group = file.create_group("VTKHDF", track_order=True)
    group.attrs["Version"] = (2, 0)
    group.attrs.create("Type", np.bytes_(kind), dtype=h5py.string_dtype("ascii", len(kind)))
    return file, group


def empty_cells(group, parts):
    for name in ("Vertices", "Lines", "Polygons", "Strips"):
        cells = group.create_group(name)
        cells["NumberOfCells"] = np.zeros(parts, "i8")
        cells["NumberOfConnectivityIds"] = np.zeros(parts, "i8")
        cells["Offsets"] = np.zeros(parts, "i8")
        cells["Connectivity"] = np.zeros(0, "i8")


# An unstructured grid of two parts, single precision and compressed: 5 and 4 vertices.
file, group = root("grid.vtkhdf", "UnstructuredGrid")
points = positions(0, 9)
group["NumberOfPoints"] = np.array([5, 4], "i8")
group["NumberOfCells"] = np.array([5, 4], "i8")
group["NumberOfConnectivityIds"] = np.array([5, 4], "i8")
group["Offsets"] = np.concatenate((np.arange(6), np.arange(5)))
group["Connectivity"] = np.concatenate((np.arange(5), np.arange(4)))
group["Types"] = np.ones(9, "u1")
group.create_dataset("Points", data=points.astype("f4"), compression="gzip", chunks=(4, 3))
data = group.create_group("PointData")
data["Radius"] = np.full(9, 0.0005)
data["Velocity"] = np.column_stack((np.arange(9.0), np.zeros(9), -np.arange(9.0)))
data["stress"] = np.zeros((9, 9))
data["id"] = np.arange(100, 109)
group.create_group("FieldData")["TimeValue"] = np.array([0.25])
file.close()

# Poly data with steps in time, where the number of grains changes; the radii of all steps are stored once.
file, group = root("steps.vtkhdf", "PolyData")
counts = [4, 6, 5]
group["NumberOfPoints"] = np.array(counts, "i8")
group["Points"] = np.concatenate([positions(s, n) for s, n in enumerate(counts)])
empty_cells(group, STEPS)
data = group.create_group("PointData")
data["diameter"] = np.linspace(0.001, 0.0015, 6)
data["velocity"] = np.concatenate([np.tile((0.0, 0.0, -float(s)), (n, 1)) for s, n in enumerate(counts)])
steps = group.create_group("Steps")
steps.attrs["NSteps"] = STEPS
first = np.concatenate(([0], np.cumsum(counts)[:-1]))
steps["Values"] = np.array([0.0, 0.5, 1.5])
steps["PartOffsets"] = np.arange(STEPS)
steps["NumberOfParts"] = np.ones(STEPS, "i8")
steps["PointOffsets"] = first
for name in ("CellOffsets", "ConnectivityIdOffsets"):
    steps[name] = np.zeros((STEPS, 4), "i8")
offsets = steps.create_group("PointDataOffsets")
offsets["diameter"] = np.zeros(STEPS, "i8")
offsets["velocity"] = first
file.close()

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

for name, step, count in (("grid", 0, 9), ("steps", 0, 4), ("steps", 1, 6), ("steps", 2, 5)):
    reader = vtkHDFReader()
    reader.SetFileName(name + ".vtkhdf")
    reader.UpdateInformation()
    reader.SetStep(step)
    reader.Update()
    seen = reader.GetOutputDataObject(0)
    if seen.IsA("vtkPartitionedDataSet"):
        seen = [seen.GetPartition(k) for k in range(seen.GetNumberOfPartitions())]
    else:
        seen = [seen]
    xyz = np.concatenate([vtk_to_numpy(s.GetPoints().GetData()) for s in seen if s.GetNumberOfPoints()])
    assert np.allclose(xyz, positions(step, count), atol=1e-9), (name, step, xyz)
print("VTK reads them alike")

# A collection of two times, the second in two parts; the files beside it are legacy VTK.
with open("run.pvd", "w") as out:
    out.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n <Collection>\n')
    for time, part, name in ((0, 0, "a0"), (0.125, 0, "b0"), (0.125, 1, "b1")):
        out.write(f'  <DataSet timestep="{time}" group="" part="{part}" file="{name}.vtk"/>\n')
    out.write(" </Collection>\n</VTKFile>\n")
for name, step, count in (("a0", 0, 3), ("b0", 1, 2), ("b1", 2, 1)):
    points = positions(step, count)
    with open(name + ".vtk", "w") as out:
        out.write(f"# vtk DataFile Version 3.0\n{name}\nASCII\nDATASET POLYDATA\nPOINTS {count} double\n")
        for p in points:
            out.write("{:.6g} {:.6g} {:.6g}\n".format(*p))
        out.write(f"POINT_DATA {count}\nSCALARS radius double 1\nLOOKUP_TABLE default\n" + "0.0005\n" * count)
