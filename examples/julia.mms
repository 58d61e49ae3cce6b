// A Julia set (thesis, Figure 6.8) as an inlay: copper in the set, enamel around it.
param real re = -0.745, label = "Real part of c";
param real im = 0.113, label = "Imaginary part of c";

/// Steps until z leaves the circle of radius 4.
integer escape(complex z, integer n) =
    select n, if n == 200 or abs(z) > 4; escape(z^2 + complex(re, im), n + 1) otherwise end;

surface julia
    z      = complex(1.45 * $object_position.x, 1.45 * $object_position.y);
    t      = smoothstep(0.0, 1.0, log(1.0 + escape(z, 0)) / log(201));
    enamel = fresnel_mix(matte(mix(rgb(0.012, 0.02, 0.09), rgb(0.85, 0.87, 0.8), t)), mirror(),
        ior = 1.5);
    bsdf   = mix(enamel, copper(0.22), smoothstep(0.72, 0.8, t));
    height = 0.01 * t;
end
