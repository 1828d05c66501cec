"""Wrong answers to marching_tetrahedra, written without a look at the checks."""


def tetrahedron_triangles(inside):
    """with two inside, the four corners are joined in an order that crosses itself, like a bow tie

    told by: bow tie | bow-tie | crosses itself | cross & quad | around & four | overlap | self-intersect
    """
    ins = [v for v in range(4) if inside[v]]
    outs = [v for v in range(4) if not inside[v]]
    odd = is_odd(np.array(ins + outs))
    if len(ins) == 1:
        if odd:
            outs[0], outs[1] = outs[1], outs[0]
        ring = [(ins[0], o) for o in outs]
    elif len(ins) == 3:
        if odd:
            ins[0], ins[1] = ins[1], ins[0]
        ring = [(i, outs[0]) for i in ins]
    elif len(ins) == 2:
        if odd:
            ins[0], ins[1] = ins[1], ins[0]
        ring = [(i, o) for i in ins for o in outs]
    else:
        ring = []
    fan = [[ring[0], ring[k], ring[k + 1]] for k in range(1, len(ring) - 1)]
    return np.array(fan, int).reshape(-1, 3, 2)


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the distances in the denominator s_b - s_a are held constant

    told by: denominator | quotient rule | s_b - s_a & held | s_b - s_a & constant | numerator | division & also depend | also in & s_b - s_a
    """
    span = s_b - s_a
    to_a = grad_p * (s_b / span)[:, None]
    to_b = grad_p * (-s_a / span)[:, None]
    return to_a, to_b, -(grad_p * p_b).sum(1) / span, (grad_p * p_a).sum(1) / span
