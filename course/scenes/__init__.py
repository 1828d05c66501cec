"""The scenes of `python3 -m course demo`, in the order of the labs, and what they share.

    viewing            cameras and poses
    drawing            smooth shading, fits, and pictures on disk
    own                one's own mesh or photo in a scene's place
    photographs        painted objects, and so what was found, in any light
    hull               where a search for a shape begins
    portrait           the bunny, as pictures
    small              squares on pixels' centres, a ball cut open: pixel by pixel
    aliasing           a zone plate made smaller in five ways, a triangle that is pulled
    mixed              colours that are found in pixels that mix them
    msaa               more and more samples in a pixel, colours found in mixed pixels
    floor              a floor to the horizon, a texture that finds its place
    reflections        what a mirror shows: directions, footprints, surroundings
    fit_vertices       a triangle finds its place from the colours inside of it
    fit_triangle       a triangle finds its template by its edges alone, and turns in space
    fit_cube           a cube's shape and colours, from tiny pictures
    fit_pose           how a known cube is turned
    fit_texture        a globe's texture, with and without mipmaps
    taped              pose, zoom and light of the bunny, from one picture
    fit_bunny          a ball becomes the bunny
    cubes              faces with texture cubes, and a ball that finds its place
    fit_outlines       one silhouette, three gradients
    levels             a coarse ring made smooth, the bunny made coarse
    relaxation         noise smoothed away, thin triangles made rounder
    large_steps        a ball becomes the bunny by large steps
    shadow             the bunny's shadow, hard and soft, and a light found by one
    still_life         teapot, bunny, ball and ring by a window
    representations    one shape as a formula, in a grid and as triangles
    hole               a ball becomes a ring, by the distances in a grid
    fit_volume         density and colour in a grid
    reconstruct        shape, albedo and light of objects never seen
    paint_and_light    albedo and light told apart, on pictures of a path tracer
    tiles              the bunny by kernels: fragments, tiles, sums at vertices
    demo               which scenes there are, and what runs them
"""
