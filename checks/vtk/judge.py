"""Reads a map exported as .vtu with VTK and with PyVista and compares it with the same map as .csv and with `isolux probe`.

Usage: python judge.py --isolux PATH MAP.glb MAP.vtu MAP.csv"""

import argparse
import csv
import json
import math
import subprocess
import sys

import numpy
import pyvista

# These need no graphics.
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

FIELDS = ("illuminance_lx", "standard_error_lx", "direct_lx", "indirect_lx")
COLOURS = ("red_lx", "green_lx", "blue_lx")
# Points asked of `probe`, spread evenly over the cells.
PLACES = 400
# VTK interpolates in double precision between vertices that the map keeps in single precision.
TOLERANCE = 1e-4
# A reader leaves out the vertices in gaps and solids of an element of which others lie in the open; a
# viewer of the bare grid cannot know of them. Such elements are few.
SHARE = 0.9


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--isolux", required=True)
    parser.add_argument("map")
    parser.add_argument("vtu")
    parser.add_argument("csv")
    flags = parser.parse_args()
    grid = read(flags.vtu)
    rows = list(csv.DictReader(open(flags.csv)))
    vertices = compare_vertices(grid, rows)
    values = compare_arrays(pyvista.read(flags.vtu), rows)
    known = compare_places(grid, flags)
    print(f"VTK {vtkVersion().GetVTKVersion()}: {vertices} vertices as in the table, "
          f"{grid.GetNumberOfCells()} triangles, {known} places as `probe` reads them; "
          f"PyVista {pyvista.__version__}: {values} values have the bits of the table")


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    complaints = []
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append("warning"))
    reader.SetFileName(path)
    reader.Update()
    if complaints or reader.GetErrorCode():
        sys.exit(f"{path}: VTK complains: {complaints}, error code {reader.GetErrorCode()}")
    grid = reader.GetOutput()
    if grid.GetNumberOfPoints() == 0 or grid.GetNumberOfCells() == 0:
        sys.exit(f"{path}: VTK finds nothing in it")
    return grid


def compare_vertices(grid, rows):
    """Every number of the table is in the grid, to the last digit, and nothing else is."""
    count = grid.GetNumberOfPoints()
    if len(rows) != count:
        sys.exit(f"{count} vertices in the grid, {len(rows)} in the table")
    data = grid.GetPointData()
    arrays = {name: data.GetArray(name) for name in (*FIELDS, "rgb_lx", "Normals")}
    missing = [name for name, array in arrays.items() if array is None]
    if missing:
        sys.exit(f"the grid has no {missing}")
    for k, row in enumerate(rows):
        pairs = [(row[name], arrays[name].GetValue(k)) for name in FIELDS]
        pairs += zip((row[name] for name in COLOURS), arrays["rgb_lx"].GetTuple(k))
        pairs += zip((row[name] for name in "xyz"), grid.GetPoint(k))
        for text, number in pairs:
            same = math.isnan(number) if text == "" else float(text) == number
            if not same:
                sys.exit(f"vertex {k}: {text or 'nothing'} in the table, {number} in the grid")
    return count


def compare_arrays(mesh, rows):
    """What PyVista makes of the file: arrays of numbers that have the bits of those in the table, unknown ones NaN."""
    if not isinstance(mesh, pyvista.UnstructuredGrid):
        sys.exit(f"PyVista reads a {type(mesh).__name__}")
    found = {name: mesh.point_data[name] for name in FIELDS}
    found |= {name: mesh.point_data["rgb_lx"][:, k] for k, name in enumerate(COLOURS)}
    found |= {axis: mesh.points[:, k] for k, axis in enumerate("xyz")}
    for name, numbers in found.items():
        due = numpy.array([float(row[name] or "nan") for row in rows])
        numbers = numpy.ascontiguousarray(numbers)
        if numbers.dtype != numpy.float64 or numbers.shape != due.shape:
            sys.exit(f"PyVista reads {name} as {numbers.shape} of {numbers.dtype}, not {due.shape} of float64")
        # A NaN has many bits.
        same = (numbers.view(numpy.uint64) == due.view(numpy.uint64)) | (numpy.isnan(numbers) & numpy.isnan(due))
        if not same.all():
            sys.exit(f"PyVista: {name} of vertices {numpy.flatnonzero(~same)[:5]} differs from the table")
    if set(mesh.celltypes) != {VTK_TRIANGLE} or not (mesh.cells.reshape(-1, 4)[:, 1:] < len(rows)).all():
        sys.exit("PyVista finds other cells than triangles of the vertices")
    return len(found) * len(rows)


def compare_places(grid, flags):
    """In the middle of cells VTK interpolates what `probe --interpolated` reads."""
    illuminance, normals = (grid.GetPointData().GetArray(name) for name in ("illuminance_lx", "Normals"))
    places, values = [], []
    for cell in range(0, grid.GetNumberOfCells(), max(1, grid.GetNumberOfCells() // PLACES)):
        corners = grid.GetCell(cell)
        if corners.GetCellType() != VTK_TRIANGLE:
            sys.exit(f"cell {cell} is no triangle")
        ids = [corners.GetPointId(k) for k in range(3)]
        value = sum(illuminance.GetValue(k) for k in ids) / 3
        if math.isnan(value):
            continue
        middle = [sum(grid.GetPoint(k)[axis] for k in ids) / 3 for axis in range(3)]
        normal = [sum(normals.GetTuple(k)[axis] for k in ids) / 3 for axis in range(3)]
        places.append(" ".join(map(repr, middle + normal)))
        values.append(value)
    command = [flags.isolux, "probe", flags.map, "--points", "-", "--interpolated", "--json"]
    said = subprocess.run(command, input="\n".join(places), capture_output=True, text=True)
    if said.returncode != 0:
        sys.exit(said.stderr)
    read = [point["illuminance_lx"] for point in json.loads(said.stdout)["points"]]
    same = sum(a is not None and abs(a - b) <= TOLERANCE * max(abs(b), 1.0) for a, b in zip(read, values))
    if not values or same < SHARE * len(values):
        sys.exit(f"VTK and `probe` agree at {same} of {len(values)} places only")
    return f"{same} of {len(values)}"


if __name__ == "__main__":
    main()
