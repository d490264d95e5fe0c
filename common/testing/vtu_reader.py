"""A .vtu of ours as VTK itself reads it: what shape its cells have, by VTK's own order of nodes.

usage: vtu_reader.py FILE...    exits with 77 where VTK is missing
"""
import math
import sys

try:
    import vtk
except ImportError:
    print("skipped: VTK for Python (python3-vtk9) is missing")
    sys.exit(77)


def corners_of(cell):
    return {9: 4, 28: 4, 29: 8}[cell.GetCellType()]


def blend(corners, place):
    """The (bi- or tri-) linear map of the corners, in VTK's order, at a parametric place in [0, 1]^d."""
    signs = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    d = 2 if len(corners) == 4 else 3
    point = [0.0, 0.0, 0.0]
    for corner, sign in zip(corners, signs):
        weight = math.prod(place[i] if sign[i] else 1 - place[i] for i in range(d))
        point = [p + weight * c for p, c in zip(point, corner)]
    return point


def check(name):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfCells() > 0 and grid.GetNumberOfPoints() > 0, "nothing in it"
    farthest = 0.0
    for number in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(number)
        count, nodes = corners_of(cell), cell.GetNumberOfPoints()
        assert nodes in (4, 9, 27), f"cell {number} has {nodes} nodes"
        points = [cell.GetPoints().GetPoint(i) for i in range(nodes)]
        places = cell.GetParametricCoords()
        size = math.dist(points[0], points[2])
        for i in range(nodes):  # a node off its place is far from where the corners have it
            expected = blend(points[:count], places[3 * i:3 * i + 3])
            farthest = max(farthest, math.dist(points[i], expected) / size)
        center, sub, weights = [0.0] * 3, vtk.mutable(0), [0.0] * nodes
        cell.EvaluateLocation(sub, [0.5] * 3, center, weights)
        farthest = max(farthest, math.dist(center, blend(points[:count], [0.5] * 3)) / size)
    assert farthest < 0.2, f"a node is {farthest} cell sizes from where VTK expects it"
    for fields, count in ((grid.GetPointData(), grid.GetNumberOfPoints()),
                          (grid.GetCellData(), grid.GetNumberOfCells())):
        for i in range(fields.GetNumberOfArrays()):
            array = fields.GetArray(i)
            assert array.GetNumberOfTuples() == count, f"{array.GetName()} has a wrong length"
    print(f"{name}: {grid.GetNumberOfCells()} cells, nodes within {farthest:.2g} of their places")


for name in sys.argv[1:]:
    check(name)
