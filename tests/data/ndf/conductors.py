"""Writes `conductors.json`: values of Mitsuba 3 for `roughconductor` and for `principled` as metal.

    pip install mitsuba==3.9.1
    python conductors.py > conductors.json
"""

import json
import math
import random

import mitsuba as mi

mi.set_variant("scalar_rgb")
GOLD = {"eta": [0.18, 0.42, 1.37], "k": [3.42, 2.35, 1.77]}
BASE = [0.9, 0.5, 0.3]


def rgb(value):
    return {"type": "rgb", "value": value}


def direction(rng):
    z, turn = rng.uniform(0.05, 1.0), rng.uniform(0.0, 2.0 * math.pi)
    across = math.sqrt(1.0 - z * z)
    return [across * math.cos(turn), across * math.sin(turn), z]


def rows(bsdf, rng):
    interaction, context, made = mi.SurfaceInteraction3f(), mi.BSDFContext(), []
    for _ in range(24):
        toward_eye, toward_light = mi.Vector3f(direction(rng)), mi.Vector3f(direction(rng))
        interaction.wi = toward_eye
        value = bsdf.eval(context, interaction, toward_light)
        f = [float(value[k]) / float(toward_light.z) for k in range(3)]
        made.append([float(f"{x:.9g}") for x in [*toward_eye, *toward_light, *f]])
    return made


def items():
    rng = random.Random(1)
    for u, v in [(0.05, 0.05), (0.2, 0.2), (0.5, 0.5), (1.0, 1.0), (0.2, 0.4), (0.6, 0.1)]:
        bsdf = {"type": "roughconductor", "distribution": "ggx", "alpha_u": u, "alpha_v": v}
        bsdf |= {name: rgb(value) for name, value in GOLD.items()}
        yield {"plugin": "roughconductor", "alpha": [u, v], **GOLD, "rows": rows(mi.load_dict(bsdf), rng)}
    for roughness, anisotropic in [(0.3, 0.0), (0.7, 0.0), (0.5, 0.6), (0.8, 1.0)]:
        parameters = {"roughness": roughness, "anisotropic": anisotropic}
        bsdf = {"type": "principled", "metallic": 1.0, "base_color": rgb(BASE), **parameters}
        made = rows(mi.load_dict(bsdf), rng)
        yield {"plugin": "principled", **parameters, "base": BASE, "rows": made}


head = {
    "source": f"Mitsuba {mi.__version__} (pip), variant scalar_rgb; f = eval/cos theta of the light",
    "columns": "towards the eye (3), towards the light (3), f (3)",
}
text = ",\n".join(json.dumps(item).replace('"rows": [[', '"rows": [\n[').replace("], [", "],\n[") for item in items())
print(json.dumps(head)[:-1] + ',\n"items": [\n' + text + "\n]}")
