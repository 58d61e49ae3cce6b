// The Mandelbrot set (thesis, Figure 6.8): complex numbers and a recursion in tail position.
param integer depth = 160, label = "Iterations";

/// Steps until z leaves the circle of radius 16, with a fraction so that bands blend.
real escape(complex z, complex c, integer n)
    size = abs(z);
    return select
        real(n), if n == depth;
        n + 1 - log2(log2(size) / 4), if size > 16;
        escape(z^2 + c, c, n + 1) otherwise;
    end;

surface mandelbrot
    n      = escape(0, complex(1.55 * $object_position.x - 0.6, 1.55 * $object_position.y), 0);
    t      = sqrt(n / depth);
    band   = 0.5 + 0.5 * cos(tau * (2.2 * t + 0.1));
    colour = mix(rgb(0.02, 0.04, 0.16), rgb(0.95, 0.62, 0.12), band * smoothstep(0.05, 0.5, t));
    paint  = select rgb(0.004, 0.004, 0.006), if n >= depth; colour otherwise end;
    bsdf   = fresnel_mix(matte(paint), glossy(colour = 1, gloss = 250.0), ior = 1.5);
end
