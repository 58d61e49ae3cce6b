// SPDX-License-Identifier: Apache-2.0
// The layers of OpenPBR Surface 1.1 (Academy Software Foundation 2024) as functions, built from the
// models of the library. Names, defaults and meanings are that specification's; what differs is said
// at each function. `openpbr.mms` is the surface and the volume with a `param` for each name.

/// The index whose reflectance at normal incidence is `weight` times that of `ior`: how OpenPBR
/// weighs what is specular. 1 where weight is 0.
/// >>> openpbr_index(1.5, 1.0)
/// 1.5
/// >>> openpbr_index(1.5, 0.0)
/// 1
/// >>> fresnel(1.0, openpbr_index(1.5, 0.25))
/// 0.01
real openpbr_index(real ior, weight)
    root = (ior - 1.0) / (ior + 1.0);
    r    = clamp(sqrt(max(weight, 0.0)) * root, -0.999, 0.999);
    return (1.0 + r) / (1.0 - r);

/// `openpbr_index` of what lies under a coat: index over that of the coat, turned over where it
/// would be below 1, so that nothing is reflected in full (as OpenPBR).
/// >>> openpbr_index_below(1.5, 1.0, 1.6, 0.0)
/// 1.5
/// >>> openpbr_index_below(1.5, 1.0, 1.6, 1.0)
/// 1.0666...
real openpbr_index_below(real ior, weight, coat_ior, coat_weight)
    over = ior / mix(1.0, max(coat_ior, 1.0), saturate(coat_weight));
    n    = select over, if over >= 1.0; 1.0 / max(over, 1e-3) otherwise; end;
    return openpbr_index(n, weight);

/// Roughness of what is specular under a coat: light that passes a rough one twice is spread by it
/// too, and the squares of alphas add (as OpenPBR).
/// >>> openpbr_roughness_below(0.3, 0.8, 0.0)
/// 0.3
/// >>> openpbr_roughness_below(0.0, 0.5, 1.0)
/// 0.594603...
real openpbr_roughness_below(real roughness, coat_roughness, coat_weight)
    wide = sqrt(sqrt(min(roughness^4 + 2.0 * coat_roughness^4, 1.0)));
    return mix(roughness, wide, saturate(coat_weight));

/// The roughness and the anisotropy of the library's facets that are as wide along both axes as
/// OpenPBR says. `anisotropy` is in [0, 1], up to 0.9 exact.
/// >>> openpbr_stretched(0.3, 0.0).roughness
/// 0.3
/// >>> openpbr_stretched(0.3, 0.45).anisotropy
/// 0.5
openpbr_width typeid struct
    real roughness, anisotropy;
end
openpbr_width openpbr_stretched(real roughness, anisotropy)
    broad = 1.0 - clamp(anisotropy, 0.0, 0.999);
    keep  = sqrt(sqrt(2.0 * broad / (1.0 + broad * broad)));
    return openpbr_width(roughness * keep, clamp(anisotropy / 0.9, 0.0, 1.0));

/// The facets of OpenPBR's coat and of what is specular on its base, without Fresnel's factor.
/// >>> openpbr_gloss(1.0, 0.3, 0.0)
material openpbr_gloss(spectrum colour, real roughness, anisotropy)
    width = openpbr_stretched(roughness, anisotropy);
    return microfacet(colour, width.roughness, width.anisotropy);

/// How much of the colour under a coat is left by light that goes to and fro between both: 1 for
/// white. `amount` in [0, 1] is OpenPBR's coat_darkening times its coat_weight.
/// >>> openpbr_darkening(1.0, 1.6, 1.0)
/// 1
/// >>> luminance(openpbr_darkening(0.2, 1.6, 1.0)) < 0.6
/// true
spectrum openpbr_darkening(spectrum colour, real coat_ior, amount)
    n      = max(coat_ior, 1.0);
    inside = 1.0 - (1.0 - (n - 1.0) / (4.08567 + 1.00071 * n)) / (n * n);
    return 1.0 + amount * ((1.0 - inside) / (1.0 - inside * clamp(colour, 0.0, 1.0)) - 1.0);

/// OpenPBR's metal: `colour` is its reflectance at normal incidence, `edge` the tint at 82 degrees, 1
/// for none. A film of `film_weight` and `thickness` in metres may lie on it, above the complex
/// index of those two colours (Gulbrandsen 2014).
/// >>> openpbr_metal(rgb(0.9, 0.6, 0.3), 1.0, 0.3, 0.0, 0.0, 0.0, 1.4)
material openpbr_metal(
    spectrum colour, edge,
    real roughness, anisotropy, film_weight, thickness, film_ior
)
    r     = clamp(colour, 0.0, 0.9999);
    g     = clamp(edge, 0.0, 1.0);
    root  = sqrt(r);
    n     = g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + root) / (1.0 - root);
    k     = sqrt(max((r * (n + 1.0)^2 - (n - 1.0)^2) / (1.0 - r), 0.0));
    width = openpbr_stretched(roughness, anisotropy);
    return mix(
        coloured_metal(colour, edge, width.roughness, width.anisotropy),
        film_conductor(
            n, k, film_ior, thickness, $wavelength, width.roughness, width.anisotropy
        ),
        saturate(film_weight)
    );

/// OpenPBR's transmission where it is thin-walled: a sheet that light goes straight through. Clear it
/// is a `slab`; rough it reflects as both its faces do together, and blurs what is behind it as both
/// bend light. Under a film it reflects as the one interface that reflects as much along the normal.
/// >>> openpbr_sheet(1.5, 0.0, 0.0, 1.0, 0.8, 0.0, 500nm, 1.4)
/// >>> openpbr_sheet(1.5, 0.3, 0.0, 1.0, 0.8, 0.5, 500nm, 1.4)
material openpbr_sheet(
    real ior, roughness, anisotropy,
    spectrum reflected, transmitted,
    real film_weight, thickness, film_ior
)
    root    = (ior - 1.0) / (ior + 1.0);
    faces   = sqrt(2.0 * root * root / (1.0 + root * root));
    index   = (1.0 + faces) / (1.0 - faces);
    blur    = max(abs(ior - 1.0) * roughness * roughness, 1e-6);
    through = glossy_through(transmitted, 1.0 / (blur * blur), 1.0 / (blur * blur));
    gloss   = openpbr_gloss(reflected, roughness, anisotropy);
    // A film of a millimetre has no fringes: both its faces reflect as those of a sheet.
    bare    = film_mix(through, gloss, 1.0, max(ior, 1.0 / ior), 1mm, 550nm);
    filmed  = film_mix(through, gloss, index, film_ior, thickness, $wavelength);
    return select
        slab(ior, 1.0, absorption_from(transmitted, 1.0)),
            if roughness <= 0.0 and film_weight <= 0.0;
        bare, if film_weight <= 0.0;
        filmed, if film_weight >= 1.0;
        mix(bare, filmed, film_weight) otherwise;
    end;

/// OpenPBR's emission, for the output `emission`: white is D65 of that luminance in candela per
/// square metre. A coat takes its colour of it once.
/// >>> openpbr_emission(683.002 * 105.671) / illuminant_d65($wavelength)
/// 1
spectrum openpbr_emission(
    real emission_luminance = 0.0,
    spectrum emission_color = 1.0,
    real coat_weight = 0.0,
    spectrum coat_color = 1.0
)
    // 683.002 lm/W times the sum over 1 nm of D65 and the observer, as `illuminant_d65` has it.
    white   = emission_luminance / (683.002 * 105.671) * illuminant_d65($wavelength);
    through = transmittance(absorption_from(coat_color, 1.0), 0.5 * saturate(coat_weight));
    return select
        max(white * emission_color, 0.0) * through, if emission_luminance > 0.0;
        spectrum(0.0) otherwise;
    end;

/// What fills an `openpbr` body: per metre, and the mean cosine of its scattering.
/// >>> openpbr_medium(1.0, 0.5, 0.0).anisotropy
/// 0
openpbr_medium typeid struct
    spectrum scattering, absorption;
    real anisotropy;
end

/// The inside of OpenPBR's surface, for a volume: `inside = openpbr_inside(subsurface_weight = 1);
/// scattering = inside.scattering; absorption = inside.absorption; phase =
/// henyey_greenstein(inside.anisotropy);`. Lengths are in metres. Of both transmission and
/// subsurface it is the mixture, by their shares of the surface; what is thin-walled has no inside. `subsurface_color` is what a deep
/// body of it sends back, found by the fit of Kulla and Conty (2017).
/// >>> openpbr_inside(transmission_weight = 1.0, transmission_color = 0.5, transmission_depth = 2.0).absorption
/// 0.34657359
/// >>> luminance(openpbr_inside(subsurface_weight = 1.0).absorption) < 0.1
/// true
openpbr_medium openpbr_inside(
    real transmission_weight = 0.0,
    spectrum transmission_color = 1.0,
    real transmission_depth = 0.0,
    spectrum transmission_scatter = 0.0,
    real transmission_scatter_anisotropy = 0.0, subsurface_weight = 0.0,
    spectrum subsurface_color = 0.8,
    real subsurface_radius = 1.0,
    spectrum subsurface_radius_scale = rgb(1.0, 0.5, 0.25),
    real subsurface_scatter_anisotropy = 0.0,
    logic geometry_thin_walled = false
)
    there = select 0.0, if geometry_thin_walled; 1.0 otherwise; end;
    glass = there * saturate(transmission_weight);
    deep  = there * (1.0 - saturate(transmission_weight)) * saturate(subsurface_weight);
    share = deep / max(glass + deep, 1e-9);

    depth    = max(transmission_depth, 1e-6);
    scatters = select
        max(transmission_scatter, 0.0) / depth, if there * transmission_depth > 0.0;
        spectrum(0.0) otherwise;
    end;
    absorbs = select
        max(absorption_from(transmission_color, depth) - scatters, 0.0),
            if there * transmission_depth > 0.0;
        spectrum(0.0) otherwise;
    end;

    a = clamp(subsurface_color, 0.0, 1.0);
    g = clamp(subsurface_scatter_anisotropy, -0.99, 0.99);
    s = clamp(
        4.09712 + 4.20863 * a - sqrt(9.59217 + 41.6808 * a + 17.7126 * a * a), 0.0, 1.0
    );
    albedo = (1.0 - s * s) / (1.0 - g * s * s);
    each   = 1.0 / max(subsurface_radius * subsurface_radius_scale, 1e-6);
    spectrum of(spectrum clear, filled) = select
        clear, if deep <= 0.0;
        mix(clear, filled, share) otherwise;
    end;
    return openpbr_medium(
        scattering = of(scatters, albedo * each),
        absorption = of(absorbs, (1.0 - albedo) * each),
        anisotropy = mix(clamp(transmission_scatter_anisotropy, -0.99, 0.99), g, share)
    );

/// OpenPBR's surface: `surface s bsdf = openpbr(base_color = rgb(0.6, 0.05, 0.02), coat_weight = 1); end`.
/// Lengths of the film are in micrometres, as there. What lies inside is `openpbr_inside`, for a
/// volume of the same name, which both transmission and subsurface need; emission is
/// `openpbr_emission`, and opacity the output `scattering` of the surface.
///
/// Weights of what is specular, and of the coat, are indices (`openpbr_index`), fuzz is a `layer` of
/// `sheen`; subsurface is entered and left like a `translucent` under the facets, which is what
/// `subsurface_color` is fitted for, and not bent. Bumps of all of it, its coat too, are the output
/// `height` of the surface; those of what lies below the coat are `base_slope`, and those of the coat
/// alone `coat_slope`, both as `slope` or `normal_slope` find them.
/// >>> openpbr(base_color = 0.5, base_metalness = 1.0)
/// >>> openpbr(base_color = rgb(0.6, 0.05, 0.02), coat_weight = 1.0)
material openpbr(
    real base_weight = 1.0,
    spectrum base_color = 0.8,
    real base_diffuse_roughness = 0.0, base_metalness = 0.0, specular_weight = 1.0,
    spectrum specular_color = 1.0,
    real specular_roughness = 0.3, specular_roughness_anisotropy = 0.0, specular_ior = 1.5,
    transmission_weight = 0.0,
    spectrum transmission_color = 1.0,
    real transmission_depth = 0.0, transmission_dispersion_scale = 0.0,
    transmission_dispersion_abbe_number = 20.0, subsurface_weight = 0.0,
    spectrum subsurface_color = 0.8,
    real subsurface_scatter_anisotropy = 0.0, coat_weight = 0.0,
    spectrum coat_color = 1.0,
    real coat_roughness = 0.0, coat_roughness_anisotropy = 0.0, coat_ior = 1.6,
    coat_darkening = 1.0, fuzz_weight = 0.0,
    spectrum fuzz_color = 1.0,
    real fuzz_roughness = 0.5, thin_film_weight = 0.0, thin_film_thickness = 0.5,
    thin_film_ior = 1.4,
    logic geometry_thin_walled = false,
    real[2] base_slope = [0, 0], coat_slope = [0, 0]
)
    film  = thin_film_thickness * 1um;
    dark  = saturate(coat_weight) * saturate(coat_darkening);
    under = saturate(base_weight) * clamp(base_color, 0.0, 1.0);
    base  = under * openpbr_darkening(under, coat_ior, dark);

    diffuse = select
        matte(base), if base_diffuse_roughness <= 0.0;
        rough_matte(base, base_diffuse_roughness) otherwise;
    end;
    // What lies inside is entered and left as evenly as the fit of `openpbr_inside` takes it; a sheet
    // without an inside scatters to both of its sides.
    onward = 0.5 * (1.0 + clamp(subsurface_scatter_anisotropy, -1.0, 1.0));
    deep   = select
        mix(matte(subsurface_color), translucent(subsurface_color), onward),
            if geometry_thin_walled;
        translucent(1.0) otherwise;
    end;
    rough  = openpbr_roughness_below(specular_roughness, coat_roughness, coat_weight);
    below  = openpbr_index_below(specular_ior, specular_weight, coat_ior, coat_weight);
    within = mix(diffuse, deep, saturate(subsurface_weight));
    gloss  = openpbr_gloss(specular_color, rough, specular_roughness_anisotropy);
    bare   = fresnel_mix(within, gloss, below);
    filmed = film_mix(within, gloss, below, thin_film_ior, film, $wavelength);
    opaque = select
        bare, if thin_film_weight <= 0.0;
        filmed, if thin_film_weight >= 1.0;
        mix(bare, filmed, thin_film_weight) otherwise;
    end;

    tint = select transmission_color, if transmission_depth <= 0.0; spectrum(1.0) otherwise; end;
    ior  = openpbr_index(specular_ior, specular_weight);
    bent = select
        abbe_glass(
            ior,
            max(transmission_dispersion_abbe_number, 1e-3) / transmission_dispersion_scale
        ),
            if transmission_dispersion_scale > 0.0;
        spectrum(ior) otherwise;
    end;
    width  = openpbr_stretched(rough, specular_roughness_anisotropy);
    clean  = dielectric(bent, width.roughness, specular_color, tint, width.anisotropy);
    tinged = film_dielectric(
        bent, thin_film_ior, film, $wavelength, width.roughness, specular_color, tint,
        width.anisotropy
    );
    glass = select
        clean, if thin_film_weight <= 0.0;
        tinged, if thin_film_weight >= 1.0;
        mix(clean, tinged, thin_film_weight) otherwise;
    end;
    pane = openpbr_sheet(
        ior, rough, specular_roughness_anisotropy, specular_color,
        transmission_color, thin_film_weight, film, thin_film_ior
    );
    clear = select pane, if geometry_thin_walled; glass otherwise; end;

    metal = saturate(specular_weight) * openpbr_metal(
        base, specular_color, rough, specular_roughness_anisotropy,
        thin_film_weight, film, thin_film_ior
    );
    body = mix(
        mix(opaque, clear, saturate(transmission_weight)), metal, saturate(base_metalness)
    );
    shown = coat(
        tilt(openpbr_gloss(1.0, coat_roughness, coat_roughness_anisotropy), coat_slope),
        tilt(body, base_slope),
        0.5 * saturate(coat_weight),
        absorption_from(coat_color, 1.0),
        openpbr_index(coat_ior, saturate(coat_weight))
    );
    return layer(sheen(fuzz_color, fuzz_roughness), shown, fuzz_weight);
