"""Changes of the library's reflectances that no value can show, for ``equivalent.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

OF_REFLECTANCES: Mapping[str, Sequence[str]] = {
    "The half vector is as near to the light as to the eye.": (
        (
            "std.microfacets.ggx_reflectance: k(f0, light_to_half( [to_light -> to_eye] , half)) "
            "* ggx(satur"
        ),
        (
            "std.microfacets.ggx_reflectance: k(f0, light_to_half( [to_light, half -> half, "
            "to_light] )) * ggx(saturate(do"
        ),
        (
            "std.microfacets.ggx_reflectance: k(f0, light_to_half( [to_light -> to_eye] , half)) "
            "* ggx(half,"
        ),
        (
            "std.microfacets.ggx_reflectance: k(f0, light_to_half( [to_light, half -> half, "
            "to_light] )) * ggx(half, width"
        ),
        (
            "std.microfacets.beckmann_reflectance: k(f0, light_to_half( [to_light -> to_eye] , "
            "half)) * beckmann("
        ),
        (
            "std.microfacets.beckmann_reflectance: k(f0, light_to_half( [to_light, half -> half, "
            "to_light] )) * beckmann(dot(no"
        ),
        (
            "std.microfacets.ward_reflectance: ility(light_to_half( [to_light -> to_eye] , "
            "half)) where { hal"
        ),
        (
            "std.microfacets.ward_reflectance: ility(light_to_half( [to_light, half -> half, "
            "to_light] )) where { half = no"
        ),
        (
            "std.microfacets.ashikhmin_reflectance: lh = light_to_half( [to_light -> to_eye] , "
            "half) power = dot("
        ),
        (
            "std.microfacets.ashikhmin_reflectance: lh = light_to_half( [to_light, half -> half, "
            "to_light] ) power = dot(powers"
        ),
        (
            "std.reflectances.burley_reflectance: lh = light_to_half( [to_light -> to_eye] , "
            "normalize(to_light"
        ),
        (
            "std.reflectances.burley_reflectance: lh = light_to_half( [to_light, "
            "normalize(to_light + to_eye) -> normalize(to_light + to_eye), to_light] ) } /// The "
            "same, ma"
        ),
        (
            "std.reflectances.frostbite_reflectance: lh = light_to_half( [to_light -> to_eye] , "
            "normalize(to_light"
        ),
        (
            "std.reflectances.frostbite_reflectance: lh = light_to_half( [to_light, "
            "normalize(to_light + to_eye) -> normalize(to_light + to_eye), to_light] ) } /// The "
            "factor t"
        ),
        (
            "std.reflectances.subsurface_reflectance: lh = light_to_half( [to_light -> to_eye] , "
            "normalize(to_light"
        ),
        (
            "std.reflectances.subsurface_reflectance: lh = light_to_half( [to_light, "
            "normalize(to_light + to_eye) -> normalize(to_light + to_eye), to_light] ) nl = "
            "saturate(dot("
        ),
        (
            "std.reflectances.coat_reflectance: lh = light_to_half( [to_light -> to_eye] , half) "
            "} /// The sh"
        ),
        (
            "std.reflectances.coat_reflectance: lh = light_to_half( [to_light, half -> half, "
            "to_light] ) } /// The share of"
        ),
    ),
    "Light and eye may be exchanged.": (
        (
            "std.models.open_pbr: eometry_coat_normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] , facet_width(coat_r"
        ),
        (
            "std.models.gltf_lit: ts(clearcoat_normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] , facet_width(clearc"
        ),
        (
            "std.reflectances.ashikhmin_shirley: in_matt( albedo, f0, "
            "[saturate(dot(normal,…dot(normal, to_eye)) -> saturate(dot(normal,…al, "
            "light.to_light))] ) + light.specular *"
        ),
        (
            "std.hair.marschner: 0.1), tilt, strand, [light.to_light, to_eye -> to_eye, "
            "light.to_light] )"
        ),
        (
            "std.reflectances.oren_nayar_reflectance: * max(aside(normal, [to_light, to_eye -> "
            "to_eye, to_light] ), 0) / max(nl, nv))"
        ),
        (
            "std.reflectances.fujii_reflectance: side = aside(normal, [to_light, to_eye -> "
            "to_eye, to_light] ) nl = dot(normal, t"
        ),
        (
            "std.reflectances.eon_reflectance: , roughness, normal, [to_light, to_eye -> to_eye, "
            "to_light] ) + albedo * albedo"
        ),
        (
            "std.reflectances.burley_reflectance: squared(lh), normal, [to_light, to_eye -> "
            "to_eye, to_light] ) where { lh = light"
        ),
        (
            "std.reflectances.frostbite_reflectance: quared(lh)), normal, [to_light, to_eye -> "
            "to_eye, to_light] ) where { lh = light"
        ),
        (
            "std.reflectances.subsurface_reflectance: squared(lh), normal, [to_light, to_eye -> "
            "to_eye, to_light] ) * (1 / (nl + nv) -"
        ),
        (
            "std.reflectances.oren_nayar: bedo, slope, normal, [light.to_light, to_eye -> "
            "to_eye, light.to_light] ) /// The same after"
        ),
        (
            "std.reflectances.fujii: , roughness, normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] ) /// The same witho"
        ),
        (
            "std.reflectances.eon: , roughness, normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] ) /// Matt surfaces"
        ),
        (
            "std.reflectances.burley: , roughness, normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] ) /// The same, whic"
        ),
        (
            "std.reflectances.frostbite: , roughness, normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] ) /// Skin and wax,"
        ),
        (
            "std.reflectances.subsurface_matt: , roughness, normal, [light.to_light, to_eye -> "
            "to_eye, light.to_light] ) /// Surfaces with"
        ),
        (
            "std.reflectances.minnaert: o, darkness, normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] ) /// Matt surfaces"
        ),
        (
            "std.reflectances.cook_torrance: (roughness), normal, [light.to_light, to_eye -> "
            "to_eye, light.to_light] ) /// The same with"
        ),
        (
            "std.reflectances.beckmann_gloss: (roughness), normal, [light.to_light, to_eye -> "
            "to_eye, light.to_light] ) /// Metals that ar"
        ),
        (
            "std.reflectances.cloth_sheen: , roughness, normal, [light.to_light, to_eye -> to_eye, "
            "light.to_light] ) /// Varnish: add i"
        ),
        (
            "std.reflectances.clear_coat: (roughness), normal, [light.to_light, to_eye -> "
            "to_eye, light.to_light] ) /// Hair and fur a"
        ),
        (
            "std.reflectances.hair: nd_highlight(strand, [light.to_light, to_eye -> to_eye, "
            "light.to_light] , power) // ---- Dra"
        ),
        (
            "std.microfacets.beckmann_visibility: = height_correlated( [beckmann_lambda(nl, "
            "width), beckmann_lambda(nv, width) -> beckmann_lambda(nv, width), "
            "beckmann_lambda(nl, width)] ) / (4 * nl * nv) //"
        ),
        (
            "std.microfacets.charlie_visibility: = height_correlated( [charlie_lambda(nl, "
            "r…ambda(nv, roughness) -> charlie_lambda(nv, r…ambda(nl, roughness)] ) / (4 * nl * "
            "nv) //"
        ),
        (
            "std.microfacets.ggx_reflectance: h) * ggx_visibility( "
            "[saturate(dot(normal,…dot(normal, to_eye)) -> saturate(dot(normal,…t(normal, "
            "to_light))] , width) where { hal"
        ),
        (
            "std.microfacets.ggx_reflectance: s) * ggx_visibility( [to_light, to_eye -> to_eye, "
            "to_light] , widths) where { ha"
        ),
        (
            "std.microfacets.beckmann_reflectance: beckmann_visibility( "
            "[saturate(dot(normal,…dot(normal, to_eye)) -> saturate(dot(normal,…t(normal, "
            "to_light))] , width) where { hal"
        ),
        (
            "std.microfacets.sheen_reflectance: neubelt_visibility( "
            "[saturate(dot(normal,…dot(normal, to_eye)) -> saturate(dot(normal,…t(normal, "
            "to_light))] ) // ---- What facet"
        ),
    ),
    "`pow` of a negative number is 0 anyway.": (
        (
            "std.microfacets.ashikhmin_reflectance: owers.y + 1)) * pow( [saturate(half.z) -> "
            "(half.z)] , power) / (8 * pi *"
        ),
        (
            "std.reflectances.minnaert_reflectance: 1) / (2 * pi) * pow( [saturate(dot(normal, "
            "to_light)) -> (dot(normal, to_light))] * saturate(dot(norma"
        ),
        (
            "std.reflectances.minnaert_reflectance: normal, to_light)) * [saturate(dot(normal, "
            "to_eye)) -> (dot(normal, to_eye))] , darkness - 1) // -"
        ),
        (
            "std.reflectances.strand_highlight: oat) -> float = pow( [max(along, 0) -> (along)] "
            ", power) where { alo"
        ),
    ),
    "The length of a cross product is the same the other way round.": (
        (
            "std.reflectances.hair: ffuse * strand_matt( [strand, light.to_light -> "
            "light.to_light, strand] ) + tint * light.spe"
        ),
        (
            "std.reflectances.strand_matt: loat = length(cross( [strand, to_light -> to_light, "
            "strand] )) /// Mirrored by a"
        ),
        (
            "std.reflectances.strand_highlight: along = strand_matt( [strand, to_light -> "
            "to_light, strand] ) * strand_matt(stra"
        ),
        (
            "std.reflectances.strand_highlight: ight) * strand_matt( [strand, to_eye -> to_eye, "
            "strand] ) - dot(strand, to_l"
        ),
    ),
    "What is squared has no sign, and neither has the cosine of the half vector here.": (
        (
            "std.microfacets.dielectric: 5 * (squared(change( [lh, inner -> inner, lh] )) + "
            "squared(change("
        ),
        (
            "std.microfacets.dielectric: )) + squared(change( [lh, inner / (ior * ior) -> inner "
            "/ (ior * ior), lh] ))) where { inner ="
        ),
        "std.microfacets.f0_of_ior: at = squared(change( [ior, 1 -> 1, ior] )) /// The index of",
        (
            "std.microfacets.beckmann_reflectance: , half)) * beckmann( [dot -> -dot] (normal, "
            "half), widt"
        ),
        (
            "std.microfacets.beckmann_reflectance: , half)) * beckmann( [dot(normal, half) -> "
            "abs(dot(normal, half))] , width) * beckmann_"
        ),
    ),
    "Both sides of the choice are the same at its border.": (
        "std.microfacets.charlie_lambda: -> float = if cosine [< -> <=] 0.5 then exp(charlie",
    ),
    "The half vector is at no more than a right angle to the light.": (
        (
            "std.microfacets.light_to_half: lf: vec3) -> float = [saturate -> abs] "
            "(dot(to_light, half)"
        ),
        (
            "std.microfacets.light_to_half: lf: vec3) -> float = [saturate(dot(to_light, half)) "
            "-> (dot(to_light, half))] /// Facets of GGX. ("
        ),
        (
            "std.microfacets.light_to_half: -> float = saturate( [dot(to_light, half) -> "
            "abs(dot(to_light, half))] ) /// Facets of GGX."
        ),
    ),
    "A square is not negative.": (
        "std.microfacets.square_length: (v: vec3) -> float = [dot(v, v) -> abs(dot(v, v))] ",
    ),
    "A vector is as long in any order of its lanes.": (
        (
            "std.microfacets.ggx: (square_length(vec3( [half.xy / widths, half.z -> half.z, "
            "half.xy / widths] )))) /// (P. Beckman"
        ),
        (
            "std.microfacets.beckmann: -square_length(vec3( [half.xy / (widths * half.z), 0 -> "
            "0, half.xy / (widths * half.z)] ))) / (pi * widths.x"
        ),
        (
            "std.microfacets.ggx_lambda: = 0.5 * length(vec3( [widths * direction.xy / "
            "direction.z, 1 -> 1, widths * direction.xy / direction.z] )) - 0.5 /// Hidden"
        ),
        (
            "std.microfacets.beckmann_lambda: ion.z / length(vec3( [widths * direction.xy, 0 -> "
            "0, widths * direction.xy] ))) fn lambda_of_slo"
        ),
        (
            "std.microfacets.ggx_visibility: z, 0) * length(vec3( [widths * to_eye.xy, to_eye.z "
            "-> to_eye.z, widths * to_eye.xy] )) + max(to_eye.z, 0"
        ),
        (
            "std.microfacets.ggx_visibility: z, 0) * length(vec3( [widths * to_light.xy, "
            "to_light.z -> to_light.z, widths * to_light.xy] ))) /// Of Beckmann'"
        ),
    ),
    "Powers and squares are not negative.": (
        (
            "std.microfacets.ashikhmin_reflectance: light, half) power = [dot(powers, half.xy * "
            "half.xy) -> abs(dot(powers, half.xy * half.xy))] / (half.x * half.x +"
        ),
    ),
    "A bell is the same on both sides of its middle.": (
        (
            "std.hair.strand_scattering: ec3 ) -> rgb = cone( [sines, -2 * tilt -> -2 * tilt, "
            "sines] , width) * strand_mi"
        ),
        (
            "std.hair.strand_scattering: ht, to_eye)) + cone( [sines, tilt -> tilt, sines] , 0.5 "
            "* width) * str"
        ),
        (
            "std.hair.strand_scattering: turn, slant) + cone( [sines, 4 * tilt -> 4 * tilt, "
            "sines] , 2 * width) * stran"
        ),
    ),
    "The middle one of three numbers is the same in any order.": (
        (
            "std.iridescence.iridescent_fresnel: nside) both = clamp( [outer * below, 1e-5 -> "
            "1e-5, outer * below] , 0.9999) root = sqr"
        ),
    ),
    "Where nearly all light is mirrored by the film, nothing enters it.": (
        (
            "std.iridescence.iridescent_fresnel: outer * below, 1e-5, [0.9999 -> 1.249875] ) "
            "root = sqrt(both)"
        ),
    ),
    "A whole turn changes no wave.": (
        "std.iridescence.iridescent_fresnel: a period. turn = pi [+ -> -] choose(base < index,",
    ),
    "Light from behind counts nothing: its share is 0.": (
        (
            "std.reflectances.ashikhmin_shirley: in_matt( albedo, f0, [saturate -> abs] "
            "(dot(normal, light.t"
        ),
        (
            "std.reflectances.ashikhmin_shirley: in_matt( albedo, f0, [saturate(dot(normal, "
            "light.to_light)) -> (dot(normal, light.to_light))] , saturate(dot(norma"
        ),
        (
            "std.reflectances.ashikhmin_shirley: lbedo, f0, saturate( [dot(normal, "
            "light.to_light) -> abs(dot(normal, light.to_light))] ), saturate(dot(norm"
        ),
    ),
}
"""The reasons, each with the changes as ``Change.told`` says them."""
