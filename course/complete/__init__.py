"""What labs have complete: modules that ask nothing. They stand once, for labs and reference.

`from reference import diagnosis` loads one from here, as does `from labs import diagnosis`. What it
imports in turn is of the package that asked: a diagnosis of your labs asks your lab 8.

    intersections            lab 8: where surfaces pass through each other
    diagnosis                lab 8: why a pixel or a vertex has no gradient
    soft_rasterizer          lab 10: SoftRas's silhouettes
    lights                   lab 14: where a shadow map's light stands
    shape_rendering          lab 15: one object in three representations
    received_light           lab 16: the light that reaches a surface
    intrinsic_decomposition  lab 16: paint and light of a found surface
    vertex_fit               lab 16: a found surface moved vertex by vertex
"""
