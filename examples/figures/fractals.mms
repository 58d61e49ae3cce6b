// Fractals of complex numbers, by recursion in tail position (thesis, Figure 6.8):
//
//     mms render --scene examples/figures/flat.json --surface mandelbrot examples/figures/fractals.mms
import "screen.mms";

param integer depth = 400, label = "Iterations";

/// How soon u^2 + c, again and again, leaves the plane's middle: 0 at once, 1 never.
real escape(complex u, c, integer n) = select
    1.0, if n == depth;
    sqrt(max(n + 1.0 - log2(log2(abs(u)) / 4.0), 0.0) / depth), if abs(u) > 16.0;
    escape(u^2 + c, c, n + 1) otherwise;
end;

/// Night, blue, white and amber, then black.
spectrum painted(real t) = ramp_smooth(t, [0.05, 0.13, 0.25, 0.5, 0.999, 1.0], [
    rgb(0.004, 0.008, 0.05), rgb(0.02, 0.06, 0.22), rgb(0.85, 0.9, 0.95), rgb(0.9, 0.45, 0.05),
    rgb(0.3, 0.02, 0.02), rgb(0.0, 0.0, 0.0)
]);

complex z() = complex($position.x - 0.5, $position.y - 0.5);

surface mandelbrot
    bsdf     = matte(0.0);
    emission = screen_colour(painted(escape(0, 2.6 * z - 0.7, 0)));
end

surface julia
    bsdf     = matte(0.0);
    emission = screen_colour(painted(escape(2.7 * z * polar(1.0, 0.4), -0.745 + 0.113i, 0)));
end
