"""The bridge's operations beside DRTK's, there and back: python3 benchmarks/operations.py

rasterize, interpolate and antialias of apps/bridge through tensors, and `renderers.drtk`, which
says what DRTK does instead. Milliseconds of processor time on one core, at 512 x 512 pixels.
"""
import sys
from pathlib import Path

import numpy as np
import torch

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from apps.bridge.nvdiffrast import torch as dr
from benchmarks import measure, peers, renderers


def main():
    facts, rows = measure.begin(), []
    for scene, rounds, _ in (peers.ball(count, 512) for count in peers.FACES[:3]):
        took = measure.rounds({"ours": through_tensors(scene),
                               "DRTK": renderers.drtk(scene)["both ways"]}, rounds)
        took["ours x DRTK"] = np.divide(took["ours"], took["DRTK"])
        middle = map(np.median, took.values())
        rows.append({"faces": len(scene.faces), **dict(zip(took, middle, strict=True))})
    measure.show(rows)
    measure.save("operations", {**facts, "milliseconds": rows})


def through_tensors(scene):
    """A call: draws a renderers.Scene, and finds the gradients of its colours and vertices."""
    given = [torch.tensor(values, dtype=torch.float32)[None]
             for values in (scene.attributes, scene.clip, scene.gradient)]
    faces, context = torch.tensor(scene.faces.astype(np.int32)), dr.RasterizeCudaContext()
    edges = dr.antialias_construct_topology_hash(faces)

    def call():
        colours, clip = (tensor.clone().requires_grad_() for tensor in given[:2])
        rast, _ = dr.rasterize(context, clip, faces, given[2].shape[1:3])
        picture, _ = dr.interpolate(colours, rast, faces)
        dr.antialias(picture, rast, clip, faces, edges).backward(given[2])

    return call


if __name__ == "__main__":
    main()
