"""Writes fis_folded.json: folded Hermite surfaces at exact doubles, in fractions throughout.

f = H + s (f - G) o Phi on the grid of knots X x Y; see README.md.
"""
import json
import random
from fractions import Fraction as F

random.seed(20)


def hermite(u):  # values H0, H1, K0, K1 and their slopes
    return ([(1 + 2 * u) * (1 - u) ** 2, u * u * (3 - 2 * u), u * (1 - u) ** 2, u * u * (u - 1)],
            [-6 * u * (1 - u), 6 * u * (1 - u), (1 - u) * (1 - 3 * u), u * (3 * u - 2)])


def spline(X, Y, z, zx, zy, x, y):
    """The value and both slopes of the twist-free bicubic Hermite spline."""
    i = max(k for k in range(len(X) - 1) if X[k] <= x)
    j = max(k for k in range(len(Y) - 1) if Y[k] <= y)
    a, b = X[i + 1] - X[i], Y[j + 1] - Y[j]
    (h, dh), (g, dg) = hermite((x - X[i]) / a), hermite((y - Y[j]) / b)
    out = [F(0)] * 3
    for p in (0, 1):
        for q in (0, 1):
            v, vx, vy = z[i + p][j + q], zx[i + p][j + q], zy[i + p][j + q]
            for k, (A, B, c) in enumerate([(h, g, 1), (dh, g, 1 / a), (h, dg, 1 / b)]):
                out[k] += c * (v * A[p] * B[q] + vx * a * A[2 + p] * B[q] + vy * b * A[p] * B[2 + q])
    return out


def base(X, Y, z, zx, zy):
    """Nodes of G: the bilinear surface of the corners, with the given slopes across the border."""
    m, n, g, gx, gy = len(X) - 1, len(Y) - 1, [], [], []
    for i, x in enumerate(X):
        t = (x - X[0]) / (X[m] - X[0])
        rows = []
        for j, y in enumerate(Y):
            u = (y - Y[0]) / (Y[n] - Y[0])
            west, east = [(1 - u) * z[k][0] + u * z[k][n] for k in (0, m)]
            south, north = [(1 - t) * z[0][k] + t * z[m][k] for k in (0, n)]
            rows.append(((1 - t) * west + t * east,
                         zx[i][j] if i in (0, m) else (east - west) / (X[m] - X[0]),
                         zy[i][j] if j in (0, n) else (north - south) / (Y[n] - Y[0])))
        for out, k in ((g, 0), (gx, 1), (gy, 2)):
            out.append([row[k] for row in rows])
    return g, gx, gy


def fold(knots, x):
    """The zig-zag and its slope."""
    i = max(k for k in range(len(knots) - 1) if knots[k] <= x)
    by = (knots[-1] - knots[0]) / (knots[i + 1] - knots[i])
    return (knots[0] + (x - knots[i]) * by, by) if i % 2 == 0 else (knots[-1] - (x - knots[i]) * by, -by)


def point(X, Y, s, H, G, x, y, depth):
    """f and its gradient by `depth` terms of f = H + s (f - G) o Phi; G itself stands for f in the last."""
    if depth == 0:
        return spline(X, Y, *G, x, y)
    (px, ax), (py, ay) = fold(X, x), fold(Y, y)
    inner = point(X, Y, s, H, G, px, py, depth - 1)
    h, g = spline(X, Y, *H, x, y), spline(X, Y, *G, px, py)
    return [h[0] + s * (inner[0] - g[0]), h[1] + s * ax * (inner[1] - g[1]), h[2] + s * ay * (inner[2] - g[2])]


def decimal(x):
    return f"{int(round(x * 10 ** 30))}e-30"


def surface(name, X, Y, s, count, depth):
    def table(step, top):
        return [[F(random.randint(-top, top), step) for _ in Y] for _ in X]
    H = (table(8, 8), table(4, 12), table(4, 12))
    G = base(X, Y, *H)
    points = []
    for _ in range(count):
        x, y = [F(random.uniform(float(k[0]), float(k[-1]))) for k in (X, Y)]
        f = point(X, Y, s, H, G, x, y, depth)
        points.append({"x_hex": float(x).hex(), "y_hex": float(y).hex(),
                       **{key: decimal(v) for key, v in zip(("f_dec", "fx_dec", "fy_dec"), f)}})
    m, n = len(X) - 1, len(Y) - 1
    area = (X[m] - X[0]) * (Y[n] - Y[0])

    def mean(z, zx, zy):  # Simpson's rule is exact for cubics
        w, total = (F(1, 6), F(4, 6), F(1, 6)), F(0)
        for i in range(m):
            for j in range(n):
                a, b = X[i + 1] - X[i], Y[j + 1] - Y[j]
                total += sum(a * b * w[p] * w[q] * spline(X, Y, z, zx, zy, X[i] + a * F(p, 2), Y[j] + b * F(q, 2))[0]
                             for p in range(3) for q in range(3))
        return total / area
    h, g = mean(*H), mean(*G)
    text = lambda rows: [[str(v) for v in row] for row in rows]
    return {"name": name, "x": [str(v) for v in X], "y": [str(v) for v in Y], "s": str(s), "z": text(H[0]),
            "zx": text(H[1]), "zy": text(H[2]), "mean": decimal(h + s / (1 - s) * (h - g)), "points": points}


smooth = surface("smooth", [F(0), F(3, 4), F(5, 4), F(2)], [F(-1), F(0), F(1, 2), F(5, 4), F(2)], F(1, 64), 30, 24)
rough = surface("rough", [F(1), F(7, 4), F(5, 2), F(4)], [F(0), F(1, 2), F(1)], F(-3, 16), 20, 140)
json.dump({"kind": "folded Hermite FIS f = H + s (f - G) o Phi", "surfaces": [smooth, rough]},
          open("fis_folded.json", "w"), indent=1)
