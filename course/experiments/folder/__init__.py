"""Lab 16 on pictures of your own: `python3 -m course demo reconstruct FOLDER`.

    colmap_binary  COLMAP's binary files as text
    camera_files   what the three kinds of camera files say
    lenses         pictures without the distortion of their lens
    silhouettes    which pixels show the object
    hulls          where the object is, and the surface to begin with
    captures       a folder's pictures, with the cameras that took them
    textures       a surface cut into charts, and its colours painted onto them
    exports        the mesh as GLB and OBJ
    searches       lab 16's search under a progress bar, with the mesh so far on disk
    checkpoints    a search that was stopped
    photographs    painted objects, and so what was found, in any light
    explanations   how much the albedo changes over light that fits as well
    turning_light  whether the light turns with the camera
    fit_report     how good the mesh is, on one page
    command        all of it, in the order in which it runs
"""
