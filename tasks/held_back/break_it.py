"""Break it: the kinds of faults that are held back, as those of tasks/break_it.py."""

ONCE = "= grads[places[argument]] + part"

KINDS = (
    ("summed_to", "range(np.ndim(grad) - len(shape))",
     "range(min(np.ndim(grad) - len(shape), {few}))"),
    ("summed_to", "grad.sum(copied, keepdims=True)", "grad.sum(copied[:{few}], keepdims=True)"),
    ("multiply_backward", "summed_to(grad * b,", "summed_to(grad * np.clip(b, -{large}, {large}),"),
    ("matmul_backward", "grad @ b.T if b.ndim > 1",
     "grad @ (b if b.shape == ({size}, {size}) else b.T) if b.ndim > 1"),
    ("take_backward", "np.add.at(grad_a, index, grad)",
     "np.add.at(grad_a, index[index != {row}], grad[index != {row}])"),
    ("take_backward", "np.add.at(grad_a, index, grad)",
     "few = np.array([np.sum(index[:k] == index[k]) < {uses} for k in range(len(index))], bool)\n"
     "    np.add.at(grad_a, index[few], grad[few])"),
    ("replay", "for k in step[1])", "for k in sorted(step[1]))"),
    ("power", "grad * n * a ** (n - 1)", "grad * n * a ** (n - 1 - (n >= {power}))"),
    ("positive", "grad * (a > 0)", "grad * (a > {small})"),
    ("transpose", "lambda grad, a: grad.T", "lambda grad, a: np.reshape(grad, a.shape)"),
    ("backward", ONCE, f"{ONCE} * (sum(step is not None and places[argument] in step[1] "
     "for step in steps[place + 1:]) != {uses})"),
    ("backward", "np.any(grads[place])", "np.{sum}(grads[place])"),
    ("backward", "reversed(range(len(steps)))",
     "reversed(range(max(0, len(steps) - {many}), len(steps)))"),
    ("backward", "grads[places[argument]] = grads[places[argument]] + part",
     "argument = pair.wrt.index(argument)\n"
     "                grads[places[argument]] = grads[places[argument]] + part"))
