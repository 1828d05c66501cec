"""How long lab 12 takes, how it grows, and how near it stays: python3 benchmarks/simplification.py

Times are CPU seconds of one run; written to out/benchmarks/simplification.json as well.
"n log n" is the time divided by n log2 n, n the number of faces, in microseconds.

Distances are of the bunny, its longest edges halved and rounded until it has 5,804 faces: the mean
over both surfaces, and the greatest (Hausdorff's), in 1/10,000 of the diagonal. libigl (qslim), VTK
(quadric decimation) and fast-simplification stand beside it where they are installed; so does this
lab with planes that count once each, however small their faces.
"""
import math
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import distances, mesh
from reference import collapse_heap, simplification

GROWTH = 1_000, 5_000, 20_000, 50_000
TARGETS = 994, 532, 248, 64


def main():
    facts = measure.begin()
    bunny = mesh.split_longest(*mesh.bunny(), 5804)
    seconds, (_, left, _) = timed(collapse_heap.simplify, *bunny, 500)
    times = [{"mesh": "bunny", "faces": len(bunny[1]), "left": len(left), "seconds": seconds}]
    times += [growth(count) for count in GROWTH]
    for row in times:
        row["n log n"] = 1e6 * row["seconds"] / (row["faces"] * math.log2(row["faces"]))
    measure.show(times)
    near = [distance(name, peer, bunny) for name, peer in peers().items()]
    measure.show(near)
    measure.save("simplification", facts, {"times": times, "distances": near})


def growth(face_count):
    """A bumpy sphere, to a tenth of its faces."""
    vertices, faces = mesh.icosphere(face_count)
    vertices = vertices * (1 + 0.1 * np.sin(9 * vertices).sum(1, keepdims=True))
    seconds, (_, left, _) = timed(collapse_heap.simplify, vertices, faces, len(faces) // 10)
    return {"mesh": "bumpy sphere", "faces": len(faces), "left": len(left), "seconds": seconds}


def timed(function, *arguments):
    start = time.process_time()
    result = function(*arguments)
    return time.process_time() - start, result


def distance(name, peer, original):
    """One row: seconds for all targets, and 'mean / greatest' for each."""
    row = {"by": name}
    for target in TARGETS:
        row[f"s, {target}"], simplified = timed(peer, *original, target)
        there = distances.surface_distances(*simplified, *original)
        back = distances.surface_distances(*original, *simplified)
        diagonal = 1e-4 * np.linalg.norm(np.ptp(original[0], axis=0))
        row[str(len(simplified[1]))] = (f"{(there[0] + back[0]) / 2 / diagonal:.2f} / "
                                        f"{max(there[1], back[1]) / diagonal:.0f}")
    return row


def peers():
    """{name: function of vertices, faces, face_count}, of this lab and of what is installed."""
    found = {"this lab": lambda *asked: collapse_heap.simplify(*asked)[:2], "each once": each_once}
    for name, wrap in ("libigl", libigl), ("VTK", vtk), ("fast-simplification", fast):
        try:
            found[name] = wrap()
        except ImportError:
            print(f"{name} is not installed")
    return found


def each_once(vertices, faces, face_count):
    """This lab, but each plane counts once, however small its face; for a closed mesh."""
    quadrics = simplification.plane_quadrics(simplification.face_planes(vertices, faces))
    quadrics = simplification.vertex_quadrics(quadrics, faces, len(vertices))
    pairs = simplification.valid_pairs(vertices, faces, 0.0)
    return collapse_heap.simplify_heap(vertices, faces, quadrics, pairs, face_count)[:2]


def libigl():
    import igl
    return lambda vertices, faces, face_count: igl.qslim(vertices, faces, face_count)[:2]


def fast():
    import fast_simplification

    def simplify(vertices, faces, face_count):
        points, triangles = fast_simplification.simplify(
            vertices.astype(np.float32), faces.astype(np.int32), target_count=face_count)
        return points.astype(float), triangles.astype(int)

    return simplify


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
