"""How near lab 12's meshes stay, beside other programs': python3 benchmarks/simplification.py

Distances are of the bunny, its longest edges halved and rounded until it has 5,804 faces: the mean
over both surfaces, and the greatest (Hausdorff's), in 1/10,000 of the diagonal. libigl (qslim) and
VTK (quadric decimation) stand beside this lab where they are installed. Written to
out/benchmarks/simplification.json as well.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import distances, mesh
from reference import collapse_heap

TARGETS = 994, 532, 248, 64


def main():
    facts = measure.begin()
    bunny = mesh.split_longest(*mesh.bunny(), 5804)
    rows = [row(name, simplify, bunny) for name, simplify in installed().items()]
    measure.show(rows)
    measure.save("simplification", {**facts, "distances": rows})


def row(name, simplify, original):
    """One row: 'mean / greatest' for each target."""
    diagonal = 1e-4 * np.linalg.norm(np.ptp(original[0], axis=0))
    found = {"by": name}
    for target in TARGETS:
        simplified = simplify(*original, target)
        there = distances.surface_distances(*simplified, *original)
        back = distances.surface_distances(*original, *simplified)
        found[str(len(simplified[1]))] = (f"{(there[0] + back[0]) / 2 / diagonal:.2f} / "
                                          f"{max(there[1], back[1]) / diagonal:.0f}")
    return found


def installed():
    """{name: function of vertices, faces, face_count}, of this lab and of what is installed."""
    found = {"this lab": lambda *asked: collapse_heap.simplify(*asked)[:2]}
    for name, wrap in ("libigl", libigl), ("VTK", vtk):
        try:
            found[name] = wrap()
        except ImportError:
            print(f"{name} is not installed")
    return found


def libigl():
    import igl
    return lambda vertices, faces, face_count: igl.qslim(vertices, faces, face_count)[:2]


def vtk():
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkQuadricDecimation

    def simplify(vertices, faces, face_count):
        points, cells, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(vertices, deep=True))
        cells.SetData(3, numpy_to_vtkIdTypeArray(faces.ravel(), deep=True))
        surface.SetPoints(points)
        surface.SetPolys(cells)
        decimation = vtkQuadricDecimation()
        decimation.SetInputData(surface)
        decimation.SetTargetReduction(1 - face_count / len(faces))
        decimation.Update()
        result = decimation.GetOutput()
        corners = vtk_to_numpy(result.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        return vtk_to_numpy(result.GetPoints().GetData()).astype(float), corners.astype(int)

    return simplify


if __name__ == "__main__":
    main()
