"""What is only faster than a module of reference: whole rows, kernels on all cores. No exercise.

What stands here decides nothing that a module of reference does not, and is tried against it: by
tests, and scanline against what a student wrote (course/given/faster.py). These modules are
imported as those of course/complete are, `from reference import face_kernels`, and take what they
need from the package that asks. Where numba is installed, compiled_pipeline and texel_kernels
replace pipeline.py and mipmapping.py, gradients to rounding and the rest to the bit
(course/given/compiled.py).

    scanline           lab 2's rasterizer, whole rows at once, in NumPy
    sparse_weights     lab 5's interpolation as a product with one sparse matrix
    face_kernels       lab 2's rasterizer
    pixel_kernels      lab 5's weights and colours, there and back
    pair_kernels       lab 8's antialiasing, there and back
    pyramid_kernels    lab 6's pyramids and levels
    texel_kernels      lab 6's look-ups, there and back: `texture`
    footprint_kernels  where each pixel looks up a texture, there and back
    compiled_pipeline  lab 9: `draw` and `draw_backward`, by all of these
    cube_kernels       lab 6's cube maps, there and back to the texels
    float_kernels      what apps/bridge does with float32 numbers, there and back
"""
