"""What articles, engines and other shading systems call what the library has under another name.

The hints for unknown functions and docs/builtins.md are made from it, as from ``elsewhere.py``.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

_OF_THE_LIBRARY: Mapping[str, str] = MappingProxyType(
    {
        # ---- std.hashes and std.noise
        "pcg": "pcghash hashpcg wanghash",
        "xxhash32": "xxhash",
        "white_noise": "hash hash1 hash11 hash12 hash13 hash14 hash21 rand random random1d noise1d "
        "whitenoise2d whitenoise3d randomrange",
        "random2": "hash2 hash22", "random3": "hash3 hash33", "random4": "hash4 hash44",
        "cell_noise": "cellnoise1 cellnoise2d cellnoise3d",
        "value_noise": "vnoise valuenoise2d valuenoise3d simplenoise",
        "gradient_noise": "noise noise1 noise2 noise3 noise4 noise2d noise3d perlin perlin2d "
        "perlin3d perlinnoise perlinnoise2d perlinnoise3d cnoise gnoise classicnoise inoise "
        "mxnoise mxnoisefloat unoise",
        "gradient_noise_derivatives": "noised",
        "tiling_gradient_noise": "pnoise periodicnoise tilingnoise",
        "simplex_noise": "snoise simplex simplex2d simplex3d simplexnoise2d simplexnoise3d "
        "opensimplex opensimplex2",
        "simplex_noise_derivatives": "srnoise psrnoise srdnoise psrdnoise",
        "fbm": "fbm2 fbm3 fbm2d fbm3d fbmnoise fractal fractal2d fractal3d fractalnoise "
        "fractalsum octavenoise fractalbrownianmotion musgrave mxfractalnoise mxfractalnoisefloat",
        "turbulence": "turbulencenoise turb billow",
        "ridged": "ridgednoise ridgednoise2d ridgedfbm ridgedmf ridgedmultifractal",
        "domain_warp": "warp domainwarping warpnoise warpeddomain",
        "curl_noise": "curl curl2d curl3d curlnoise2d curlnoise3d",
        # ---- std.cellular
        "voronoi": "voronoi2 voronoi2d voronoi3d voronoinoise voronoitexture",
        "worley_noise": "worley worley2d worley3d worleynoise2d worleynoise3d cellular cellular2d "
        "cellular3d cellularnoise",
        "smooth_worley_noise": "smoothvoronoi smoothworley voronoise",
        "voronoi_edge": "voronoiedges voronoiborder voronoiborders voronoidistance",
        # ---- std.patterns
        "checker": "checkers checkerboard chequer chequerboard checkertexture checkerpattern",
        "stripes": "stripe", "grid": "gridlines gridpattern filteredgrid",
        "bricks": "brick brickpattern bricktexture",
        "hexagons": "hex hexagon hexgrid hextile hextiles hexagongrid honeycomb",
        "dots": "polkadot polkadots", "truchet_lines": "truchettile truchettiles truchetpattern",
        "footprint": "filterwidth", "pulse_train": "filteredpulsetrain", "twirled": "twirl swirl",
        # ---- std.masks
        "height_blend": "heightlerp heightmix", "slope_angle": "steepness",
        "mean_curvature": "curvature", "cavity_mask": "cavity", "edge_mask": "edgewear",
    }
)  # fmt: skip
"""Functions of the library, and the names that other systems have for each; see ``LIBRARY``."""

LIBRARY: Mapping[str, str] = MappingProxyType(
    {name: meant for meant, names in _OF_THE_LIBRARY.items() for name in names.split()}
)
"""The most similar function of the library for names of other systems, in lower case without `_`.

Names that differ only in their case and in `_`, such as ``curlNoise``, are found without a row."""
