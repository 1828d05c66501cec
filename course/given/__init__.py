"""What is given: it stands below reference, and nobody has to write it.

    arrays         rows of numbers: gather, scatter, ranges, a part at a time
    inputs         what functions expect: one sentence for what does not fit
    whose          the reference does the work, or a student's labs
    compiled       loops that numba compiles where it is installed, and all cores
    faster         what is only faster, in the place of what somebody wrote
    image          pictures as arrays, and as files
    mesh           triangle meshes: simple shapes, normals, edges
    mesh_files     triangle meshes from files
    distances      how far points are from a mesh, and meshes from each other
    ray_casting    exact shadows, without a map
    sweeps         numeric derivatives, and how near they are
    gradcheck      is a backward pass the derivative of its forward pass?
    plot           figures: pictures, meshes, curves, films
    plot_triangle  figures: a triangle's samples and edge functions
    plot_3d        figures: meshes in space
    sketch         figures: labelled drawings
    pale           pictures of the reference, where yours cannot be drawn yet
    lecture        how a lecture begins, and cells that wait for what is not written
"""
