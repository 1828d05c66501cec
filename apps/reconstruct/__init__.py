"""Lab 16 on pictures of your own: `python3 -m course reconstruct FOLDER`.

    camera_files   where the pictures were taken
    silhouettes    which pixels show the object
    hulls          where the object is, and whether cameras and silhouettes agree
    captures       a folder's pictures, with the cameras that took them
    textures       a surface cut into charts, and its colours painted onto them
    exports        the mesh as GLB
    views          how good the mesh is
    command        all of it, in the order in which it runs
"""
