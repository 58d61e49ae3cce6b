// SPDX-License-Identifier: Apache-2.0
// Varnish over rust over paint: Fresnel at the surface, four octaves of noise between the layers.
spectrum layers(real[3] p, real cos_theta)
    rusty  = smoothstep(-0.2, 0.3, fbm(3.0 * p, 4));
    body   = mix(rgb(0.1, 0.3, 0.6), rgb(0.4, 0.15, 0.05), rusty);
    mirror = fresnel(cos_theta, 1.5);
    return mix(body, spectrum(0.95), mirror);

const value = layers($object_position, dot($normal, $view));
