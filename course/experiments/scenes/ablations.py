"""What lab 16's search finds without one of its parts."""
from ..folder.searches import FINE_STAGES
from .drawing import save
from .fit_triangle import without_edges
from .reconstruct import fit, judged, new_cameras, portrait


def ablations(labs):
    """What lab 16's search is without one of its parts."""
    stages, camera = FINE_STAGES[:2], new_cameras(labs)[5]
    weights = labs.multi_view_fit.WEIGHTS._replace(sign_changes=0.0, bumps=0.0)
    for name, settings in (("all of it", {}),
                           ("no antialiasing", {"renderer": without_edges(labs)}),
                           ("no regularizers", {"weights": weights}), ("4 views", {"count": 4})):
        for x, _ in fit(labs, "bunny", stages, **settings):  # noqa: B007
            pass
        found = judged(labs, x, "bunny")
        yield (f"{name}: {found['new views']:.1f} dB, {found['distance']:.2%} off",
               save("ablations", name.replace(" ", "_"), portrait(labs, x, camera, 256)))
