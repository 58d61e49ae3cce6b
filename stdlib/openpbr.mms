// SPDX-License-Identifier: Apache-2.0
// OpenPBR Surface 1.1 (Academy Software Foundation 2024) as a surface and the volume inside, with a
// param for each of its names but those of normals and tangents (`geometry_normal`,
// `geometry_tangent`, and of the coat). Those are a script's to say: bumps by `height`, or by the
// function's `base_slope` and `coat_slope`, and `turn` turns tangents. `mms render openpbr --set
// base_metalness=1`, or `import "openpbr";` and `paint alias openpbr;`. `openpbr_layers.mms` has the
// function, and says what differs.

param real base_weight = 1.0 in [0, 1], label = "Weight", page = "Base";
param spectrum base_color = rgb(0.8, 0.8, 0.8), label = "Colour", page = "Base";
param real base_diffuse_roughness = 0.0 in [0, 1], label = "Diffuse roughness", page = "Base";
param real base_metalness = 0.0 in [0, 1], label = "Metalness", page = "Base";

param real specular_weight = 1.0 in [0, 1], label = "Weight", page = "Specular";
param spectrum specular_color = rgb(1.0, 1.0, 1.0), label = "Colour", page = "Specular";
param real specular_roughness = 0.3 in [0, 1], label = "Roughness", page = "Specular";
param real specular_roughness_anisotropy = 0.0 in [0, 1], label = "Anisotropy", page = "Specular";
param real specular_ior = 1.5 in [1, 3], label = "Index", page = "Specular";

param real transmission_weight = 0.0 in [0, 1], label = "Weight", page = "Transmission";
param spectrum transmission_color = rgb(1.0, 1.0, 1.0), label = "Colour", page = "Transmission";
param real transmission_depth = 0.0 in [0, 1000], label = "Depth", unit = "m",
    page = "Transmission";
param spectrum transmission_scatter = rgb(0.0, 0.0, 0.0), label = "Scatter", page = "Transmission";
param real transmission_scatter_anisotropy = 0.0 in [-1, 1], label = "Scatter anisotropy",
    page = "Transmission";
param real transmission_dispersion_scale = 0.0 in [0, 1], label = "Dispersion",
    page = "Transmission";
param real transmission_dispersion_abbe_number = 20.0 in [9, 91], label = "Abbe number",
    page = "Transmission";

param real subsurface_weight = 0.0 in [0, 1], label = "Weight", page = "Subsurface";
param spectrum subsurface_color = rgb(0.8, 0.8, 0.8), label = "Colour", page = "Subsurface";
param real subsurface_radius = 1.0 in [0, 1000], label = "Radius", unit = "m", page = "Subsurface";
param spectrum subsurface_radius_scale = rgb(1.0, 0.5, 0.25), label = "Radius scale",
    page = "Subsurface";
param real subsurface_scatter_anisotropy = 0.0 in [-1, 1], label = "Scatter anisotropy",
    page = "Subsurface";

param real coat_weight = 0.0 in [0, 1], label = "Weight", page = "Coat";
param spectrum coat_color = rgb(1.0, 1.0, 1.0), label = "Colour", page = "Coat";
param real coat_roughness = 0.0 in [0, 1], label = "Roughness", page = "Coat";
param real coat_roughness_anisotropy = 0.0 in [0, 1], label = "Anisotropy", page = "Coat";
param real coat_ior = 1.6 in [1, 3], label = "Index", page = "Coat";
param real coat_darkening = 1.0 in [0, 1], label = "Darkening", page = "Coat";

param real fuzz_weight = 0.0 in [0, 1], label = "Weight", page = "Fuzz";
param spectrum fuzz_color = rgb(1.0, 1.0, 1.0), label = "Colour", page = "Fuzz";
param real fuzz_roughness = 0.5 in [0, 1], label = "Roughness", page = "Fuzz";

param real thin_film_weight = 0.0 in [0, 1], label = "Weight", page = "Thin film";
param real thin_film_thickness = 0.5 in [0, 10], label = "Thickness", unit = "um",
    page = "Thin film";
param real thin_film_ior = 1.4 in [1, 3], label = "Index", page = "Thin film";

param real emission_luminance = 0.0 in [0, 1000000], label = "Luminance", unit = "cd/m^2",
    page = "Emission";
param spectrum emission_color = rgb(1.0, 1.0, 1.0), label = "Colour", page = "Emission";

param real geometry_opacity = 1.0 in [0, 1], label = "Opacity", page = "Geometry";
param logic geometry_thin_walled = false, label = "Thin-walled", page = "Geometry";

surface openpbr
    bsdf = openpbr(base_weight = base_weight, base_color = base_color,
        base_diffuse_roughness = base_diffuse_roughness, base_metalness = base_metalness,
        specular_weight = specular_weight, specular_color = specular_color,
        specular_roughness = specular_roughness,
        specular_roughness_anisotropy = specular_roughness_anisotropy, specular_ior = specular_ior,
        transmission_weight = transmission_weight, transmission_color = transmission_color,
        transmission_depth = transmission_depth,
        transmission_dispersion_scale = transmission_dispersion_scale,
        transmission_dispersion_abbe_number = transmission_dispersion_abbe_number,
        subsurface_weight = subsurface_weight, subsurface_color = subsurface_color,
        subsurface_scatter_anisotropy = subsurface_scatter_anisotropy,
        coat_weight = coat_weight, coat_color = coat_color,
        coat_roughness = coat_roughness, coat_roughness_anisotropy = coat_roughness_anisotropy,
        coat_ior = coat_ior, coat_darkening = coat_darkening, fuzz_weight = fuzz_weight,
        fuzz_color = fuzz_color, fuzz_roughness = fuzz_roughness,
        thin_film_weight = thin_film_weight, thin_film_thickness = thin_film_thickness,
        thin_film_ior = thin_film_ior, geometry_thin_walled = geometry_thin_walled);
    emission = openpbr_emission(emission_luminance = emission_luminance,
        emission_color = emission_color, coat_weight = coat_weight, coat_color = coat_color);
    scattering = geometry_opacity;
end

volume openpbr
    inside = openpbr_inside(transmission_weight = transmission_weight,
        transmission_color = transmission_color, transmission_depth = transmission_depth,
        transmission_scatter = transmission_scatter,
        transmission_scatter_anisotropy = transmission_scatter_anisotropy,
        subsurface_weight = subsurface_weight, subsurface_color = subsurface_color,
        subsurface_radius = subsurface_radius, subsurface_radius_scale = subsurface_radius_scale,
        subsurface_scatter_anisotropy = subsurface_scatter_anisotropy,
        geometry_thin_walled = geometry_thin_walled);
    scattering = inside.scattering;
    absorption = inside.absorption;
    phase      = henyey_greenstein(inside.anisotropy);
end
