/** Small vectors, as arrays of numbers. */

export const plus = (p, q, times = 1) => p.map((t, k) => t + times * q[k]);

export const minus = (p, q) => plus(p, q, -1);

/** From p, where t is 0, to q, where it is 1. */
export const between = (p, q, t) => plus(p, minus(q, p), t);

export const dot = (p, q) => p.reduce((sum, t, k) => sum + t * q[k], 0);
