// A surface or a volume for each model and combiner of the library, named after it, for
// docs/materials.md: `./run figures` renders them and puts them into the furnace.

// Diffuse.
surface matte bsdf = matte(0.8); end
surface translucent bsdf = mix(matte(0.8), translucent(0.8), 0.7); end
surface oren_nayar bsdf = oren_nayar(0.8, 0.6); end
surface rough_matte bsdf = rough_matte(0.8, 1.0); end

// Glossy: the thesis' model.
surface glossy bsdf = glossy(1, 40.0); end
surface glossy_product bsdf = glossy_product(1, 40.0, 4.0); end
surface glossy_back bsdf = glossy_back(1, 40.0, 40.0); end
surface glossy_through bsdf = glossy_through(1, 200.0, 200.0); end

// What it is compared with.
surface phong bsdf = phong(1, 40.0); end
surface max_phong bsdf = max_phong(1, 40.0); end
surface spot bsdf = spot(1, 0.2, 0.3); end
surface ward bsdf = ward(1, 0.4, 0.6); end
surface ashikhmin_shirley bsdf = ashikhmin_shirley(0.5, 400.0, 20.0); end
surface sheen bsdf = sheen(1, 0.4); end

// Facets.
surface microfacet bsdf = microfacet(1, 0.4); end
surface beckmann bsdf = beckmann(1, 0.4); end
surface conductor bsdf = conductor(gold_n($wavelength), gold_k($wavelength), 0.3); end
surface coloured_metal bsdf = coloured_metal(rgb(0.9, 0.5, 0.2), rgb(0.9, 0.9, 0.4), 0.3); end
surface dielectric bsdf = dielectric(1.5, 0.3); end
surface beckmann_dielectric bsdf = beckmann_dielectric(1.5, 0.3); end

surface phong_glass bsdf = phong_glass(1.5, 400.0); end

// Smooth.
surface mirror bsdf = mirror(1); end
surface refraction bsdf = refraction(1.3); end
surface glossy_refraction bsdf = glossy_refraction(1.3, 1, 400.0, 400.0); end
surface slab bsdf = slab(1.5, 1.0, rgb(0.9, 0.3, 0.6)); end
surface film_conductor bsdf = film_conductor(2.5, 3.0, 1.5, 300nm, $wavelength, 0.2); end
surface film_dielectric bsdf = film_dielectric(1.0, 1.33, 400nm, $wavelength); end

// Phase functions. Light passes the surface as if there were none.
surface isotropic scattering = 0; end
volume isotropic
    scattering = 4;
    phase      = isotropic();
end
surface henyey_greenstein scattering = 0; end
volume henyey_greenstein
    scattering = 4;
    phase      = henyey_greenstein(0.6);
end
surface rayleigh_phase scattering = 0; end
volume rayleigh_phase
    scattering = 4;
    phase      = rayleigh_phase();
end
surface draine scattering = 0; end
volume draine
    scattering = 4;
    phase      = draine(0.6, 1.0);
end

// Combiners.
surface mix bsdf = mix(matte(rgb(0.8, 0.2, 0.1)), mirror(), 0.3); end
surface film_mix bsdf = film_mix(matte(0.02), microfacet(1, 0.2), 1.5, 2.0, 350nm, $wavelength); end
surface fresnel_mix bsdf = fresnel_mix(matte(rgb(0.8, 0.2, 0.1)), glossy(1, 400.0), 1.5); end
surface coat bsdf = coat(glossy(1, 4000.0), matte(1), 1.0, rgb(0.05, 0.9, 0.6), 1.5); end
surface layer bsdf = layer(sheen(rgb(0.9, 0.6, 0.5), 0.4), matte(rgb(0.4, 0.03, 0.05))); end
surface scale bsdf = 0.5 * mirror(); end
surface tilt
    bsdf = coat(mirror(), bumped(matte(rgb(0.3, 0.1, 0.05)), 0.02 * perlin(9 * $object_position)),
        0.0);
end
surface turn bsdf = turn(microfacet(1, 0.4, 0.9), 45deg); end
surface add bsdf = matte(rgb(0.1, 0.3, 0.5)) + glossy(0.4, 100.0); end
